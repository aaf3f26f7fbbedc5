// Worn profiles, tractions and the friction loop at the stored cycles, which a slider goes through.

import { Chart } from "../charts/chart.js";
import { fetch_json } from "../parts/client.js";
import { element } from "../parts/element.js";
import { count } from "../parts/format.js";
import { friction_loop } from "./loop.js";

const UM = 1e3;
/** Opacity of the earliest of several overlaid profiles; those after it stand out more and more. */
const FAINTEST = 0.35;
const PHASES = ["leftmost", "neutral", "rightmost"];

/** The charts of one cycle. */
export class SnapshotCharts {
  /** @type {number[]} */
  #cycles = [];
  /** @type {any} */
  #job;
  /** Documents by path: snapshots do not change. @type {Map<string, Promise<any>>} */
  #documents = new Map();
  #slider = /** @type {HTMLInputElement} */ (element("input", { type: "range", min: 0, max: 0, step: 1, "aria-label": "stored cycle" }));
  #shown = element("output");
  #overlay = /** @type {HTMLInputElement} */ (element("input", { type: "checkbox" }));
  #scale = /** @type {HTMLSelectElement} */ (element("select", {}, element("option", { value: "" }, "exaggerated"), element("option", { value: "equal" }, "to scale")));
  #state;
  #signal;

