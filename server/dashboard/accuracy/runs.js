// The runs of an accuracy study: its jobs with what the comparison says of each.

/**
 * @typedef {object} Run
 * @property {string} id of its job
 * @property {string} status
 * @property {string | null} outcome
 * @property {any} [progress]
 * @property {number | null} tolerance
 * @property {number | null} contact_element_mm
 * @property {number | null} increments_per_cycle
 * @property {number | null} cycle_jump
 * @property {number | null} stations
 * @property {any} compared the run in the comparison; null while it is missing there
 */

/**
 * What tells the runs of a study from each other: the tolerance, or the fixed settings.
 * @param {any} run a job of a study, or a run of its comparison
 * @returns {string}
 */
function key({ tolerance, contact_element_mm, increments_per_cycle, cycle_jump, stations }) {
  return tolerance == null ? [contact_element_mm, increments_per_cycle, cycle_jump, stations ?? ""].join(" ") : `tolerance ${tolerance}`;
}

/**
 * The jobs of a study with their parts of the comparison.
 * @param {{jobs: any[], study: any}} document
 * @returns {Run[]}
 */
export function runs_of({ jobs, study }) {
  const compared = new Map((study?.runs ?? []).map((/** @type {any} */ run) => [key(run), run]));
  return jobs.map((job) => ({ ...job, compared: compared.get(key(job)) ?? null }));
}

/** The errors of a run: name in the address and title. The first one is what a tolerance bounds, by which the front is chosen. */
export const ERRORS = /** @type {const} */ ([
  ["tolerance", "depth and width"], ["depth", "worn depth"], ["width", "scar half-width"], ["peak_pressure", "peak pressure"], ["area", "worn area"],
]);

/**
 * An error by its name.
 * @param {any} errors
 * @param {string} name
 * @returns {number | null}
 */
export function error_of(errors, name) {
  if (!errors) return null;
  return name === "tolerance" ? Math.max(errors.depth, errors.width) : errors[name];
}

/**
 * The runs that have a smaller error than every cheaper one, cheapest first.
 * @param {Run[]} runs
 * @param {(run: Run) => number} cost
 * @param {(run: Run) => number} error errors that cannot be told apart must be equal
 * @returns {Run[]}
 */
export function front_of(runs, cost, error) {
  let best = Infinity;
  return [...runs].sort((a, b) => cost(a) - cost(b)).filter((run) => {
    const is_better = error(run) < best;
    best = Math.min(best, error(run));
    return is_better;
  });
}

/**
 * The runs on the Pareto front of the service, in depth and width over processor time, cheapest first.
 * @param {Run[]} runs
 * @returns {Run[]}
 */
export function front(runs) {
  return runs.filter(({ compared }) => compared?.on_front).sort((a, b) => a.compared.cpu_s - b.compared.cpu_s);
}
