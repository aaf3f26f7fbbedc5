// Specifications that are cloned, as they were sent: of a job, and of a batch with what it was asked for.

import { fetch_answer, fetch_json, Problem } from "../parts/client.js";
import { words } from "../parts/format.js";
import { fields_of } from "../sweep/points.js";

/**
 * @typedef {object} Sent
 * @property {any} spec
 * @property {boolean} is_as_sent false where only the resolved specification is stored
 */

/**
 * @typedef {Sent & {name: string, fields: {pointer: string, values: any[]}[], is_grid: boolean}} Cloned a batch: `fields` are those that a sweep varies,
 * `is_grid` says whether it has every combination of them
 */

/**
 * @param {string} path
 * @param {AbortSignal} signal
 * @returns {Promise<Sent>}
 */
async function sent(path, signal) {
  const { body, headers } = await fetch_answer(path, { signal });
  return { spec: body, is_as_sent: headers.get("fretwear-specification") !== "resolved" };
}

/**
 * The specification of a job under another name.
 * @param {string} id
 * @param {AbortSignal} signal
 * @returns {Promise<Sent>}
 */
export async function cloned_job(id, signal) {
  const { spec, is_as_sent } = await sent(`/v1/jobs/${id}/spec`, signal);
  return { spec: { ...spec, name: `${spec.name ?? words(spec.system.kind)}, changed` }, is_as_sent };
}

/**
 * The base of a sweep, or of an accuracy study.
 * @param {string} id
 * @param {string | null} kind
 * @param {AbortSignal} signal
 * @returns {Promise<Cloned>}
 */
export async function cloned_batch(id, kind, signal) {
  const path = kind === "accuracy" ? `/v1/studies/${id}` : `/v1/sweeps/${id}`;
  const [batch, base] = await Promise.all([fetch_json(path, { signal }), sent(`${path}/base`, signal).catch(no_base)]);
  const name = batch.name ? `${batch.name}, changed` : "";
  if (kind === "accuracy") return { ...base, name, fields: [], is_grid: true };
  // A large sweep shows the first of its jobs.
  if (batch.grid) return { ...base, name, is_grid: true, fields: Object.entries(batch.grid).map(([pointer, values]) => ({ pointer, values })) };
  const fields = fields_of(batch.jobs);
  const combinations = fields.reduce((all, { values }) => all * values.length, 1);
  const is_grid = combinations === batch.jobs.length;
  const values_of = (/** @type {string} */ pointer) => batch.jobs.map((/** @type {any} */ { overrides }) => overrides[pointer] ?? null);
  return { ...base, name, is_grid, fields: fields.map(({ pointer, values }) => ({ pointer, values: is_grid ? values : values_of(pointer) })) };
}

/**
 * A batch whose jobs were all deleted, with what they were made of.
 * @param {unknown} error
 * @returns {Sent}
 */
function no_base(error) {
  if (error instanceof Problem && error.status === 404) return { spec: { system: { kind: "cylinder_on_flat" } }, is_as_sent: false };
  throw error;
}
