// What a job has worn so far, against cycles.

import { Chart } from "../charts/chart.js";
import { fetch_json } from "../parts/client.js";
import { has_ended } from "../parts/status.js";
import { store, stored } from "../parts/tab_storage.js";

/** Rows that are drawn at most; the service keeps the extremes of every column. */
const MOST_POINTS = 1000;
const UM = 1e3;
/** Colour of the curves of the first run beside those of a finer one. */
const FIRST_RUN_COLOUR = 7;

/**
 * @typedef {object} Drawn
 * @property {string} name
 * @property {string} title
 * @property {string} y
 * @property {(history: any, job: any) => import("../charts/chart.js").Series[]} series
 * @property {(job: any) => {y: number, name: string}[]} [limits]
 */

/** @type {Drawn[]} */
const CHARTS = [
  {
    name: "wear",
    title: "Deepest wear of both sides, and wear at the stations",
    y: "worn depth, µm",
    series: (history) => [
      ...["receptacle", "slider"].map((side) => ({ name: `${side}, deepest`, x: history.cycle, y: scaled(history[side].max_depth_mm, UM) })),
      ...history.stations.map((/** @type {any} */ { side, x_mm, depth_mm }, /** @type {number} */ index) =>
        ({ name: `${side} at ${Number((UM * x_mm).toPrecision(3))} µm`, x: history.cycle, y: scaled(depth_mm, UM), dash: "dot", colour: 2 + index })),
    ],
    limits: (job) => (job.summary?.life ?? []).filter((/** @type {any} */ { criterion, status }) => criterion.kind !== "resistance" && criterion.kind !== "exposed_fraction" && status === "reached")
      .map((/** @type {any} */ { criterion, side, limit }) => ({ y: UM * limit, name: `${criterion.kind.replaceAll("_", " ")}, ${side}` })),
  },
  {
    name: "half-width",
    title: "Width of the contact and of the scars",
    y: "half-width, µm",
    series: (history) => [
      { name: "contact", x: history.cycle, y: scaled(history.contact_half_width_mm, UM), colour: 3 },
      ...["receptacle", "slider"].map((side, index) => ({ name: `scar, ${side}`, x: history.cycle, y: scaled(history[side].scar_half_width_mm, UM), colour: index })),
    ],
  },
  {
    name: "peak-pressure",
    title: "Peak pressure at the neutral position",
    y: "pressure, MPa",
    series: (history) => [{ name: "peak pressure", x: history.cycle, y: history.peak_pressure_mpa }],
  },
  {
    name: "worn-area",
    title: "Worn area",
    y: "area, µm²",
    series: (history) => ["receptacle", "slider"].map((side) => ({ name: side, x: history.cycle, y: scaled(history[side].worn_area_mm2, UM * UM) })),
  },
  {
    name: "energy",
    title: "Energy dissipated in a cycle",
    y: "energy, mJ/mm",
    series: (history) => [{ name: "a cycle", x: history.cycle.slice(1), y: rates(history.cycle, history.dissipated_energy_mj_per_mm) }],
  },
  {
    name: "exposed",
    title: "Length on which a layer is worn through",
    y: "exposed length, µm",
    series: (history) => exposed(history).map(({ side, layer, length_mm }) => ({ name: layer_name(side, layer), x: history.cycle, y: scaled(length_mm, UM) })),
  },
  {
    name: "exposed-part",
    title: "Part of the scar on which a layer is worn through",
    y: "exposed part, %",
    series: (history) => exposed(history).map(({ side, layer, length_mm }) => ({ name: layer_name(side, layer), x: history.cycle, y: parts(length_mm, history[side].scar_half_width_mm) })),
  },
  {
    name: "remaining",
    title: "Plating that remains at the deepest place",
    y: "remaining thickness, µm",
    series: (history, job) => ["receptacle", "slider"].flatMap((side) => remaining(job.spec.plating?.[side] ?? [], history[side].max_depth_mm)
      .map(({ layer, y }) => ({ name: `${side}, layer ${layer}`, x: history.cycle, y }))),
  },
  {
    name: "dissipated",
    title: "Energy dissipated since the start",
    y: "energy, mJ/mm",
    series: (history) => [{ name: "sum", x: history.cycle, y: history.dissipated_energy_mj_per_mm }],
  },
  {
    name: "resistance",
    title: "Resistance of the contact",
    y: "resistance, mΩ",
    series: (history) => [["whole", "contact_resistance_mohm"], ["constriction, slider", "slider_constriction_mohm"], ["constriction, receptacle", "receptacle_constriction_mohm"], ["film", "film_resistance_mohm"],
      ["bulk of the slider", "slider_bulk_mohm"], ["bulk of the receptacle", "receptacle_bulk_mohm"]]
      .filter(([, column]) => history[column]?.some((/** @type {number | null} */ value) => value != null))
      .map(([name, column]) => ({ name, x: history.cycle, y: history[column] })),
  },
];

