// Combinations of a large sweep that make no valid job.

import { card, element, table } from "../parts/element.js";
import { count } from "../parts/format.js";
import { as_text, quantity } from "../parts/quantity.js";

/**
 * How many there are, and the first of them with their reasons.
 * @param {{refused: number, refused_changes: {position: number, overrides: Record<string, any>, reason: string}[]}} sweep
 * @returns {HTMLElement}
 */
export function refused_card({ refused, refused_changes }) {
  const rows = refused_changes.map(({ position, overrides, reason }) => [
    `job ${position + 1}`,
    Object.entries(overrides).map(([pointer, value]) => `${quantity(pointer).name} ${as_text(value)}`).join("; "),
    reason,
  ]);
  return card("No valid jobs",
    element("p", {}, `${count(refused)} combinations of values make no valid job and are left out.`),
    element("details", {}, element("summary", {}, rows.length < refused ? `the first ${rows.length}` : "which"), table({ head: ["job", "values", "reason"], rows })));
}
