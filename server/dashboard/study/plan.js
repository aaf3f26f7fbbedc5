// What a plan says before anything is queued.

import { effects_table } from "../parts/effects.js";
import { card, definitions, element, table } from "../parts/element.js";
import { count, duration_range, length, number, words } from "../parts/format.js";
import { motion_card } from "../parts/motion.js";

/**
 * The faults of a refused specification, each with a way to its field.
 * @param {import("../parts/client.js").Problem} problem
 * @param {(pointer: string) => void} go
 * @returns {HTMLElement}
 */
export function faults_list({ message, faults }, go) {
  if (faults.length === 0) return element("p", {}, message);
  return element("ul", {}, ...faults.map(({ pointer, detail }) =>
    element("li", {}, element("button", { type: "button", class: "quiet", click: () => go(pointer) }, element("code", {}, pointer || "/")), " ", detail)));
}

/**
 * Size, time, effects, lives and warnings of a plan.
 * @param {any} plan
 * @returns {HTMLElement[]}
 */
export function plan_cards(plan) {
  const { estimates, effects, warnings = [], notes = [], life = [] } = plan;
  const slip = motion_card(plan);
  const lives = life.map((/** @type {any} */ one) => [words(one.criterion?.kind ?? ""), one.side ?? "", count(one.cycles)]).filter((/** @type {string[]} */ row) => row[2] !== "");
  return [
    card("Expected", definitions([
      ["processor time", duration_range(estimates.cpu_s, estimates.cpu_s_most)], ["memory", `${number(estimates.memory_mb)} MB`], ["results", `${number(estimates.output_mb)} MB`],
      ["computed cycles", count(estimates.computed_cycles)], ["increments", count(estimates.increments)],
      ["unworn contact", `${length(estimates.hertz_half_width_mm)} to either side, ${number(estimates.hertz_peak_pressure_mpa)} MPa at most`],
      ["element of the contact", length(estimates.contact_element_mm)],
    ]), ...(lives.length ? [table({ head: ["life by", "side", "about, cycles"], rows: lives, numbers: [2] })] : [])),
    ...(slip ? [slip] : []),
    ...(warnings.length || notes.length ? [card("To know", element("ul", {},
      ...warnings.map((/** @type {any} */ { field, detail }) => element("li", {}, element("code", {}, field), " ", detail)),
      ...notes.map((/** @type {any} */ note) => element("li", {}, typeof note === "string" ? note : note.detail ?? ""))))] : []),
    element("details", { class: "card" }, element("summary", {}, "Effects: what is simulated and why"),
      effects_table(effects)),
  ];
}
