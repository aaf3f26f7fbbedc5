// What the plan simulates and why, and what it and the result warn of.

import { effects_table } from "../parts/effects.js";
import { card, element } from "../parts/element.js";

/**
 * @param {any} job
 * @returns {HTMLElement}
 */
export function effects_card({ plan }) {
  return card("Effects: what is simulated and why", effects_table(plan?.effects ?? []));
}

/**
 * Warnings of the plan and of the result.
 * @param {any} job
 * @returns {HTMLElement | null}
 */
export function warnings_card({ plan, summary }) {
  const of_plan = (plan?.warnings ?? []).map((/** @type {any} */ { field, detail }) => element("li", {}, element("code", {}, field), " ", detail));
  const of_result = (summary?.warnings ?? []).map((/** @type {string} */ text) => element("li", {}, text));
  const all = [...of_result, ...of_plan];
  return all.length ? card("Warnings", element("ul", {}, ...all)) : null;
}
