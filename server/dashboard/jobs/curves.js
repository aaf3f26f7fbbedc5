// Curves of the deepest wear of the listed jobs.

import { columns_of } from "../parts/histories.js";

/** Points of a curve. */
const POINTS = 24;
const [CYCLE, RECEPTACLE, SLIDER] = ["cycle", "receptacle_max_depth_mm", "slider_max_depth_mm"];

/**
 * Cycles and the deeper wear of both sides, mm, by job.
 * @param {string[]} ids
 * @param {AbortSignal} signal
 * @returns {Promise<Map<string, {cycles: number[], depths: number[]}>>}
 */
export async function curves_of(ids, signal) {
  const histories = await columns_of(ids, [CYCLE, RECEPTACLE, SLIDER], POINTS, signal);
  return new Map([...histories].map(([job, columns]) => {
    const depths = columns[RECEPTACLE].map((depth, index) => Math.max(depth, columns[SLIDER][index]));
    return [job, { cycles: columns[CYCLE], depths }];
  }));
}
