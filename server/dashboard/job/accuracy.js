// How exact a result is, what was checked, and what it cost.

import { card, definitions, table } from "../parts/element.js";
import { count, duration, number, percent, words } from "../parts/format.js";

const QUANTITIES = [["worn depth", "worn_depth"], ["scar half-width", "scar_half_width"], ["worn area", "worn_area"], ["peak pressure", "peak_pressure"], ["contact resistance", "contact_resistance"]];
const PARTS = ["mesh", "increments", "jump", "effects"];

/**
 * The estimated errors by their parts.
 * @param {any} job
 * @returns {HTMLElement}
 */
export function errors_card({ summary }) {
  const { errors, estimated_relative_error } = summary.accuracy;
  if (!errors) return card("Accuracy", definitions([["estimated error of the worn depth by jumps", percent(estimated_relative_error)]]));
  const rows = QUANTITIES.filter(([, field]) => errors[field]).map(([name, field]) =>
    [name, percent(errors[field].relative), ...PARTS.map((part) => percent(errors[field][part]))]);
  return card("Estimated errors", table({ head: ["quantity", "error", ...PARTS.map((part) => `by ${part}`)], rows, numbers: [1, 2, 3, 4, 5] }));
}

/**
 * The residuals that were reached.
 * @param {any} job
 * @returns {HTMLElement}
 */
export function checks_card({ summary }) {
  const entries = /** @type {[string, number][]} */ (Object.entries(summary.checks));
  return card("Checks", definitions(entries.map(([name, value]) => [words(name), name === "friction_use" ? number(value) : value.toExponential(1)])));
}

/**
 * Where the time went.
 * @param {any} job
 * @returns {HTMLElement}
 */
export function cost_card({ summary }) {
  const { wall_s, cpu_s, phases_s, peak_memory_mb, dofs } = summary.cost;
  const phases = /** @type {[string, number][]} */ (Object.entries(phases_s));
  return card("Cost", definitions([
    ["time", duration(wall_s)], ["processor time", duration(cpu_s)],
    ...phases.map(([name, seconds]) => /** @type {[string, string]} */ ([`of it: ${words(name)}`, `${duration(seconds)}, ${percent(wall_s > 0 ? seconds / wall_s : null)}`])),
    ["memory", `${number(peak_memory_mb)} MiB`], ["unknowns", count(dofs)],
    ["elements of the contact", `${count(summary.accuracy.contact_elements)}, ${number(summary.accuracy.contact_element_mm, 1e3)} µm`],
    ["increments a cycle", count(summary.accuracy.increments_per_cycle)],
  ]));
}
