// The points of a sweep: the jobs, what each of them changes, and the rows of the service's table.

import { fetch_json, Problem, send } from "../parts/client.js";
import { rows_of_csv } from "../parts/csv.js";
import { as_text, quantity } from "../parts/quantity.js";

/**
 * @typedef {object} Point
 * @property {string} id
 * @property {Record<string, any>} overrides
 * @property {string} status
 * @property {string | null} outcome
 * @property {any} [progress]
 * @property {Map<string, string>} [row]
 *
 * @typedef {object} Field a field that is swept
 * @property {string} pointer
 * @property {any[]} values that occur: numbers in their order, others as they come
 * @property {boolean} is_number
 */

/** Points that are loaded and shown at most: the first ones. */
export const MOST_POINTS = 1000;

/**
 * A sweep with its points as they are now, or the first of them.
 * @param {string} id
 * @param {AbortSignal} signal
 * @returns {Promise<{sweep: any, points: Point[]}>}
 */
export async function load_points(id, signal) {
  const sweep = await fetch_json(`/v1/sweeps/${id}`, { signal });
  const path = `/v1/sweeps/${id}/outcomes?limit=${MOST_POINTS}`;
  const response = await send(path, { signal });
  if (!response.ok) throw new Problem(`${path}: ${response.status}`, response.status);
  const rows = new Map(rows_of_csv(await response.text()).map((row) => [row.get("job"), row]));
  return { sweep, points: sweep.jobs.map((/** @type {any} */ job) => ({ ...job, row: rows.get(job.id) })) };
}

/**
 * The fields that points change, with the values that occur.
 * @param {{overrides: Record<string, any>}[]} points
 * @returns {Field[]}
 */
export function fields_of(points) {
  const pointers = [...new Set(points.flatMap(({ overrides }) => Object.keys(overrides)))];
  return pointers.map((pointer) => {
    const all = points.map(({ overrides }) => overrides[pointer]);
    const values = [...new Map(all.map((value) => [JSON.stringify(value), value])).values()];
    const is_number = values.every((value) => typeof value === "number");
    return { pointer, is_number, values: is_number ? values.sort((a, b) => a - b) : values };
  });
}

/**
 * The values of several fields at a point, in words.
 * @param {Point} point
 * @param {Field[]} fields
 * @returns {string}
 */
export function values_in_words({ overrides }, fields) {
  return fields.map(({ pointer }) => {
    const { name, unit } = quantity(pointer);
    return `${name} ${as_text(overrides[pointer])}${unit ? ` ${unit}` : ""}`;
  }).join("; ");
}
