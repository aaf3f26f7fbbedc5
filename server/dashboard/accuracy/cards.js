// What an accuracy study says besides its diagram: the reference, the orders of convergence, what to choose.

import { link } from "../parts/address.js";
import { card, definitions, element, table } from "../parts/element.js";
import { duration, length, number, percent } from "../parts/format.js";
import { ERRORS, error_of, front } from "./runs.js";
import { asked_for, setting_in_words } from "./settings.js";

/** Errors for which the cheapest run is named. */
const TARGETS = [0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001];

/**
 * The solution that the runs are compared with, and how uncertain it is.
 * @param {any} reference
 * @param {string[]} left_out
 * @returns {HTMLElement}
 */
export function reference_card({ method, max_depth_mm, scar_half_width_mm, peak_pressure_mpa, worn_area_mm2, uncertainty, orders }, left_out) {
  const of = (/** @type {string} */ value, /** @type {number} */ share) => `${value} ± ${percent(share)}`;
  return card("Reference", element("p", {}, method),
    definitions([
      ["deepest wear", of(length(max_depth_mm), uncertainty.depth)],
      ["scar half-width", of(length(scar_half_width_mm), uncertainty.width)],
      ["peak pressure at the end", of(`${number(peak_pressure_mpa)} MPa`, uncertainty.peak_pressure)],
      ["worn area", of(`${number(worn_area_mm2, 1e6)} µm²`, uncertainty.area)],
    ]),
    element("p", { class: "muted small" }, orders.length > 0
      ? "Its uncertainty is the size of all corrections that lead from the finest run to it."
      : "Its uncertainty is that tolerance, until the runs of the grid lead to a better one."),
    left_out.length > 0 && element("details", {}, element("summary", {}, left_out.length === 1 ? "one run left out" : `${left_out.length} runs left out`), element("ul", {}, ...left_out.map((text) => element("li", {}, text)))));
}

/**
 * The observed orders of convergence.
 * @param {any[]} orders
 * @returns {HTMLElement}
 */
export function orders_card(orders) {
  const written = (/** @type {number | null} */ order) => (order === null ? "–" : order.toFixed(2));
  const rows = orders.map(({ setting, levels, depth, width, peak_pressure, area }) => [...setting_in_words(setting, levels), ...[depth, width, peak_pressure, area].map(written)]);
  return card("Observed orders of convergence",
    rows.length
      ? table({ head: ["setting", "levels, finest first", ...ERRORS.slice(1).map(([, title]) => title)], rows, numbers: [2, 3, 4, 5] })
      : element("p", {}, "They need the runs of the grid at three levels of a setting."),
    element("p", { class: "muted small" }, "Halving the step of a setting of order p divides its error by 2 to the power p; – where three levels do not approach a limit from one side."));
}

/**
 * Which tolerances the runs at tolerances have kept. The reference is uncertain by the bound, and so are the errors.
 * @param {import("./runs.js").Run[]} runs
 * @param {number} bound uncertainty of the reference
 * @returns {HTMLElement | null}
 */
function kept_tolerances(runs, bound) {
  const compared = runs.flatMap(({ tolerance, compared }) => (tolerance !== null && compared?.errors ? [{ tolerance, error: error_of(compared.errors, "tolerance") ?? 0 }] : []));
  const named = (/** @type {(one: {tolerance: number, error: number}) => boolean} */ includes) => compared.filter(includes).map(({ tolerance }) => percent(tolerance)).join(", ") || null;
  if (compared.length === 0) return null;
  return definitions([
    ["tolerances kept", named(({ tolerance, error }) => error <= tolerance)],
    ["not told by this reference", named(({ tolerance, error }) => error > tolerance && error <= tolerance + bound)],
    ["tolerances not kept", named(({ tolerance, error }) => error > tolerance + bound)],
  ]);
}

/**
 * The cheapest run for each error that can be told from the uncertainty of the reference.
 * @param {any} study
 * @param {import("./runs.js").Run[]} runs
 * @returns {HTMLElement}
 */
export function choice_card({ reference }, runs) {
  const bound = error_of(reference.uncertainty, "tolerance") ?? 0;
  const cheapest = front(runs);
  const chosen = [...TARGETS.filter((target) => target > bound), bound].flatMap((target) => {
    const run = cheapest.find(({ compared }) => (error_of(compared.errors, "tolerance") ?? Infinity) <= target);
    return run ? [{ target, run }] : [];
  });
  const rows = chosen.map(({ target, run }) => [
    percent(target), element("a", { href: link("job", run.id) }, asked_for(run)), percent(Math.max(error_of(run.compared.errors, "tolerance") ?? 0, bound)),
    duration(run.compared.cpu_s), element("a", { href: link("study", null, { from: run.id }), "aria-label": `clone the run for ${percent(target)}` }, "clone"),
  ]);
  return card("What to choose", rows.length
    ? table({ head: ["error at most", "cheapest run", "its error", "time", ""], rows, numbers: [0, 2, 3] })
    : element("p", {}, "No run has an error that can be told from the uncertainty of the reference, or none of 10 % or less."),
  kept_tolerances(runs, bound),
  element("p", { class: "muted small" }, `Errors of depth and width, and processor time, of the runs on the Pareto front. Errors below ${percent(bound)}, the uncertainty of the reference, cannot be told apart.`));
}
