// The chart of a sweep and the choices of what it shows, which are values of the address.

import { Chart } from "../charts/chart.js";
import { HeatMap } from "../charts/heatmap.js";
import { address, change, choices } from "../parts/address.js";
import { element } from "../parts/element.js";
import { quantity as field } from "../parts/quantity.js";
import { cells, curves, groups } from "./curves.js";
import { fields_of } from "./points.js";
import { present, title_of } from "./quantities.js";

/** Curves that one chart shows at most. */
const MOST_CURVES = 24;

/** The chart with its choices. */
export class View {
  #selects = Object.fromEntries(["quantity", "view", "x", "y", "rest"].map((name) => [name, select(name)]));
  #chart;
  #map;
  #quantities;
  #hint = element("p", { class: "muted" });
  /** @type {import("./points.js").Point[]} */
  #points = [];

  /**
   * @param {import("./quantities.js").Quantity[]} quantities
   * @param {AbortSignal} signal
   */
  constructor(quantities, signal) {
    this.#quantities = quantities;
    this.#chart = new Chart({ name: "sweep", signal, state: choices });
    this.#map = new HeatMap("sweep-map", signal);
    this.node = element("section", { class: "view", hidden: true, "aria-label": "chart" },
      element("p", { class: "line" }, ...Object.values(this.#selects).map(({ label }) => label)), this.#hint, this.#map.node, this.#chart.node);
  }

  /** @param {import("./points.js").Point[]} points */
  async show(points) {
    this.#points = points;
    await this.follow_address();
  }

  /** Shows what the address asks for. */
  async follow_address() {
    const points = this.#points;
    const { values } = address();
    const varied = fields_of(points).filter((one) => one.values.length > 1);
    const numbers = varied.filter(({ is_number }) => is_number);
    const quantities = present(this.#quantities, points.map(({ row }) => row));
    const views = [varied.length > 1 && ["map", "heat map"], numbers.length > 0 && ["curves", "curves"]].filter((one) => one !== false);
    this.node.hidden = quantities.length === 0 || views.length === 0;
    if (this.node.hidden) return;

    const pick = (/** @type {string} */ name, /** @type {string[][]} */ options) => this.#selects[name].offer(options, values.get(name));
    const named = (/** @type {import("./points.js").Field[]} */ fields) => fields.map(({ pointer }) => [pointer, field(pointer).name]);
    const quantity = quantities[pick("quantity", quantities.map((one) => [one.name, title_of(one)]))];
    const view = views[pick("view", /** @type {string[][]} */ (views))][0];
    const x_fields = view === "map" ? [...numbers, ...varied.filter(({ is_number }) => !is_number)] : numbers;
    const x = x_fields[pick("x", named(x_fields))];
    const others = varied.filter((one) => one !== x);
    this.#map.node.hidden = view !== "map";
    this.#chart.node.hidden = view === "map";
    if (view === "map") {
      const y = others[pick("y", named(others))];
      const rest = others.filter((one) => one !== y);
      const parts = groups(points, rest);
      const part = parts[pick("rest", parts.map(({ name }, index) => [String(index), name || "all"]))];
      this.#hint.textContent = "A click on a cell opens its job.";
      return this.#map.show(cells(part.points, x, y, quantity));
    }
    pick("y", []);
    pick("rest", []);
    const figure = curves(points, x, others, quantity);
    const left_out = figure.series.length - MOST_CURVES;
    this.#hint.textContent = `A click on a point opens its job.${left_out > 0 ? ` ${left_out} more curves are not drawn; the table has them.` : ""}`;
    await this.#chart.show({ ...figure, series: figure.series.slice(0, MOST_CURVES) });
  }
}

/**
 * A choice of the address, hidden where there is nothing to choose.
 * @param {string} name
 */
function select(name) {
  const titles = /** @type {Record<string, string>} */ ({ quantity: "Quantity ", view: "as ", x: "across ", y: "up ", rest: "at " });
  const node = /** @type {HTMLSelectElement} */ (element("select", { id: `choice-${name}`, change: () => change({ [name]: node.value }) }));
  const label = element("label", {}, titles[name], node);
  return {
    label,
    /**
     * @param {string[][]} options values and texts
     * @param {string | null} chosen
     * @returns {number} index of the one that is chosen, else of the first
     */
    offer(options, chosen) {
      const index = Math.max(options.findIndex(([value]) => value === chosen), 0);
      const same = node.options.length === options.length && options.every(([value, text], at) => node.options[at].value === value && node.options[at].text === text);
      if (!same) node.replaceChildren(...options.map(([value, text]) => element("option", { value }, text)));
      if (options.length) node.value = options[index][0];
      label.hidden = options.length < 2;
      return index;
    },
  };
}
