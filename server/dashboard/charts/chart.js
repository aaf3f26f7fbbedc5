// A chart with its heading, its choice of axes and its downloads. Hover, zoom and pan are the library's.

import { csv } from "../parts/csv.js";
import { save } from "../parts/download.js";
import { element } from "../parts/element.js";
import { plotly } from "./library.js";
import { when_seen } from "./seen.js";
import { axis, colour, colours, layout, on_theme } from "./theme.js";

/** Ticks that a logarithmic x axis has about: more of its labels would overlap on narrow screens. */
const LOG_TICKS = 4;
/** Width of the bar of buttons, pixels. */
const BUTTONS_WIDTH = 34;
/** Change of values over their mean, to either side, below which an axis is not fitted to them. */
const FLAT = 1e-3;

/**
 * @typedef {object} Series
 * @property {string} name
 * @property {ArrayLike<number>} x
 * @property {ArrayLike<number | null>} y
 * @property {"solid" | "dash" | "dot"} [dash]
 * @property {number} [colour] number of its colour; that of its place otherwise
 * @property {number} [opacity] of its line; 1 otherwise
 * @property {"lines" | "markers" | "lines+markers"} [mode]
 * @property {"circle" | "circle-open" | "diamond"} [symbol] of its markers
 * @property {string[]} [texts] what is said of each point besides its values
 * @property {(string | null)[]} [links] addresses that a click on each point opens
 *
 * @typedef {object} Axis
 * @property {string} title with the unit
 * @property {boolean} [can_log] whether the reader may choose a logarithmic axis
 * @property {boolean} [log] whether it is logarithmic unless the reader chooses otherwise
 * @property {boolean} [reversed]
 *
 * @typedef {object} Figure
 * @property {string} title
 * @property {Axis} x
 * @property {Axis} y
 * @property {Series[]} series
 * @property {{y: number, name: string}[]} [limits] horizontal lines
 * @property {boolean} [to_scale] whether both axes have the same scale
 * @property {string} [note] what the curves say in words
 *
 * @typedef {object} Options
 * @property {string} name of its files, and of its axes in the address
 * @property {AbortSignal} signal that ends it with its page
 * @property {{get: (name: string) => string | null, set: (name: string, value: string | null) => void}} [state] of its axes
 */

/** A chart on a page. */
export class Chart {
  /** @type {Figure | null} */
  #figure = null;
  #plot = element("div", { class: "plot" });
  #note = element("p", { class: "muted small" });
  /** @type {Options} */
  #options;
  #redraw;

