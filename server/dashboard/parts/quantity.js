// What fields of a specification are: their names in words and the units that their names end with.

import { number, words } from "./format.js";

/** Ends of names that are units, and the units as they are written; the longest first. */
const UNITS = /** @type {[string, string][]} */ ([
  ["_n_per_mm", "N/mm"], ["_per_mpa", "1/MPa"], ["_kg_m3", "kg/m³"], ["_w_mk", "W/(m K)"], ["_j_kgk", "J/(kg K)"], ["_ohm_m", "Ω m"], ["_per_k", "1/K"], ["_mm_s", "mm/s"],
  ["_mrad", "mrad"], ["_mohm", "mΩ"], ["_mpa", "MPa"], ["_um", "µm"], ["_mm", "mm"], ["_hz", "Hz"], ["_deg", "°"], ["_c", "°C"], ["_n", "N"], ["_s", "s"], ["_h", "h"], ["_a", "A"], ["_g", "g"],
]);
/** Names that are a unit alone: what they are, and the unit. @type {Record<string, [string, string]>} */
const BY_UNIT = { n: ["force", "N"], mpa: ["pressure", "MPa"], n_per_mm: ["line force", "N/mm"], mm: ["depth", "mm"], mohm: ["resistance", "mΩ"] };

/**
 * The name in words and the unit of a field.
 * @param {string} pointer
 * @returns {{name: string, unit: string}}
 */
export function quantity(pointer) {
  const keys = pointer.split("/").slice(1);
  const last = keys.pop() ?? "";
  const [alone, unit_alone] = BY_UNIT[last] ?? [];
  const [end, unit] = UNITS.find(([end]) => last.endsWith(end)) ?? ["", ""];
  return { name: [...keys, alone ?? last.slice(0, last.length - end.length)].map(words).join(" / "), unit: unit_alone ?? unit };
}

/**
 * The name of a field with its unit, as a heading.
 * @param {string} pointer
 * @returns {string}
 */
export function heading(pointer) {
  const { name, unit } = quantity(pointer);
  return unit ? `${name}, ${unit}` : name;
}

/**
 * A value of a field in words.
 * @param {unknown} value
 * @returns {string}
 */
export function as_text(value) {
  if (typeof value === "number") return number(value);
  if (typeof value === "string") return words(value);
  return value === undefined ? "–" : JSON.stringify(value);
}
