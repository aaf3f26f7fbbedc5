// The table of a sweep's points: what is swept, the status, the figures; each row leads to its job.

import { link } from "../parts/address.js";
import { card, element } from "../parts/element.js";
import { number, percent } from "../parts/format.js";
import { as_text, heading } from "../parts/quantity.js";
import { badge, progress_bar, refined } from "../parts/status.js";
import { fields_of } from "./points.js";
import { present, title_of, value_of } from "./quantities.js";

/** The table. */
export class PointsTable {
  #head = element("tr");
  #body = element("tbody");
  #columns = "";
  #quantities;
  /** Rows by job, with what they show. @type {Map<string, {node: HTMLElement, status: HTMLElement, shown: string}>} */
  #rows = new Map();

  /** @param {import("./quantities.js").Quantity[]} quantities */
  constructor(quantities) {
    this.#quantities = quantities;
    this.node = card("Points", element("div", { class: "scroll", tabindex: "0" }, element("table", { class: "points" }, element("thead", {}, this.#head), this.#body)));
  }

  /**
   * Shows the points; rows that show the same as before stay as they are.
   * @param {import("./points.js").Point[]} points
   */
  show(points) {
    const fields = fields_of(points);
    const quantities = present(this.#quantities, points.map(({ row }) => row));
    const heads = ["job", ...fields.map(({ pointer }) => heading(pointer)), "status", ...quantities.map(title_of)];
    const columns = [...heads, ...points.map(({ id }) => id)].join("\n");
    const is_new = columns !== this.#columns;
    const focused = document.activeElement?.getAttribute("href");
    if (is_new) {
      const is_number = (/** @type {number} */ column) => column > fields.length + 1 || fields[column - 1]?.is_number;
      this.#columns = columns;
      this.#rows.clear();
      this.#head.replaceChildren(...heads.map((text, column) => element("th", { scope: "col", class: is_number(column) && "number" }, text)));
    }
    points.forEach((point, index) => {
      const figures = quantities.map((quantity) => number(value_of(point.row, quantity)));
      const shown = figures.join("\n");
      const before = this.#rows.get(point.id);
      if (before?.shown !== shown) {
        const status = element("td");
        const node = row(point, index, fields, status, figures);
        before?.node.replaceWith(node);
        this.#rows.set(point.id, { node, status, shown });
      }
      this.update(point);
    });
    if (is_new) this.#body.replaceChildren(...points.flatMap(({ id }) => this.#rows.get(id)?.node ?? []));
    if (focused) /** @type {HTMLElement | null} */ (this.#body.querySelector(`a[href="${focused}"]`))?.focus();
  }

  /** @param {import("./points.js").Point} point whose status has changed */
  update(point) {
    const { status, progress } = point;
    const running = status === "running" && progress ? [" ", progress_bar(progress.fraction, "progress"), ` ${refined(progress)}${percent(progress.fraction)}`] : [];
    this.#rows.get(point.id)?.status.replaceChildren(element("span", { class: "nowrap" }, badge(point), ...running));
  }
}

/**
 * @param {import("./points.js").Point} point
 * @param {number} index
 * @param {import("./points.js").Field[]} fields
 * @param {HTMLElement} status
 * @param {string[]} figures
 * @returns {HTMLElement}
 */
function row({ id, overrides }, index, fields, status, figures) {
  return element("tr", { "data-job": id },
    element("td", {}, element("a", { href: link("job", id), class: "nowrap" }, `job ${index + 1}`)),
    ...fields.map(({ pointer, is_number }) => element("td", { class: is_number && "number" }, as_text(overrides[pointer]))),
    status, ...figures.map((figure) => element("td", { class: "number" }, figure)));
}
