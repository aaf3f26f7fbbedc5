// Quantities of a sweep's table.

/**
 * @typedef {object} Quantity
 * @property {string} name in the address
 * @property {string} title
 * @property {string} unit
 * @property {string[]} columns of the service's table, of which the largest is meant
 * @property {number} factor from the unit of the columns to its own
 */

/** Shown first: the field of a side of which the larger one is meant, and the column behind it. */
const [LARGER, NEXT] = ["max_depth_mm", "first_life_cycles"];

/**
 * The quantities in the order of the page.
 * @param {import("../parts/summary.js").Listed[]} listed
 * @returns {Quantity[]}
 */
export function ordered(listed) {
  const sides = listed.filter(({ side, column }) => column === `${side}_${LARGER}`);
  const larger = sides.slice(0, 1).map(({ title, unit, factor }) => ({ name: LARGER, title, unit, factor, columns: sides.map(({ column }) => column) }));
  const each = listed.map(({ column, side, title, unit, factor }) => ({ name: column, title: side ? `${title}, ${side}` : title, unit, factor, columns: [column] }));
  return [...larger, ...each.sort((a, b) => Number(b.name === NEXT) - Number(a.name === NEXT))];
}

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
export function value_of(row, { columns, factor }) {
  const cells = columns.map((column) => row?.get(column)).filter((cell) => cell);
  return cells.length ? factor * Math.max(...cells.map(Number)) : null;
}

/**
 * The quantities that some row has; those that are 0 in all of them, as the wear of a side that does not wear, are left out.
 * @param {Quantity[]} quantities
 * @param {(Map<string, string> | undefined)[]} rows
 * @returns {Quantity[]}
 */
export function present(quantities, rows) {
  return quantities.filter((quantity) => rows.some((row) => value_of(row, quantity)));
}
