// Names and units of the values of a specification.

import { words } from "./format.js";

/** Ends of names that are units, and the units as they are written; longer ones first where one ends like another. */
const UNITS = /** @type {[string, string][]} */ ([
  ["_mm3_per_j", "mm³/J"], ["_n_per_mm", "N/mm"], ["_per_mpa", "1/MPa"], ["_mpa_mm", "MPa mm"], ["_ohm_mm2", "Ω mm²"], ["_kg2_m4s", "kg²/(m⁴ s)"], ["_m2_s", "m²/s"],
  ["_kg_m3", "kg/m³"], ["_j_m3", "J/m³"], ["_j_mol", "J/mol"], ["_w_mk", "W/(m K)"], ["_j_kgk", "J/(kg K)"], ["_ohm_m", "Ω m"], ["_per_k", "1/K"], ["_per_hz", "g²/Hz"],
  ["_mm_s", "mm/s"], ["_mrad", "mrad"], ["_mohm", "mΩ"], ["_mpa", "MPa"], ["_um", "µm"], ["_mm", "mm"], ["_hz", "Hz"], ["_deg", "°"],
  ["_c", "°C"], ["_k", "K"], ["_n", "N"], ["_s", "s"], ["_h", "h"], ["_a", "A"],
]);
/** Names that are a unit alone, or end like one that they are not: what they are, and the unit. @type {Record<string, [string, string]>} */
const WHOLE = {
  n: ["force", "N"], mpa: ["pressure", "MPa"], n_per_mm: ["line force", "N/mm"], mm: ["depth", "mm"], mohm: ["resistance", "mΩ"], k: ["wear coefficient k", ""],
  k_over_h_per_mpa: ["k/H", "1/MPa"], mass_g: ["mass", "g"], acceleration_g: ["acceleration", "g"], g2_per_hz: ["density", "g²/Hz"],
  snapshots_at_cycles: ["snapshots at cycles", ""],
};

/**
 * A field's name in words, and its unit.
 * @param {string} name
 * @returns {[string, string]}
 */
export function name_and_unit(name) {
  if (WHOLE[name]) return WHOLE[name];
  const [end, unit] = UNITS.find(([end]) => name.endsWith(end)) ?? ["", ""];
  return [words(name.slice(0, name.length - end.length)), unit];
}
