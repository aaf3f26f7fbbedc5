// The work-precision diagram: errors of the runs over what they cost, both axes logarithmic.

import { Chart } from "../charts/chart.js";
import { address, change, choices, link } from "../parts/address.js";
import { element } from "../parts/element.js";
import { length } from "../parts/format.js";
import { ERRORS, error_of, front_of } from "./runs.js";
import { asked_for } from "./settings.js";

/** What a run costs: name in the comparison and title. */
const COSTS = /** @type {const} */ ([["cpu_s", "processor time, s"], ["peak_memory_mb", "memory, MiB"]]);
/** Relative difference of element sizes that are the same level. */
const SAME_LEVEL = 1e-6;
/** Numbers of the colours of lines that are no level. */
const [FRONT, TOLERANCES, BELOW] = [7, 0, 6];
const LEVELS = [1, 2, 3, 4, 5];

/** @typedef {import("./runs.js").Run} Run */

/** The diagram with its choices. */
export class Diagram {
  #chart;
  #error = choice("error", ERRORS);
  #cost = choice("cost", COSTS);

  /** @param {AbortSignal} signal */
  constructor(signal) {
    this.#chart = new Chart({ name: "work-precision", signal, state: choices });
    this.node = element("section", { class: "view", hidden: true, "aria-label": "work-precision diagram" },
      element("p", { class: "line" }, element("label", {}, "Error of ", this.#error), element("label", {}, "over ", this.#cost), element("span", { class: "muted" }, "A click on a point opens its job.")),
      this.#chart.node);
  }

  /**
   * @param {any} study the comparison; null while there is none
   * @param {Run[]} runs
   */
  async show(study, runs) {
    this.node.hidden = study === null;
    if (study === null) return;
    const { values } = address();
    const [error, error_title] = ERRORS.find(([name]) => name === values.get("error")) ?? ERRORS[0];
    const [cost, cost_title] = COSTS.find(([name]) => name === values.get("cost")) ?? COSTS[0];
    this.#error.value = error;
    this.#cost.value = cost;
    const bound = error_of(study.reference.uncertainty, error) ?? 0;
    await this.#chart.show({
      title: "What accuracy costs",
      x: { title: cost_title, can_log: true, log: true },
      y: { title: `error of ${error_title}, %`, can_log: true, log: true },
      series: series(runs.filter(({ compared }) => compared?.errors), error, cost, bound),
      limits: bound > 0 ? [{ y: 100 * bound, name: "uncertainty of the reference" }] : [],
    });
  }
}

/**
 * The points of each level of the element, those at tolerances, those whose error is only bounded, and the front.
 * @param {Run[]} runs that have errors
 * @param {string} error
 * @param {"cpu_s" | "peak_memory_mb"} cost
 * @param {number} bound uncertainty of the reference
 * @returns {import("../charts/chart.js").Series[]}
 */
function series(runs, error, cost, bound) {
  const shown = (/** @type {Run} */ { compared }) => Math.max(error_of(compared.errors, error) ?? 0, bound);
  const is_below = (/** @type {Run} */ { compared }) => (error_of(compared.errors, error) ?? 0) < bound;
  const of = (/** @type {string} */ name, /** @type {Run[]} */ some, /** @type {Partial<import("../charts/chart.js").Series>} */ style) => ({
    name, x: some.map(({ compared }) => compared[cost]), y: some.map((run) => 100 * shown(run)), mode: /** @type {const} */ ("markers"),
    texts: some.map((run) => `${asked_for(run)}${is_below(run) ? "<br>below the uncertainty of the reference" : ""}`), links: some.map(({ id }) => link("job", id)), ...style,
  });
  const above = runs.filter((run) => !is_below(run));
  const fixed = above.filter(({ tolerance }) => tolerance === null);
  const sizes = runs.filter(({ tolerance }) => tolerance === null).map(({ contact_element_mm }) => contact_element_mm ?? 0).sort((a, b) => b - a);
  const levels = sizes.filter((size, index) => index === 0 || Math.abs(size / sizes[index - 1] - 1) > SAME_LEVEL);
  const all = [
    of("Pareto front", front_of(runs, ({ compared }) => compared[cost], shown), { mode: "lines", colour: FRONT }),
    ...levels.map((size, index) => of(`elements ${length(size)}`, fixed.filter(({ contact_element_mm }) => Math.abs((contact_element_mm ?? 0) / size - 1) <= SAME_LEVEL), { colour: LEVELS[index % LEVELS.length] })),
    of("chosen from a tolerance", above.filter(({ tolerance }) => tolerance !== null), { colour: TOLERANCES, symbol: "diamond" }),
    of("error below the uncertainty", runs.filter(is_below), { colour: BELOW, symbol: "circle-open" }),
  ];
  return all.filter(({ x }) => x.length > 0);
}

/**
 * A choice of the address.
 * @param {string} name
 * @param {readonly (readonly [string, string])[]} options
 */
function choice(name, options) {
  const node = /** @type {HTMLSelectElement} */ (element("select", { id: `choice-${name}`, change: () => change({ [name]: node.value }) }, ...options.map(([value, text]) => element("option", { value }, text))));
  return node;
}
