// What the numbers of a batch's jobs by status say about it.

import { element } from "../parts/element.js";
import { count } from "../parts/format.js";
import { STATUSES, has_ended, progress_bar } from "../parts/status.js";

/** @typedef {Record<string, number>} Counts number of jobs by status */

/**
 * @param {Counts} counts
 * @param {(status: string) => boolean} [includes]
 */
function sum(counts, includes = () => true) {
  return Object.entries(counts).reduce((all, [status, jobs]) => all + (includes(status) ? jobs : 0), 0);
}

/**
 * Numbers of jobs by status.
 * @param {{status: string}[]} jobs
 * @returns {Counts}
 */
export function counts_of(jobs) {
  return Object.fromEntries(STATUSES.map((status) => [status, jobs.filter((job) => job.status === status).length]));
}

/**
 * Numbers of the jobs of a batch by status; those that are still to be queued count as queued.
 * @param {{counts: Counts, to_come?: number}} batch
 * @returns {Counts}
 */
export function counts_with_later({ counts, to_come = 0 }) {
  return { ...counts, queued: (counts.queued ?? 0) + to_come };
}

/**
 * The share of the jobs that have ended.
 * @param {Counts} counts
 * @returns {number}
 */
export function progress(counts) {
  return sum(counts, (status) => has_ended({ status })) / Math.max(sum(counts), 1);
}

/**
 * The state of a batch as one status: running until all of its jobs have ended, then the worst that one of them has.
 * @param {Counts} counts
 * @returns {string}
 */
export function state(counts) {
  if (sum(counts, (status) => !has_ended({ status }))) return counts.running || progress(counts) > 0 ? "running" : "queued";
  return ["failed", "cancelled"].find((status) => counts[status]) ?? "succeeded";
}

/**
 * The state as a badge.
 * @param {Counts} counts
 * @returns {HTMLElement}
 */
export function state_badge(counts) {
  const all = sum(counts);
  const found = state(counts);
  const part = counts[found] < all && (found === "failed" || found === "cancelled") ? `partly ${found}` : found;
  return element("span", { class: all ? `badge ${found}` : "muted" }, all ? part : "no jobs left");
}

/**
 * The numbers of jobs by status, without those that no job has.
 * @param {Counts} counts
 * @returns {HTMLElement}
 */
export function counts_line(counts) {
  const present = [...STATUSES].reverse().filter((status) => counts[status]);
  if (present.length === 1 && counts[present[0]] === sum(counts)) return element("span", {}, `all ${count(sum(counts))} ${present[0]}`);
  return element("span", { class: "line" }, ...present.map((status) => element("span", { class: `badge ${status}` }, `${count(counts[status])} ${status}`)));
}

/**
 * How far a batch is.
 * @param {Counts} counts
 * @param {string} name
 * @returns {HTMLElement}
 */
export function progress_line(counts, name) {
  const ended = sum(counts, (status) => has_ended({ status }));
  return element("span", { class: "line" }, progress_bar(progress(counts), `progress of ${name}`), element("span", { class: "muted" }, `${count(ended)} of ${count(sum(counts))}`));
}
