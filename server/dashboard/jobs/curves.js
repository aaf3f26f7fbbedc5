// Curves of the deepest wear of the listed jobs, all in one request.

import { fetch_json } from "../parts/client.js";

/** Points of a curve. */
const POINTS = 24;
/** Jobs that the interface answers at once. */
const MOST_JOBS = 100;
const [CYCLE, RECEPTACLE, SLIDER] = ["cycle", "receptacle_max_depth_mm", "slider_max_depth_mm"];

/**
 * Cycles and the deeper wear of both sides, mm, by job.
 * @param {string[]} ids
 * @param {AbortSignal} signal
 * @returns {Promise<Map<string, {cycles: number[], depths: number[]}>>}
 */
export async function curves_of(ids, signal) {
  if (ids.length === 0) return new Map();
  const query = new URLSearchParams({ jobs: ids.slice(0, MOST_JOBS).join(","), columns: [CYCLE, RECEPTACLE, SLIDER].join(","), max_points: String(POINTS) });
  const { histories } = await fetch_json(`/v1/histories?${query}`, { signal });
  return new Map(histories.map((/** @type {any} */ { job, columns }) => {
    const depths = columns[RECEPTACLE].map((/** @type {number} */ depth, /** @type {number} */ index) => Math.max(depth, columns[SLIDER][index]));
    return [job, { cycles: columns[CYCLE], depths }];
  }));
}