  /** @param {Options} options */
  constructor(options) {
    this.#options = options;
    this.title = element("h3");
    this.tools = element("div", { class: "tools" });
    this.node = element("figure", { class: "chart", "data-chart": options.name },
      element("figcaption", {}, this.title, this.tools), this.#plot, this.#note);
    this.#redraw = when_seen(this.#plot, () => this.#draw(), options.signal);
    on_theme(this.#redraw, options.signal);
    fit(this.#plot, options.signal);
    options.signal.addEventListener("abort", () => this.#forget());
  }

  /**
   * Draws a figure in place of the last one, when it can be seen; zoom and hidden curves stay.
   * @param {Figure} figure
   */
  async show(figure) {
    if (this.#figure?.title !== figure.title) this.title.textContent = figure.title;
    this.#note.textContent = figure.note ?? "";
    const is_first = this.#figure === null;
    this.#figure = figure;
    if (is_first) this.#add_tools(figure);
    await this.#redraw();
  }

  /** @param {Figure} figure */
  #add_tools(figure) {
    for (const [name, { can_log }] of /** @type {["x" | "y", Axis][]} */ ([["x", figure.x], ["y", figure.y]])) {
      if (!can_log) continue;
      const box = /** @type {HTMLInputElement} */ (element("input", { type: "checkbox", checked: this.#is_log(name) }));
      box.addEventListener("change", () => {
        const chosen = box.checked ? "log" : "linear";
        this.#options.state?.set(`${this.#options.name}-${name}`, box.checked === this.#is_log_by_default(name) ? null : chosen);
        this.#log[name] = box.checked;
        this.#redraw();
      });
      this.tools.append(element("label", {}, box, ` log ${name}`));
    }
    this.tools.append(save_buttons(this.#plot, this.#options.name, figure.title, () => (this.#figure ? as_table(this.#figure) : "")));
  }

  /** Choices of the reader where the page keeps no state. @type {Record<string, boolean>} */
  #log = {};

  /** @param {"x" | "y"} name */
  #is_log(name) {
    const chosen = this.#options.state?.get(`${this.#options.name}-${name}`);
    return this.#log[name] ?? (chosen ? chosen === "log" : this.#is_log_by_default(name));
  }

  /** @param {"x" | "y"} name */
  #is_log_by_default(name) {
    return this.#figure?.[name].log ?? false;
  }

  async #draw() {
    const figure = this.#figure;
    if (!figure || this.#options.signal.aborted) return;
    const library = await plotly();
    if (this.#options.signal.aborted || figure !== this.#figure) return;
    const palette = colours();
    const lines = figure.limits ?? [];
    // Shapes are placed by values, texts on a logarithmic axis by their logarithm.
    const height = (/** @type {number} */ y) => (this.#is_log("y") ? Math.log10(y) : y);
    const style = layout();
    await library.react(this.#plot, figure.series.map((series, index) => trace(series, palette[(series.colour ?? index) % palette.length])), {
      ...style,
      // The bar of buttons stands beside the plot: above it are the names of the curves.
      modebar: { ...style.modebar, orientation: "v" },
      margin: { ...style.margin, r: BUTTONS_WIDTH },
      uirevision: `${figure.x.title}, ${figure.y.title}${figure.to_scale ? " to scale" : ""}`,
      xaxis: { ...axis(figure.x.title, this.#is_log("x")), nticks: this.#is_log("x") ? LOG_TICKS : undefined },
      yaxis: { ...axis(figure.y.title, this.#is_log("y")), autorange: figure.y.reversed ? "reversed" : true, ...(!this.#is_log("y") && flat_range(figure.series)), ...(figure.to_scale && { scaleanchor: "x", scaleratio: 1 }) },
      showlegend: figure.series.length > 1,
      shapes: lines.map(({ y }) => ({ type: "line", xref: "paper", x0: 0, x1: 1, y0: y, y1: y, line: { color: palette[4], width: 1, dash: "dash" } })),
      annotations: lines.map(({ y, name }) => ({ xref: "paper", x: 1, y: height(y), text: name, showarrow: false, xanchor: "right", yanchor: "bottom", font: { color: palette[4], size: 11 } })),
    }, { responsive: true, displaylogo: false, modeBarButtonsToRemove: ["select2d", "lasso2d", "toImage"] });
    open_clicked(this.#plot);
  }

  #forget() {
    if (this.#figure) plotly().then((library) => library.purge(this.#plot));
  }
}

/**
 * The range of curves that hardly change: round-off would fill an axis that is fitted to them.
 * @param {Series[]} series
 */
function flat_range(series) {
  const values = series.flatMap(({ y }) => Array.from(y).filter((value) => value !== null));
  const [low, high] = values.reduce(([least, most], value) => [Math.min(least, value), Math.max(most, value)], [Infinity, -Infinity]);
  const middle = (low + high) / 2;
  const half = FLAT * Math.abs(middle);
  return high - low < 2 * half ? { autorange: false, range: [middle - 2 * half, middle + 2 * half] } : {};
}

/**
 * Draws a plot anew where its place becomes wider or narrower.
 * @param {HTMLElement} plot
 * @param {AbortSignal} signal
 */
export function fit(plot, signal) {
  const observer = new ResizeObserver(async () => {
    const { _fullLayout: drawn } = /** @type {any} */ (plot);
    if (!drawn || plot.clientWidth === 0 || (drawn.width === plot.clientWidth && drawn.height === plot.clientHeight)) return;
    const library = await plotly();
    if (!signal.aborted) library.Plots.resize(plot);
  });
  observer.observe(plot);
  signal.addEventListener("abort", () => observer.disconnect());
}

/**
 * Buttons that save a plot as a picture, and as a table where it has one.
 * @param {HTMLElement} plot
 * @param {string} name of the files
 * @param {string} title
 * @param {() => string} [table]
 * @returns {HTMLElement}
 */
export function save_buttons(plot, name, title, table) {
  const button = (/** @type {string} */ text, /** @type {() => void} */ click) =>
    element("button", { type: "button", class: "quiet", click, "aria-label": `save ${title} as ${text}` }, text);
  return element("span", {}, button("SVG", () => save_image(plot, name, "svg")), button("PNG", () => save_image(plot, name, "png")),
    table && button("CSV", () => save(new Blob([table()], { type: "text/csv" }), `${name}.csv`)));
}

/**
 * Saves a plot as a picture.
 * @param {HTMLElement} plot
 * @param {string} name
 * @param {"svg" | "png"} format
 */
async function save_image(plot, name, format) {
  const library = await plotly();
  const size = { width: 900, height: 520, scale: format === "png" ? 2 : 1 };
  const { data, layout } = /** @type {any} */ (plot);
  const url = await library.toImage({ data, layout: { ...layout, paper_bgcolor: colour("--surface") } }, { format, ...size });
  const bytes = format === "svg"
    ? new Blob([decodeURIComponent(url.slice(url.indexOf(",") + 1))], { type: "image/svg+xml" })
    : new Blob([Uint8Array.from(atob(url.slice(url.indexOf(",") + 1)), (c) => c.charCodeAt(0))], { type: "image/png" });
  save(bytes, `${name}.${format}`);
}

/**
 * Lets a click on a point of a plot open the address that is its `customdata`.
 * @param {HTMLElement} plot
 */
export function open_clicked(plot) {
  if (plot.dataset.opens) return;
  plot.dataset.opens = "points";
  /** @type {any} */ (plot).on("plotly_click", (/** @type {any} */ { points }) => {
    const target = points.map((/** @type {any} */ point) => point.customdata).find((/** @type {unknown} */ one) => typeof one === "string");
    if (target) location.hash = target;
  });
}

/**
 * @param {Series} series
 * @param {string} colour
 */
function trace({ name, x, y, opacity = 1, dash = "solid", mode = "lines", symbol = "circle", texts, links }, colour) {
  const values = "%{x:.4~g}, %{y:.4~g}";
  return {
    type: "scatter", name, x, y, mode, opacity, line: { color: colour, width: 2, dash }, marker: { color: colour, size: links ? 9 : 6, symbol, line: { width: 2, color: colour } },
    text: texts, customdata: links, hovertemplate: texts ? `%{text}<br>${values}` : values,
  };
}

/**
 * The curves of a figure as CSV: name, x and y of each point.
 * @param {Figure} figure
 * @returns {string}
 */
export function as_table({ x, y, series }) {
  return csv(["curve", x.title, y.title], series.flatMap((curve) => Array.from(curve.x, (at, index) => [curve.name, at, curve.y[index] ?? ""])));
}
