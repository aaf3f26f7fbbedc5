// A batch that is cloned: its base and what it was asked for.

import { base_of } from "../batches/base.js";
import { fetch_json } from "../parts/client.js";
import { fields_of } from "../sweep/points.js";

/**
 * @typedef {object} Cloned
 * @property {any} base
 * @property {string} name
 * @property {{pointer: string, values: any[]}[]} fields that a sweep varies
 * @property {boolean} is_grid whether it has every combination of them
 */

/**
 * The base of a sweep, or of an accuracy study, without where its values are from.
 * @param {string} id
 * @param {string | null} kind
 * @param {AbortSignal} signal
 * @returns {Promise<Cloned>}
 */
export async function cloned_batch(id, kind, signal) {
  const batch = await fetch_json(kind === "accuracy" ? `/v1/studies/${id}` : `/v1/sweeps/${id}`, { signal });
  const { provenance: _, ...base } = batch.study?.spec ?? (await base_of(batch, signal)) ?? { system: { kind: "cylinder_on_flat" } };
  const name = batch.name ? `${batch.name}, changed` : "";
  if (kind === "accuracy") return { base, name, fields: [], is_grid: true };
  // A large sweep shows the first of its jobs.
  if (batch.grid) return { base, name, is_grid: true, fields: Object.entries(batch.grid).map(([pointer, values]) => ({ pointer, values })) };
  const fields = fields_of(batch.jobs);
  const combinations = fields.reduce((all, { values }) => all * values.length, 1);
  const is_grid = combinations === batch.jobs.length;
  const values_of = (/** @type {string} */ pointer) => batch.jobs.map((/** @type {any} */ { overrides }) => overrides[pointer] ?? null);
  return { base, name, is_grid, fields: fields.map(({ pointer, values }) => ({ pointer, values: is_grid ? values : values_of(pointer) })) };
}
