// Columns of the histories of several jobs, in one request.

import { fetch_json } from "./client.js";

/** Jobs that the interface answers at once. */
const MOST_JOBS = 100;

/**
 * The columns by job; jobs that are gone have none.
 * @param {string[]} ids
 * @param {string[]} columns
 * @param {number} points that each curve has at most
 * @param {AbortSignal} signal
 * @returns {Promise<Map<string, Record<string, number[]>>>}
 */
export async function columns_of(ids, columns, points, signal) {
  if (ids.length === 0) return new Map();
  const query = new URLSearchParams({ jobs: ids.slice(0, MOST_JOBS).join(","), columns: columns.join(","), max_points: String(points) });
  const { histories } = await fetch_json(`/v1/histories?${query}`, { signal });
  return new Map(histories.map((/** @type {any} */ history) => [history.job, history.columns]));
}
