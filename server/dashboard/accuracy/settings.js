// The settings of a run in words.

import { count, length, number, percent } from "../parts/format.js";

/**
 * What a run was asked for.
 * @param {import("./runs.js").Run} run
 * @returns {string}
 */
export function asked_for({ tolerance, contact_element_mm, increments_per_cycle, cycle_jump, stations }) {
  if (tolerance != null) return `tolerance ${percent(tolerance)}`;
  return [`elements ${length(contact_element_mm)}`, `${count(increments_per_cycle)} increments`, `jump ${number(cycle_jump)}`, ...(stations == null ? [] : [`${count(stations)} sections`])].join(", ");
}

/** Names of the settings and how their levels are written. @type {Record<string, [string, (value: number) => string]>} */
const SETTINGS = {
  contact_element_mm: ["element of the contact", length],
  increments_per_cycle: ["increments a cycle", count],
  cycle_jump: ["cycle jump, cycles", number],
  stations: ["sections", count],
};

/**
 * A setting of a study and its levels in words.
 * @param {string} setting
 * @param {number[]} levels
 * @returns {[string, string]}
 */
export function setting_in_words(setting, levels) {
  const [name, written] = SETTINGS[setting] ?? [setting, number];
  return [name, levels.map((level) => written(level)).join(", ")];
}