/**
 * @param {(number | null)[]} values
 * @param {number} factor
 */
function scaled(values, factor) {
  return values.map((value) => (value == null ? null : factor * value));
}

/**
 * The layers that are exposed at any time.
 * @param {any} history
 * @returns {{side: string, layer: number | null, length_mm: number[]}[]}
 */
function exposed(history) {
  return (history.exposed ?? []).filter((/** @type {any} */ { length_mm }) => length_mm.some((/** @type {number} */ length) => length > 0));
}

/**
 * @param {string} side
 * @param {number | null | undefined} layer
 */
function layer_name(side, layer) {
  return `${side}, ${layer == null ? "base metal" : `layer ${layer}`}`;
}

/**
 * Exposed lengths as parts of the scar, %; none where there is no scar.
 * @param {number[]} lengths
 * @param {number[]} half_widths
 */
function parts(lengths, half_widths) {
  return lengths.map((length, row) => (half_widths[row] > 0 ? (100 * length) / (2 * half_widths[row]) : 0));
}

/**
 * What is left of each layer where the wear is deepest, µm.
 * @param {any[]} layers from the surface down
 * @param {number[]} depths_mm
 */
function remaining(layers, depths_mm) {
  let top = 0;
  return layers.map(({ thickness_um, thickness_mm }, index) => {
    const thickness = thickness_um ?? UM * thickness_mm;
    const bottom = top + thickness;
    top = bottom;
    return { layer: index + 1, y: depths_mm.map((depth) => Math.min(thickness, Math.max(0, bottom - UM * depth))) };
  });
}

/**
 * Change of a sum in a cycle.
 * @param {number[]} cycles
 * @param {number[]} sums
 */
function rates(cycles, sums) {
  return sums.slice(1).map((sum, index) => (sum - sums[index]) / Math.max(cycles[index + 1] - cycles[index], 1));
}

/**
 * A curve of the coarser run before this one.
 * @param {import("../charts/chart.js").Series} series
 * @returns {import("../charts/chart.js").Series}
 */
function of_first_run(series) {
  return { ...series, name: `${series.name}, first run`, dash: "dash", opacity: 0.6, colour: FIRST_RUN_COLOUR };
}

/** The charts of a history; those without values are not shown. */
export class HistoryCharts {
  #charts;
  #key;
  /** What was loaded last, and of the first run if a finer one has begun. @type {any} */
  #loaded = null;
  /** @type {any} */
  #first_run = null;
  #is_finer = false;

  /**
   * @param {string} id of the job
   * @param {any} state of the axes
   * @param {AbortSignal} signal
   */
  constructor(id, state, signal) {
    this.#key = `first run ${id}`;
    this.#charts = CHARTS.map((drawn) => ({ drawn, chart: new Chart({ name: drawn.name, signal, state }) }));
    this.nodes = this.#charts.map(({ chart }) => chart.node);
    for (const node of this.nodes) node.hidden = true;
  }

  /** A finer run has begun: what this tab has loaded of the first one stays beside it. */
  first_run_ends() {
    if (this.#is_finer) return;
    this.#is_finer = true;
    if (this.#loaded) store(this.#key, this.#loaded);
    this.#first_run = this.#loaded ?? stored(this.#key);
  }

  /**
   * Loads what there is so far.
   * @param {any} job
   * @param {AbortSignal} signal
   */
  async load(job, signal) {
    const history = await fetch_json(`${job.links.wear_history}?max_points=${MOST_POINTS}`, { signal });
    if (history.cycle.length < 2) return;
    this.#loaded = history;
    // The whole run is drawn alone once it has ended.
    const first_run = has_ended(job) ? null : this.#first_run;
    await Promise.all(this.#charts.map(({ drawn, chart }) => {
      const series = [...drawn.series(history, job), ...(first_run ? drawn.series(first_run, job).map(of_first_run) : [])];
      chart.node.hidden = series.length === 0;
      if (series.length === 0) return null;
      return chart.show({
        title: drawn.title,
        x: { title: "cycle", can_log: true },
        y: { title: drawn.y, can_log: true },
        series,
        limits: drawn.limits?.(job),
      });
    }));
  }
}
