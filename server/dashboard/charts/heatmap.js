// A heat map over two fields: a cell for each pair of values, which a click opens.

import { csv } from "../parts/csv.js";
import { element } from "../parts/element.js";
import { number } from "../parts/format.js";
import { fit, open_clicked, save_buttons } from "./chart.js";
import { plotly } from "./library.js";
import { when_seen } from "./seen.js";
import { axis, colour, layout, on_theme } from "./theme.js";

/** Cells that have their values written in them at most. */
const MOST_WRITTEN = 80;

/**
 * @typedef {object} Cells
 * @property {string} title
 * @property {{title: string, values: string[]}} x
 * @property {{title: string, values: string[]}} y
 * @property {string} unit of the values
 * @property {(number | null)[][]} z a row for each value of y
 * @property {string[][]} texts what is said of each cell
 * @property {(string | null)[][]} links addresses of the cells
 */

/** A heat map on a page. */
export class HeatMap {
  /** @type {Cells | null} */
  #cells = null;
  #plot = element("div", { class: "plot" });
  #signal;
  #redraw;

  /**
   * @param {string} name of its files
   * @param {AbortSignal} signal that ends it with its page
   */
  constructor(name, signal) {
    this.#signal = signal;
    this.title = element("h3");
    const buttons = save_buttons(this.#plot, name, "the heat map", () => (this.#cells ? as_table(this.#cells) : ""));
    this.node = element("figure", { class: "chart", "data-chart": name },
      element("figcaption", {}, this.title, element("div", { class: "tools" }, buttons)), this.#plot);
    this.#redraw = when_seen(this.#plot, () => this.#draw(), signal);
    on_theme(this.#redraw, signal);
    fit(this.#plot, signal);
    signal.addEventListener("abort", () => this.#cells && plotly().then((library) => library.purge(this.#plot)));
  }

  /** @param {Cells} cells */
  async show(cells) {
    this.#cells = cells;
    this.title.textContent = cells.title;
    await this.#redraw();
  }

  async #draw() {
    const cells = this.#cells;
    if (!cells || this.#signal.aborted) return;
    const library = await plotly();
    if (this.#signal.aborted || cells !== this.#cells) return;
    const { x, y, z, unit } = cells;
    const is_written = x.values.length * y.values.length <= MOST_WRITTEN;
    const written = z.map((row, at) => row.map((value, index) => (value === null ? cells.links[at][index] ? "…" : "" : number(value))));
    // The values are categories: cells have one size, whatever lies between the values.
    const categories = (/** @type {{title: string, values: string[]}} */ { title, values }) =>
      ({ ...axis(title, false), type: "category", categoryorder: "array", categoryarray: values, showgrid: false, range: [-0.5, values.length - 0.5] });
    await library.react(this.#plot, [{
      type: "heatmap", x: x.values, y: y.values, z, text: is_written ? written : undefined, texttemplate: is_written ? "%{text}" : undefined,
      customdata: cells.links, hovertext: cells.texts, hovertemplate: "%{hovertext}<extra></extra>", hoverongaps: true,
      colorscale: "Viridis", xgap: 2, ygap: 2, colorbar: { title: { text: unit }, thickness: 12, outlinewidth: 0, tickfont: { color: colour("--text") }, tickformat: "~g", exponentformat: "power" },
    }], { ...layout(), margin: { l: 66, r: 14, t: 32, b: 46 }, xaxis: categories(x), yaxis: categories(y) }, { responsive: true, displaylogo: false, modeBarButtonsToRemove: ["select2d", "lasso2d", "toImage"] });
    open_clicked(this.#plot);
  }
}

/**
 * The cells of a heat map as CSV: both fields and the value of each.
 * @param {Cells} cells
 * @returns {string}
 */
function as_table({ x, y, unit, z }) {
  const rows = z.flatMap((row, at) => row.map((value, index) => [x.values[index], y.values[at], value ?? ""]));
  return csv([x.title, y.title, unit], rows);
}
