// What a job has found.

import { card, definitions, table } from "../parts/element.js";
import { count, length, number, words } from "../parts/format.js";

/**
 * The key figures of a summary.
 * @param {any} job
 * @returns {HTMLElement}
 */
export function result_card({ summary, spec }) {
  const { receptacle, slider, initial, accuracy, extent } = summary;
  const worn = /** @type {[string, any][]} */ ([["receptacle", receptacle], ["slider", slider]]);
  const rows = worn.map(([name, side]) => [name, length(side.max_depth_mm), length(side.scar_half_width_mm), `${number(side.worn_area_mm2, 1e6)} µm²`,
    side.worn_volume_mm3 == null ? "" : `${number(side.worn_volume_mm3, 1e9)} µm³`]);
  const resistance = summary.contact_resistance_mohm;
  return card("Result",
    table({ head: ["side", "deepest wear", "scar half-width", "worn area", worn.some(([, side]) => side.worn_volume_mm3 != null) ? "worn volume" : ""], rows, numbers: [1, 2, 3, 4] }),
    definitions([
      ["outcome", words(summary.outcome)],
      ["cycles", `${count(summary.cycles_done)}, ${count(accuracy.computed_cycles)} of them computed`],
      ["sliding distance", `${number(summary.sliding_distance_mm, 1e-3)} m`],
      ["peak pressure, unworn → worn", `${number(initial.peak_pressure_mpa)} → ${number(summary.peak_pressure_mpa)} MPa`],
      ["contact half-width, unworn → worn", `${length(initial.contact_half_width_mm)} → ${length(summary.contact_half_width_mm)}`],
      ["force", extent?.load_n == null ? null : `${number(extent.load_n)} N`],
      ["dissipated energy", summary.dissipated_energy_mj_per_mm == null ? null : `${number(summary.dissipated_energy_mj_per_mm)} mJ/mm`],
      ["contact resistance", resistance?.initial == null ? null : `${number(resistance.initial)} → ${number(resistance.final)} mΩ`],
      ["thinnest plating that remains", plating_left(spec, worn)],
    ]));
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
 * @param {[string, any][]} worn
 */
function plating_left(spec, worn) {
  const thickness = (/** @type {string} */ side) => (spec.plating?.[side] ?? []).reduce((/** @type {number} */ sum, /** @type {any} */ { thickness_um, thickness_mm }) => sum + (thickness_mm ?? thickness_um / 1e3), 0);
  return worn.filter(([side]) => thickness(side) > 0).map(([side, { max_depth_mm }]) => {
    const left = thickness(side) - max_depth_mm;
    return `${left > 0 ? length(left) : "none"} of ${length(thickness(side))} (${side})`;
  }).join(", ");
}
