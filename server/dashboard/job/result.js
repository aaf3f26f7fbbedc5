// What a job has found.

import { card, definitions, table } from "../parts/element.js";
import { count, length, number, words } from "../parts/format.js";
import { value_in, with_unit } from "../parts/summary.js";

/** @typedef {import("../parts/summary.js").Listed} Listed */

const SIDES = ["receptacle", "slider"];

/** Parts of a summary that other cards show. */
const OTHER_CARDS = ["accuracy", "cost"];

/**
 * The quantities of a summary.
 * @param {any} job
 * @param {Listed[]} listed
 * @returns {HTMLElement}
 */
export function result_card({ summary, spec }, listed) {
  const shown = (/** @type {Listed} */ quantity) => with_unit(value_in(summary, quantity), quantity);
  const worn = [...Map.groupBy(listed.filter(({ side }) => side), ({ title }) => title)].filter(([, sides]) => sides.some(shown));
  const rows = SIDES.map((side) => [side, ...worn.map(([, sides]) => sides.filter((one) => one.side === side).map(shown).join(""))]);
  const contact = listed.filter(({ side, pointer }) => !side && pointer && !OTHER_CARDS.includes(pointer.split("/")[1]));
  const resistance = summary.contact_resistance_mohm;
  return card("Result",
    table({ head: ["side", ...worn.map(([title]) => title)], rows, numbers: worn.map((_, index) => index + 1) }),
    definitions([
      ["outcome", words(summary.outcome)],
      ["computed cycles", count(summary.accuracy.computed_cycles)],
      ...contact.map((quantity) => entry(summary, quantity)),
      ["contact resistance", resistance?.initial == null ? null : `${number(resistance.initial)} → ${number(resistance.final)} mΩ`],
      ["thinnest plating that remains", plating_left(spec, summary)],
    ]));
}

/**
 * A quantity of the contact, behind that of the unworn one where it is known.
 * @param {any} summary
 * @param {Listed} quantity
 * @returns {[string, string]}
 */
function entry(summary, quantity) {
  const [before, after] = [summary.initial[quantity.column], value_in(summary, quantity)].map((value) => with_unit(value, quantity));
  return before ? [`${quantity.title}, unworn → worn`, `${before} → ${after}`] : [quantity.title, after];
}

/**
 * The sections along a line.
 * @param {any} job
 * @returns {HTMLElement | null}
 */
export function stations_card({ summary }) {
  const stations = summary.stations ?? [];
  if (stations.length === 0) return null;
  const place = (/** @type {any} */ { theta_deg, z_mm }) => (theta_deg == null ? length(z_mm) || "middle" : `${number(theta_deg)}°`);
  const rows = stations.map((/** @type {any} */ station) => [place(station), number(station.line_load_n_per_mm), number(station.peak_pressure_mpa),
    length(station.receptacle.max_depth_mm), length(station.slider.max_depth_mm)]);
  return card("Sections along the line", table({ head: ["place", "line load, N/mm", "peak, MPa", "receptacle", "slider"], rows, numbers: [1, 2, 3, 4] }));
}

/**
 * The plating that remains at the deepest place of each plated side.
 * @param {any} spec
 * @param {any} summary
 */
function plating_left(spec, summary) {
  const thickness = (/** @type {string} */ side) => (spec.plating?.[side] ?? []).reduce((/** @type {number} */ sum, /** @type {any} */ { thickness_um, thickness_mm }) => sum + (thickness_mm ?? thickness_um / 1e3), 0);
  return SIDES.filter((side) => thickness(side) > 0).map((side) => {
    const left = thickness(side) - summary[side].max_depth_mm;
    return `${left > 0 ? length(left) : "none"} of ${length(thickness(side))} (${side})`;
  }).join(", ");
}
