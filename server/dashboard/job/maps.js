// Maps of worn depth and pressure over the area of a contact, at the stored cycles.

import { fit, save_buttons } from "../charts/chart.js";
import { plotly } from "../charts/library.js";
import { when_seen } from "../charts/seen.js";
import { axis, layout, on_theme } from "../charts/theme.js";
import { fetch_json } from "../parts/client.js";
import { csv } from "../parts/csv.js";
import { element } from "../parts/element.js";
import { count } from "../parts/format.js";

const UM = 1e3;
/** What is drawn: name, field of the document, its values and the unit they are shown in. */
const DRAWN = /** @type {const} */ ([
  ["Worn depth of the receptacle, µm", "receptacle", "depth_mm", UM],
  ["Worn depth of the slider, µm", "slider", "depth_mm", UM],
  ["Contact pressure, MPa", "contact", "pressure_mpa", 1],
]);

/** The maps of a job. */
export class Maps {
  /** @type {Map<number, string>} */
  #paths = new Map();
  #plots = DRAWN.map(() => element("div", { class: "plot" }));
  #choice = /** @type {HTMLSelectElement} */ (element("select", { "aria-label": "cycle of the maps" }));
  #signal;
  #redraw;
  /** @type {any} */
  #shown = null;

  /**
   * @param {{get: (name: string) => string | null, set: (name: string, value: string | null) => void}} state
   * @param {AbortSignal} signal
   */
  constructor(state, signal) {
    this.#signal = signal;
    this.#choice.addEventListener("change", () => {
      state.set("map", this.#choice.value);
      this.#load();
    });
    this.#choice.dataset.asked = state.get("map") ?? "";
    for (const plot of this.#plots) fit(plot, signal);
    this.node = element("section", { class: "maps", hidden: true, "aria-label": "maps" },
      element("p", { class: "line" }, element("label", {}, "Maps at cycle ", this.#choice)),
      element("div", { class: "charts" }, ...DRAWN.map(([title], index) =>
        element("figure", { class: "chart" }, element("figcaption", {}, element("h3", {}, title), this.#tools(index)), this.#plots[index]))));
    this.#redraw = when_seen(this.node, () => this.#draw(), signal);
    on_theme(this.#redraw, signal);
  }

  /**
   * @param {any} listed manifest of the results
   * @param {AbortSignal} signal
   */
  async load({ files, links }, signal) {
    for (const { name } of files) {
      const cycle = /^maps-(\d+)\.json$/.exec(name)?.[1];
      if (cycle !== undefined) this.#paths.set(Number(cycle), links[name]);
    }
    if (this.#paths.size === 0 || signal.aborted) return;
    const cycles = [...this.#paths.keys()].sort((a, b) => a - b);
    this.#choice.replaceChildren(...cycles.map((cycle) => element("option", { value: cycle }, count(cycle))));
    this.#choice.value = this.#choice.dataset.asked || String(cycles[cycles.length - 1]);
    this.node.hidden = false;
    await this.#load();
  }

  async #load() {
    const path = this.#paths.get(Number(this.#choice.value));
    if (!path) return;
    this.#shown = await fetch_json(path, { signal: this.#signal });
    await this.#redraw();
  }

  /** @param {number} index of what is drawn */
  #tools(index) {
    const [title, part, field] = DRAWN[index];
    return element("div", { class: "tools" }, save_buttons(this.#plots[index], `map-${part}`, title, () => {
      const { across, x, y, map } = values(this.#shown, part);
      const rows = map.x_mm.flatMap((/** @type {number} */ along, /** @type {number} */ row) => across.map((at, column) => [UM * along, at, map[field][row][column]]));
      return csv([y, x, field], rows);
    }));
  }

  async #draw() {
    if (!this.#shown || this.#signal.aborted) return;
    const library = await plotly();
    await Promise.all(DRAWN.map(([, part, field, factor], index) => {
      const { across, x, y, map } = values(this.#shown, part);
      const z = map[field].map((/** @type {number[]} */ row) => row.map((value) => factor * value));
      const is_empty = z.length === 0 || z.every((/** @type {number[]} */ row) => row.every((value) => value === 0));
      /** @type {HTMLElement} */ (this.#plots[index].parentElement).hidden = is_empty;
      if (is_empty) return null;
      return library.react(this.#plots[index], [{
        type: "heatmap", x: across, y: map.x_mm.map((/** @type {number} */ x) => UM * x), z, colorscale: "Viridis", hovertemplate: "%{x:.4~g}, %{y:.4~g}: %{z:.4~g}<extra></extra>",
      }], {
        ...layout(),
        xaxis: axis(x, false),
        yaxis: axis(y, false),
      }, { responsive: true, displaylogo: false });
    }));
  }
}

/**
 * A map with its places across the motion, and the titles of its axes.
 * @param {any} maps
 * @param {string} part
 * @returns {{across: number[], x: string, y: string, map: any}}
 */
function values(maps, part) {
  const map = maps[part];
  if (map.theta_deg?.length) return { across: map.theta_deg, x: "angle from the motion, °", y: "outward from the centre line, µm", map };
  return { across: (map.z_mm ?? []).map((/** @type {number} */ z) => UM * z), x: "across the motion, µm", y: "along the motion, µm", map };
}
