// Pages of the list of batches.

import { fetch_json } from "../parts/client.js";

/** Batches of a page, and studies that are asked for at once. */
const PAGE = 100;
const STUDIES = 500;

/** @typedef {{batch: any, kind: import("./kinds.js").Kind}} Listed */

/**
 * A page of batches, newest first. The interface lists every batch as a sweep; those that it lists as studies too are accuracy studies.
 * @param {URLSearchParams} values of the address: `kind`, `page`
 * @param {AbortSignal} signal
 * @returns {Promise<{batches: Listed[], next: string | null}>}
 */
export async function batches(values, signal) {
  const query = new URLSearchParams({ limit: String(PAGE) });
  const page = values.get("page");
  if (page) query.set("page_token", page);
  const asked = values.get("kind");
  if (asked === "accuracy") {
    const { studies, next_page_token } = await fetch_json(`/v1/studies?${query}`, { signal });
    return { batches: studies.map((/** @type {any} */ batch) => ({ batch, kind: "accuracy" })), next: next_page_token };
  }
  const { sweeps, next_page_token } = await fetch_json(`/v1/sweeps?${query}`, { signal });
  const studies = sweeps.length ? await studies_since(sweeps[sweeps.length - 1].id, signal) : new Set();
  const listed = sweeps.map((/** @type {any} */ batch) => ({ batch, kind: studies.has(batch.id) ? "accuracy" : "sweep" }));
  return { batches: listed.filter((/** @type {Listed} */ { kind }) => asked !== "sweep" || kind === "sweep"), next: next_page_token };
}

/**
 * Ids of the accuracy studies from a batch on: ids are ordered by creation.
 * @param {string} oldest
 * @param {AbortSignal} signal
 */
async function studies_since(oldest, signal) {
  const ids = new Set();
  let token = "";
  for (;;) {
    const { studies, next_page_token } = await fetch_json(`/v1/studies?limit=${STUDIES}${token}`, { signal });
    for (const { id } of studies) ids.add(id);
    if (!next_page_token || studies[studies.length - 1].id < oldest) return ids;
    token = `&page_token=${encodeURIComponent(next_page_token)}`;
  }
}
