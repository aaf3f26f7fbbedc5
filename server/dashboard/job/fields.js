// The von Mises stress within both bodies, worn and under load, at the stored cycles.

import { fit, save_buttons } from "../charts/chart.js";
import { plotly } from "../charts/library.js";
import { when_seen } from "../charts/seen.js";
import { axis, colour, layout, on_theme } from "../charts/theme.js";
import { send } from "../parts/client.js";
import { download_link } from "../parts/download.js";
import { element } from "../parts/element.js";
import { count, number } from "../parts/format.js";
import { throttled } from "../parts/throttled.js";
import { on_grid, outline, sections } from "./section.js";
import { read_vtu } from "./vtu.js";

const ARRAYS = ["Points", "displacement_mm", "von_mises_mpa", "connectivity", "offsets", "types"];
const UM = 1e3;
/** Half of the width that is shown, over that of the contact. */
const NEAR = /** @type {Record<string, number>} */ ({ contact: 4, surroundings: 16 });
/** Pause after a zoom before its picture is computed, ms. */
const ZOOM_MS = 60;
/** Size of a file that a browser still reads at once; larger ones are listed among the files. */
const MOST_BYTES = 64e6;
/** Pixels of a value of the picture. */
const FINE = 2;

/** The stresses of a job. */
export class Fields {
  /** Paths by cycle and position. @type {Map<string, string>} */
  #paths = new Map();
  /** Sections by path: files do not change. @type {Map<string, Promise<import("./section.js").Section[]>>} */
  #files = new Map();
  #plot = element("div", { class: "plot tall" });
  #title = element("h3");
  #file = element("span");
  #said = element("p", { role: "status", class: "muted" });
  #choices = /** @type {Record<string, HTMLSelectElement>} */ ({});
  #state;
  #signal;
  /** @type {any} */
  #job;
  /** @type {import("./section.js").Section | null} */
  #section = null;
  #refine;
  #redraw;
  #listens = false;

