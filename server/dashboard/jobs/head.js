// The head of the list: its columns, and the order by each.

import { address, changed } from "../parts/address.js";
import { element } from "../parts/element.js";

/**
 * @typedef {object} Column
 * @property {string} text
 * @property {string} [sort] the order by it, as the interface names it
 * @property {boolean} [largest_first] whether the largest comes first where it is chosen
 * @property {boolean} [is_number]
 */

/** @type {Column[]} */
const COLUMNS = [
  { text: "select" },
  { text: "job", sort: "name" },
  { text: "system", sort: "system" },
  { text: "status", sort: "status" },
  { text: "progress", sort: "progress" },
  { text: "time left", is_number: true },
  { text: "deepest wear", sort: "wear", largest_first: true, is_number: true },
  { text: "life", sort: "life", is_number: true },
  { text: "duration", sort: "duration", largest_first: true, is_number: true },
  { text: "age", sort: "created", largest_first: true, is_number: true },
];
const NEWEST_FIRST = "-created";

/** The head, which follows the order of the address. */
export class Head {
  node = element("tr");

  /** Shows the present order. */
  update() {
    const order = address().values.get("sort") ?? NEWEST_FIRST;
    this.node.replaceChildren(...COLUMNS.map((column) => {
      const is_order = column.sort === order.replace(/^-/, "");
      const direction = order.startsWith("-") ? "descending" : "ascending";
      return element("th", { scope: "col", class: column.is_number && "number", "aria-sort": is_order && direction }, head_of(column, order));
    }));
  }
}

/**
 * @param {Column} column
 * @param {string} order
 */
function head_of({ text, sort, largest_first }, order) {
  if (!sort) return element("span", { class: text === "select" && "hidden" }, text);
  const [first, second] = largest_first ? [`-${sort}`, sort] : [sort, `-${sort}`];
  const next = order === first ? second : first;
  const arrow = { [sort]: " ▲", [`-${sort}`]: " ▼" }[order] ?? "";
  const href = changed({ sort: next === NEWEST_FIRST ? null : next, page: null });
  return element("a", { href, title: `order by ${text}` }, text, arrow && element("span", { "aria-hidden": "true" }, arrow));
}
