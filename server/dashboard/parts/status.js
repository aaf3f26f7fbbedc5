// The status of a job as a badge.

import { element } from "./element.js";
import { words } from "./format.js";

/** Statuses of the interface, in the order of a job's way. */
export const STATUSES = ["queued", "running", "succeeded", "failed", "cancelled"];

/**
 * Whether a job has ended.
 * @param {{status: string}} job
 * @returns {boolean}
 */
export function has_ended({ status }) {
  return status !== "queued" && status !== "running";
}

/**
 * @param {{status: string, outcome: string | null}} job
 * @returns {HTMLElement}
 */
export function badge({ status, outcome }) {
  const shown = outcome && outcome !== "completed" ? words(outcome) : status;
  return element("span", { class: `badge ${status}` }, shown);
}

/**
 * The stage of a run that was refined, in a word; empty of others.
 * @param {any} progress
 * @returns {string}
 */
export function refined(progress) {
  return progress?.stage === "refined" ? "refined, " : "";
}

/**
 * A bar of progress.
 * @param {number} fraction
 * @param {string} label
 * @returns {HTMLElement}
 */
export function progress_bar(fraction, label) {
  return element("progress", { max: 1, value: fraction, "aria-label": label });
}
