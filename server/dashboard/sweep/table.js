// The table of a sweep's points: what is swept, the status, the figures; each row leads to its job.

import { link } from "../parts/address.js";
import { card, element } from "../parts/element.js";
import { number, percent } from "../parts/format.js";
import { as_text, heading } from "../parts/quantity.js";
import { badge, progress_bar } from "../parts/status.js";
import { fields_of } from "./points.js";
import { present, title_of, value_of } from "./quantities.js";

/** The table. */
export class PointsTable {
  #head = element("tr");
  #body = element("tbody");
  /** Cells of the status by job. @type {Map<string, HTMLElement>} */
  #statuses = new Map();

  constructor() {
    this.node = card("Points", element("div", { class: "scroll", tabindex: "0" }, element("table", { class: "points" }, element("thead", {}, this.#head), this.#body)));
  }

  /** @param {import("./points.js").Point[]} points */
  show(points) {
    const fields = fields_of(points);
    const quantities = present(points.map(({ row }) => row));
    const heads = ["job", ...fields.map(({ pointer }) => heading(pointer)), "status", ...quantities.map(title_of)];
    const is_number = (/** @type {number} */ column) => column > fields.length + 1 || fields[column - 1]?.is_number;
    this.#head.replaceChildren(...heads.map((text, column) => element("th", { scope: "col", class: is_number(column) && "number" }, text)));
    const focused = document.activeElement?.getAttribute("href");
    this.#statuses.clear();
    this.#body.replaceChildren(...points.map((point, index) => {
      const status = element("td");
      this.#statuses.set(point.id, status);
      this.update(point);
      return element("tr", { "data-job": point.id },
        element("td", {}, element("a", { href: link("job", point.id), class: "nowrap" }, `job ${index + 1}`)),
        ...fields.map(({ pointer, is_number }) => element("td", { class: is_number && "number" }, as_text(point.overrides[pointer]))),
        status,
        ...quantities.map((quantity) => element("td", { class: "number" }, number(value_of(point.row, quantity)))));
    }));
    if (focused) /** @type {HTMLElement | null} */ (this.#body.querySelector(`a[href="${focused}"]`))?.focus();
  }

  /** @param {import("./points.js").Point} point whose status has changed */
  update(point) {
    const { status, progress } = point;
    const running = status === "running" && progress ? [" ", progress_bar(progress.fraction, "progress"), ` ${percent(progress.fraction)}`] : [];
    this.#statuses.get(point.id)?.replaceChildren(element("span", { class: "nowrap" }, badge(point), ...running));
  }
}
