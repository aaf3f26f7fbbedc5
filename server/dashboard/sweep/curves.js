// A sweep as curves over one field, and as a map over two.

import { link } from "../parts/address.js";
import { number, words } from "../parts/format.js";
import { as_text, heading, quantity as field } from "../parts/quantity.js";
import { values_in_words } from "./points.js";
import { title_of, value_of } from "./quantities.js";

/**
 * @typedef {import("./points.js").Point} Point
 * @typedef {import("./points.js").Field} Field
 * @typedef {import("./quantities.js").Quantity} Quantity
 */

const name_of = (/** @type {string} */ pointer) => field(pointer).name;

/**
 * The points in groups that have the same values of some fields.
 * @param {Point[]} points
 * @param {Field[]} fields
 * @returns {{name: string, points: Point[]}[]}
 */
export function groups(points, fields) {
  const named = Map.groupBy(points, (point) => values_in_words(point, fields));
  return [...named].map(([name, points]) => ({ name, points }));
}

/**
 * What is said of a point.
 * @param {Point} point
 * @param {Field[]} fields
 * @param {Quantity} quantity
 */
function said(point, fields, quantity) {
  const value = value_of(point.row, quantity);
  const shown = value === null ? words(point.status) : `${quantity.title}: ${number(value)} ${quantity.unit}`;
  return [...fields.map((one) => values_in_words(point, [one])), shown].join("<br>");
}

/**
 * Curves over a numeric field, one for each combination of the others.
 * @param {Point[]} points
 * @param {Field} x
 * @param {Field[]} others
 * @param {Quantity} quantity
 * @returns {import("../charts/chart.js").Figure}
 */
export function curves(points, x, others, quantity) {
  const along = (/** @type {Point[]} */ some) => [...some].sort((a, b) => a.overrides[x.pointer] - b.overrides[x.pointer]);
  return {
    title: `${capital(quantity.title)} over ${name_of(x.pointer)}`,
    x: { title: heading(x.pointer), can_log: true },
    y: { title: title_of(quantity), can_log: true },
    series: groups(points, others).map(({ name, points: some }) => {
      const sorted = along(some);
      return {
        name: name || quantity.title, mode: "lines+markers",
        x: sorted.map(({ overrides }) => overrides[x.pointer]),
        y: sorted.map(({ row }) => value_of(row, quantity)),
        texts: sorted.map((point) => said(point, others, quantity)),
        links: sorted.map(({ id }) => link("job", id)),
      };
    }),
  };
}

/**
 * A map over two fields.
 * @param {Point[]} points
 * @param {Field} x
 * @param {Field} y
 * @param {Quantity} quantity
 * @returns {import("../charts/heatmap.js").Cells}
 */
export function cells(points, x, y, quantity) {
  const key = (/** @type {any} */ a, /** @type {any} */ b) => JSON.stringify([a, b]);
  const by_values = new Map(points.map((point) => [key(point.overrides[x.pointer], point.overrides[y.pointer]), point]));
  const found = y.values.map((b) => x.values.map((a) => by_values.get(key(a, b))));
  return {
    title: `${capital(quantity.title)} over ${name_of(x.pointer)} and ${name_of(y.pointer)}`,
    x: { title: heading(x.pointer), values: x.values.map(as_text) },
    y: { title: heading(y.pointer), values: y.values.map(as_text) },
    unit: quantity.unit,
    z: found.map((row) => row.map((point) => value_of(point?.row, quantity))),
    texts: found.map((row) => row.map((point) => (point ? said(point, [x, y], quantity) : "no job"))),
    links: found.map((row) => row.map((point) => (point ? link("job", point.id) : null))),
  };
}

/** @param {string} text */
function capital(text) {
  return text[0].toUpperCase() + text.slice(1);
}