  /**
   * @param {{get: (name: string) => string | null, set: (name: string, value: string | null) => void}} state
   * @param {AbortSignal} signal
   */
  constructor(state, signal) {
    this.#state = state;
    this.#signal = signal;
    const chart = (/** @type {string} */ name) => new Chart({ name, signal, state });
    this.profile = chart("profile");
    this.pressure = chart("pressure");
    this.shear = chart("shear");
    this.loop = chart("loop");
    this.#slider.addEventListener("input", () => {
      state.set("cycle", String(this.#cycles[this.#slider.valueAsNumber]));
      this.#draw();
    });
    this.#overlay.addEventListener("change", () => {
      state.set("overlay", this.#overlay.checked ? "1" : null);
      this.#draw();
    });
    this.#scale.addEventListener("change", () => {
      state.set("scale", this.#scale.value);
      this.#draw();
    });
    this.node = element("section", { class: "snapshots", hidden: true, "aria-label": "stored cycles" },
      element("p", { class: "line" }, element("label", {}, "Cycle ", this.#slider), this.#shown, element("label", {}, this.#overlay, " all stored profiles"), element("label", {}, "Depths ", this.#scale)),
      element("div", { class: "charts" }, this.profile.node, this.pressure.node, this.shear.node, this.loop.node));
  }

  /**
   * Takes the cycles that are stored so far.
   * @param {any} job
   * @param {AbortSignal} signal
   */
  async load(job, signal) {
    const { files } = await fetch_json(job.links.results, { signal });
    const of_file = (/** @type {{name: string}} */ { name }) => Number(/^profile-(\d+)\.csv$/.exec(name)?.[1] ?? NaN);
    const cycles = [...new Set(files.map(of_file))].filter((cycle) => !Number.isNaN(cycle)).sort((a, b) => a - b);
    const is_new = cycles.length !== this.#cycles.length || job.id !== this.#job?.id;
    this.#job = job;
    if (cycles.length === 0 || !is_new) return;
    this.#cycles = cycles;
    this.#slider.max = String(cycles.length - 1);
    this.node.hidden = false;
    this.#place();
    await this.#draw();
  }

  /** Shows the cycle of the address. */
  follow_address() {
    this.#place();
    this.#draw();
  }

  #place() {
    this.#overlay.checked = this.#state.get("overlay") === "1";
    this.#scale.value = this.#state.get("scale") === "equal" ? "equal" : "";
    const asked = Number(this.#state.get("cycle") ?? NaN);
    const index = this.#cycles.findIndex((cycle) => cycle >= asked);
    this.#slider.value = String(index < 0 ? this.#cycles.length - 1 : index);
  }

  /**
   * @param {"profile" | "pressure" | "loop"} kind
   * @param {number} cycle
   */
  #document(kind, cycle) {
    const path = `${this.#job.links[kind]}?cycle=${cycle}`;
    const known = this.#documents.get(path) ?? fetch_json(path, { signal: this.#signal });
    this.#documents.set(path, known);
    return known;
  }

  async #draw() {
    const cycle = this.#cycles[this.#slider.valueAsNumber];
    if (cycle === undefined) return;
    this.#shown.textContent = `${count(cycle)} of ${count(this.#cycles[this.#cycles.length - 1])}`;
    const overlaid = this.#overlay.checked ? this.#cycles.filter((other) => other !== cycle) : [];
    const [pressure, loop, profile, ...others] = await Promise.all([
      this.#document("pressure", cycle), this.#document("loop", cycle),
      ...[cycle, ...overlaid].map((at) => this.#document("profile", at)),
    ]);
    // The reader may have gone on.
    if (cycle !== this.#cycles[this.#slider.valueAsNumber] || this.#signal.aborted) return;
    await Promise.all([
      this.profile.show({ ...profiles(profile, others), to_scale: this.#scale.value === "equal" }),
      this.pressure.show(tractions(pressure, "pressure", this.#job)),
      this.shear.show(tractions(pressure, "shear", this.#job)),
      this.loop.show(friction_loop(loop)),
    ]);
    this.loop.node.hidden = loop.displacement_mm.length === 0;
  }
}

/**
 * Worn depths of both bodies where they are worn.
 * @param {any} shown
 * @param {any[]} others
 * @returns {import("../charts/chart.js").Figure}
 */
function profiles(shown, others) {
  const sides = ["receptacle", "slider"];
  const curve = (/** @type {any} */ profile, /** @type {string} */ side, /** @type {boolean} */ is_other) => ({
    opacity: is_other ? FAINTEST + (1 - FAINTEST) * (others.indexOf(profile) / others.length) : 1,
    name: is_other ? `${side}, cycle ${profile.cycle}` : side,
    x: profile[side].x_mm.map((/** @type {number} */ x) => UM * x),
    y: profile[side].depth_mm.map((/** @type {number} */ depth) => UM * depth),
    colour: sides.indexOf(side),
    dash: /** @type {"solid" | "dot"} */ (is_other ? "dot" : "solid"),
  });
  const is_worn = (/** @type {string} */ side) => [shown, ...others].some((profile) => profile[side].depth_mm.some((/** @type {number} */ depth) => depth > 0));
  const worn = sides.filter(is_worn);
  return {
    title: `Worn profiles at cycle ${count(shown.cycle)}`,
    x: { title: "position along the surface, µm" },
    y: { title: "worn depth, µm", reversed: true },
    series: [...worn.map((side) => curve(shown, side, false)), ...others.flatMap((profile) => worn.map((side) => curve(profile, side, true)))].map(around_wear),
  };
}

/**
 * The part of a profile that is worn, and as much to either side.
 * @param {import("../charts/chart.js").Series} series
 */
function around_wear(series) {
  const worn = Array.from(series.y, (depth, index) => ((depth ?? 0) > 0 ? index : -1)).filter((index) => index >= 0);
  if (worn.length === 0) return { ...series, x: [], y: [] };
  const [first, last] = [worn[0], worn[worn.length - 1]];
  const margin = Math.max(2, Math.round(0.1 * (last - first)));
  const [from, to] = [Math.max(0, first - margin), last + margin + 1];
  return { ...series, x: Array.from(series.x).slice(from, to), y: Array.from(series.y).slice(from, to) };
}

/**
 * Pressures or shears at three positions of the slider; the unworn contact with Hertz' pressure.
 * @param {any} snapshot
 * @param {"pressure" | "shear"} what
 * @param {any} job
 * @returns {import("../charts/chart.js").Figure}
 */
function tractions(snapshot, what, job) {
  const at = PHASES.flatMap((phase) => snapshot.positions.filter((/** @type {any} */ position) => position.phase === phase));
  const series = at.map((/** @type {any} */ { phase, x_mm, ...values }) => ({
    name: phase, x: x_mm.map((/** @type {number} */ x) => UM * x), y: values[`${what}_mpa`], colour: PHASES.indexOf(phase),
  }));
  const { hertz_half_width_mm: half, hertz_peak_pressure_mpa: peak } = job.plan?.estimates ?? {};
  if (what === "pressure" && snapshot.cycle === 0 && half && peak) series.push(hertz(half, peak));
  return {
    title: `${what === "pressure" ? "Contact pressure" : "Shear"} at cycle ${count(snapshot.cycle)}`,
    x: { title: "position on the receptacle, µm" },
    y: { title: `${what}, MPa` },
    series,
  };
}

/**
 * Hertz' pressure of the unworn contact.
 * @param {number} half_width_mm
 * @param {number} peak_mpa
 */
function hertz(half_width_mm, peak_mpa) {
  const places = Array.from({ length: 101 }, (_, index) => index / 50 - 1);
  return { name: "Hertz", x: places.map((x) => UM * half_width_mm * x), y: places.map((x) => peak_mpa * Math.sqrt(1 - x * x)), dash: /** @type {const} */ ("dash"), colour: 7 };
}
