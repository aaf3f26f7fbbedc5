// What the plan simulates and why, and what it and the result warn of.

import { card, element, table } from "../parts/element.js";
import { percent, words } from "../parts/format.js";
import { badge } from "../parts/status.js";

const SIMULATED = ["simulated", "forced_on"];

/**
 * @param {any} job
 * @returns {HTMLElement}
 */
export function effects_card({ plan }) {
  const effects = plan?.effects ?? [];
  const rows = effects.map((/** @type {any} */ { effect, decision, value, threshold, reason }) => [
    words(effect), element("span", { class: SIMULATED.includes(decision) ? "on" : "off" }, words(decision)), percent(value), percent(threshold), reason,
  ]);
  return card("Effects: what is simulated and why",
    table({ head: ["effect", "decision", "changes results by", "limit", "reason"], rows, numbers: [2, 3] }));
}

/**
 * Warnings of the plan and of the result.
 * @param {any} job
 * @returns {HTMLElement | null}
 */
export function warnings_card({ plan, summary, status, status_reason }) {
  const of_plan = (plan?.warnings ?? []).map((/** @type {any} */ { field, detail }) => element("li", {}, element("code", {}, field), " ", detail));
  const of_result = (summary?.warnings ?? []).map((/** @type {string} */ text) => element("li", {}, text));
  const failure = status === "failed" ? [element("li", {}, badge({ status, outcome: null }), " ", status_reason)] : [];
  const all = [...failure, ...of_result, ...of_plan];
  return all.length ? card("Warnings", element("ul", {}, ...all)) : null;
}
