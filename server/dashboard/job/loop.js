// The friction loop of a cycle: its energy, and whether the contact sticks, slips in part or slips as a whole.

import { count, number, percent } from "../parts/format.js";

const UM = 1e3;
/** Energy of a loop over that of the rectangle around it, above which the contact slips as a whole (Fouvry, Kapsa, Vincent 1995). */
const GROSS_SLIP = 0.2;
/** The same below which no energy is dissipated but round-off. */
const STICKING = 1e-6;

/**
 * @param {any} loop
 * @returns {import("../charts/chart.js").Figure}
 */
export function friction_loop(loop) {
  const of_contact = Boolean(loop.tangential_force_n);
  const force = of_contact ? loop.tangential_force_n : loop.tangential_force_n_per_mm;
  const closed = (/** @type {number[]} */ list) => [...list, ...list.slice(0, 1)];
  return {
    title: `Friction loop of cycle ${count(loop.cycle)}`,
    x: { title: "displacement, µm" },
    y: { title: `tangential force, ${of_contact ? "N" : "N/mm"}` },
    series: [{ name: "force", x: closed(loop.displacement_mm).map((x) => UM * x), y: closed(force) }],
    note: note(closed(loop.displacement_mm), closed(force), of_contact ? "mJ" : "mJ/mm"),
  };
}

/**
 * The dissipated energy and the regime of a loop, in words.
 * @param {number[]} x mm
 * @param {number[]} force
 * @param {string} unit of the energy
 */
function note(x, force, unit) {
  const range = (/** @type {number[]} */ values) => Math.max(...values) - Math.min(...values);
  const energy = Math.abs(x.slice(1).reduce((sum, at, index) => sum + ((force[index + 1] + force[index]) / 2) * (at - x[index]), 0));
  const around = range(x) * range(force);
  if (!(around > 0)) return "";
  const share = energy / around;
  const regime = share > GROSS_SLIP ? "gross slip" : share > STICKING ? "partial slip" : "the contact sticks";
  return `${regime}; ${number(energy)} ${unit} dissipated in this cycle, ${percent(share)} of the rectangle around the loop (above ${percent(GROSS_SLIP)}: gross slip)`;
}
