// Quantities of a sweep's table.

const UM = 1e3;

/**
 * @typedef {object} Quantity
 * @property {string} name in the address
 * @property {string} title
 * @property {string} unit
 * @property {string[]} columns of the service's table, of which the largest is meant
 * @property {number} [factor] from the unit of the columns to its own
 */

/** @type {Quantity[]} */
export const QUANTITIES = [
  { name: "deepest", title: "deepest wear", unit: "µm", columns: ["receptacle_max_depth_mm", "slider_max_depth_mm"], factor: UM },
  { name: "life", title: "first life", unit: "cycles", columns: ["first_life_cycles"] },
  { name: "receptacle_depth", title: "wear of the receptacle", unit: "µm", columns: ["receptacle_max_depth_mm"], factor: UM },
  { name: "slider_depth", title: "wear of the slider", unit: "µm", columns: ["slider_max_depth_mm"], factor: UM },
  { name: "receptacle_scar", title: "scar half-width, receptacle", unit: "µm", columns: ["receptacle_scar_half_width_mm"], factor: UM },
  { name: "slider_scar", title: "scar half-width, slider", unit: "µm", columns: ["slider_scar_half_width_mm"], factor: UM },
  { name: "receptacle_area", title: "worn area, receptacle", unit: "µm²", columns: ["receptacle_worn_area_mm2"], factor: UM * UM },
  { name: "slider_area", title: "worn area, slider", unit: "µm²", columns: ["slider_worn_area_mm2"], factor: UM * UM },
  { name: "peak_pressure", title: "peak pressure at the end", unit: "MPa", columns: ["peak_pressure_mpa"] },
  { name: "energy", title: "dissipated energy", unit: "mJ/mm", columns: ["dissipated_energy_mj_per_mm"] },
  { name: "distance", title: "sliding distance", unit: "m", columns: ["sliding_distance_mm"], factor: 1e-3 },
  { name: "cycles", title: "cycles done", unit: "", columns: ["cycles_done"] },
  { name: "error", title: "estimated error", unit: "%", columns: ["estimated_relative_error"], factor: 100 },
  { name: "time", title: "processor time", unit: "s", columns: ["cpu_s"] },
];

/**
 * The heading of a quantity.
 * @param {Quantity} quantity
 * @returns {string}
 */
export function title_of({ title, unit }) {
  return unit ? `${title}, ${unit}` : title;
}

/**
 * A quantity of a row of the table; null where it has none.
 * @param {Map<string, string> | undefined} row
 * @param {Quantity} quantity
 * @returns {number | null}
 */
export function value_of(row, { columns, factor = 1 }) {
  const cells = columns.map((column) => row?.get(column)).filter((cell) => cell);
  return cells.length ? factor * Math.max(...cells.map(Number)) : null;
}

/**
 * The quantities that some row has; those that are 0 in all of them, as the wear of a side that does not wear, are left out.
 * @param {(Map<string, string> | undefined)[]} rows
 * @returns {Quantity[]}
 */
export function present(rows) {
  return QUANTITIES.filter((quantity) => rows.some((row) => value_of(row, quantity)));
}