  /**
   * @param {{get: (name: string) => string | null, set: (name: string, value: string | null) => void}} state
   * @param {AbortSignal} signal
   */
  constructor(state, signal) {
    this.#state = state;
    this.#signal = signal;
    const choice = (/** @type {string} */ name, /** @type {string} */ text, /** @type {string[]} */ ...values) => {
      const node = /** @type {HTMLSelectElement} */ (element("select", {}, ...values.map((value) => element("option", {}, value))));
      node.addEventListener("change", () => {
        state.set(name, node.value);
        this.#redraw();
      });
      this.#choices[name] = node;
      return element("label", {}, `${text} `, node);
    };
    const tools = element("p", { class: "line" }, choice("field", "Stress at cycle"), choice("position", "position", "leftmost", "neutral", "rightmost"),
      choice("view", "view", "contact", "surroundings", "bodies"), choice("section", "section"), this.#file);
    this.#refine = throttled(() => this.#draw_range(), ZOOM_MS, signal);
    this.node = element("section", { class: "stresses", hidden: true, "aria-label": "stresses" }, tools,
      element("figure", { class: "chart", "data-chart": "stress" }, element("figcaption", {}, this.#title, element("div", { class: "tools" }, save_buttons(this.#plot, "stress", "the stress"))), this.#plot, this.#said));
    this.#redraw = when_seen(this.node, () => this.#draw(), signal);
    on_theme(this.#redraw, signal);
    fit(this.#plot, signal);
    signal.addEventListener("abort", () => this.#section && plotly().then((library) => library.purge(this.#plot)));
  }

  /**
   * @param {any} job
   * @param {any} listed manifest of the results
   */
  async load(job, { files, links }) {
    this.#job = job;
    for (const { name } of files.filter((/** @type {any} */ { bytes }) => bytes <= MOST_BYTES)) {
      const [, cycle, position = "neutral"] = /^fields-(\d+)(?:-(\w+))?\.vtu$/.exec(name) ?? [];
      if (cycle !== undefined) this.#paths.set(`${cycle} ${position}`, links[name]);
    }
    if (this.#paths.size === 0 || this.#signal.aborted) return;
    const cycles = [...new Set([...this.#paths.keys()].map((key) => Number(key.split(" ")[0])))].sort((a, b) => a - b);
    this.#choices.field.replaceChildren(...cycles.map((cycle) => element("option", { value: cycle }, count(cycle))));
    this.#choices.field.value = String(cycles[cycles.length - 1]);
    this.#choices.position.value = "neutral";
    this.node.hidden = false;
    await this.follow_address();
  }

  /** Shows what the address asks for. */
  async follow_address() {
    if (this.node.hidden) return;
    for (const name of ["field", "position", "view"]) {
      const asked = this.#state.get(name);
      if ([...this.#choices[name].options].some(({ value }) => value === asked)) this.#choices[name].value = asked ?? "";
    }
    await this.#redraw();
  }

  get #is_ring() {
    return (this.#job.spec.model?.chosen ?? this.#job.spec.model?.dimension) === "ring";
  }

  /** @param {string} path @returns {Promise<import("./section.js").Section[]>} */
  #sections(path) {
    const is_ring = this.#is_ring;
    const read = async () => {
      const response = await send(path, { signal: this.#signal });
      if (!response.ok) throw new Error(`the fields could not be loaded: ${response.status}`);
      return sections(await read_vtu(await response.arrayBuffer(), ARRAYS), is_ring);
    };
    const known = this.#files.get(path) ?? read();
    this.#files.set(path, known);
    return known;
  }

  async #draw() {
    const { field, position, section: places } = this.#choices;
    // The unworn state is stored at the neutral position only.
    const key = this.#paths.has(`${field.value} ${position.value}`) ? `${field.value} ${position.value}` : `${field.value} neutral`;
    const path = this.#paths.get(key);
    if (!path || this.node.hidden) return;
    const found = await this.#sections(path);
    if (this.#signal.aborted || field.value !== key.split(" ")[0]) return;
    this.#place(found);
    this.#section = found[Number(places.value)];
    const shown = key.split(" ")[1];
    this.#title.textContent = `Von Mises stress at cycle ${count(Number(field.value))}, ${shown} position, to scale`;
    this.#file.replaceChildren(download_link(path, path.split("/").pop() ?? "", "file for ParaView"));
    this.#said.textContent = shown === position.value ? "" : `Of cycle ${field.value} only the neutral position is stored.`;
    await this.#show(this.#section, `${this.#choices.view.value} ${places.value}`);
  }

  /** @param {import("./section.js").Section[]} found */
  #place(found) {
    const { section: places } = this.#choices;
    /** @type {HTMLElement} */ (places.parentElement).hidden = found.length < 2;
    if (places.options.length === found.length) return;
    places.replaceChildren(...found.map(({ at }, index) => element("option", { value: index }, this.#is_ring ? `${number(at)}°` : `${number(at, UM)} µm`)));
    const middle = found.reduce((best, { at }, index) => (Math.abs(at) < Math.abs(found[best].at) ? index : best), 0);
    places.value = String(Math.min(Number(this.#state.get("section") ?? middle), found.length - 1));
  }

  /**
   * Draws a section anew; the zoom of the reader stays while the view is the same.
   * @param {import("./section.js").Section} section
   * @param {string} view
   */
  async #show(section, view) {
    const library = await plotly();
    const edges = outline(section);
    const range = this.#range(section);
    const most = section.faces.flat().reduce((largest, node) => Math.max(largest, section.values[node]), 0);
    await library.react(this.#plot, [
      { type: "heatmap", ...on_grid(section, range, 2, 2), zmin: 0, zmax: most, colorscale: "Viridis", hoverongaps: false, colorbar: { title: { text: "von Mises stress, MPa", side: "right" }, thickness: 14, outlinewidth: 0, len: 0.92, y: 0, yanchor: "bottom" }, hovertemplate: "%{x:.5~g} µm, %{y:.5~g} µm: %{z:.4~g} MPa<extra></extra>" },
      { type: "scatter", ...edges, mode: "lines", line: { color: colour("--text"), width: 1 }, hoverinfo: "skip", showlegend: false },
    ], {
      ...layout(),
      uirevision: view,
      dragmode: "pan",
      xaxis: { ...axis(this.#is_ring ? "outward from the axis of the ring, µm" : "along the motion, µm", false), range: range.x, showgrid: false, zeroline: false },
      yaxis: { ...axis("height, µm", false), range: range.y, scaleanchor: "x", showgrid: false, zeroline: false },
    }, { responsive: true, displaylogo: false, scrollZoom: true });
    if (!this.#listens) /** @type {any} */ (this.#plot).on("plotly_relayout", () => this.#refine());
    this.#listens = true;
    await this.#draw_range();
  }

  /** @param {import("./section.js").Section} section @returns {{x: [number, number], y: [number, number]}} */
  #range({ faces, x, y, values }) {
    const nodes = [...new Set(faces.flat())];
    const half = NEAR[this.#choices.view.value] * UM * Math.max(this.#job.summary?.contact_half_width_mm ?? 0, this.#job.summary?.initial.contact_half_width_mm ?? 0);
    if (half) {
      const middle = nodes.reduce((best, node) => (values[node] > values[best] ? node : best), nodes[0]);
      return { x: [x[middle] - half, x[middle] + half], y: [y[middle] - half / 2, y[middle] + half / 2] };
    }
    const ends = (/** @type {Float64Array} */ of) => /** @type {[number, number]} */ (nodes.reduce(([low, high], node) => [Math.min(low, of[node]), Math.max(high, of[node])], [Infinity, -Infinity]));
    return { x: ends(x), y: ends(y) };
  }

  /** Computes the picture of the range that is shown. */
  async #draw_range() {
    const library = await plotly();
    const { _fullLayout: shown } = /** @type {any} */ (this.#plot);
    if (!this.#section || this.#signal.aborted || !shown) return;
    const { xaxis, yaxis } = shown;
    const [columns, rows] = [xaxis._length, yaxis._length].map((length) => Math.max(2, Math.round(length / FINE)));
    const { x0, dx, y0, dy, z } = on_grid(this.#section, { x: xaxis.range, y: yaxis.range }, columns, rows);
    await library.restyle(this.#plot, { x0: [x0], dx: [dx], y0: [y0], dy: [dy], z: [z] }, [0]);
  }
}
