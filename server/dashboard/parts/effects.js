// What a plan simulates and why.

import { element, table } from "./element.js";
import { percent, words } from "./format.js";

const SIMULATED = ["simulated", "forced_on"];

/**
 * The decisions about all effects, with the numbers that they were made by.
 * @param {any[]} effects
 * @returns {HTMLElement}
 */
export function effects_table(effects) {
  const rows = effects.map(({ effect, decision, value, threshold, reason }) => [
    words(effect), element("span", { class: SIMULATED.includes(decision) ? "on" : "off" }, words(decision)), percent(value), percent(threshold), reason,
  ]);
  return table({ head: ["effect", "decision", "changes results by", "limit", "reason"], rows, numbers: [2, 3] });
}
