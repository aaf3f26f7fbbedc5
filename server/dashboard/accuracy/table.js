// All runs of an accuracy study with their settings, errors and costs, and which are still missing.

import { link } from "../parts/address.js";
import { card, element } from "../parts/element.js";
import { count, number, percent } from "../parts/format.js";
import { badge, progress_bar, refined } from "../parts/status.js";
import { ERRORS, error_of } from "./runs.js";

const HEAD = ["run", "status", "on the front", "element, µm", "increments a cycle", "jump, cycles", "sections", ...ERRORS.slice(1).map(([, title]) => `error of ${title}`), "processor time, s", "memory, MiB"];
const SECTIONS = HEAD.indexOf("sections");
const FIRST_NUMBER = HEAD.indexOf("element, µm");
const UM = 1e3;

/** The table. */
export class RunsTable {
  #body = element("tbody");
  #head = element("tr");
  /** Cells of the status by job. @type {Map<string, HTMLElement>} */
  #statuses = new Map();

  constructor() {
    this.node = card("Runs", element("div", { class: "scroll", tabindex: "0" }, element("table", { class: "points" }, element("thead", {}, this.#head), this.#body)));
  }

  /**
   * @param {any} study the comparison; null while there is none
   * @param {import("./runs.js").Run[]} runs
   */
  show(study, runs) {
    const has_sections = runs.some(({ stations, compared }) => (compared?.stations ?? stations) != null);
    const kept = (/** @type {any[]} */ cells) => cells.filter((_, column) => column !== SECTIONS || has_sections);
    this.#head.replaceChildren(...kept(HEAD.map((text, column) => element("th", { scope: "col", class: column >= FIRST_NUMBER && "number" }, text))));
    const focused = document.activeElement?.getAttribute("href");
    this.#statuses.clear();
    this.#body.replaceChildren(...runs.map((run) => {
      const status = element("td");
      this.#statuses.set(run.id, status);
      this.update(run);
      const texts = figures(run, study?.reference.uncertainty);
      return element("tr", { "data-job": run.id, class: run.compared?.on_front && "front" }, ...kept([
        element("td", {}, element("a", { href: link("job", run.id), class: "nowrap" }, run.tolerance === null ? "fixed settings" : `tolerance ${percent(run.tolerance)}`)),
        status, element("td", {}, run.compared?.on_front ? "yes" : ""), ...texts.map((text) => element("td", { class: "number" }, text)),
      ]));
    }));
    if (focused) /** @type {HTMLElement | null} */ (this.#body.querySelector(`a[href="${focused}"]`))?.focus();
  }

  /** @param {import("./runs.js").Run} run whose status has changed */
  update({ id, status, outcome, progress, compared }) {
    const running = status === "running" && progress ? [" ", progress_bar(progress.fraction, "progress"), ` ${refined(progress)}${percent(progress.fraction)}`] : [];
    const failure = compared?.failure ? element("div", { class: "reason", title: compared.failure }, compared.failure) : null;
    this.#statuses.get(id)?.replaceChildren(element("span", { class: "nowrap" }, badge({ status, outcome }), ...running), failure ?? "");
  }
}

/**
 * The settings that a run has used, its errors and costs.
 * @param {import("./runs.js").Run} run
 * @param {any} uncertainty of the reference
 * @returns {string[]}
 */
function figures({ compared, ...asked }, uncertainty) {
  const used = compared?.errors ? compared : asked;
  const error = (/** @type {string} */ name) => {
    const [found, bound] = [error_of(compared?.errors, name), error_of(uncertainty, name) ?? 0];
    if (found === null) return "";
    return found < bound ? `< ${percent(bound)}` : percent(found);
  };
  return [
    number(used.contact_element_mm, UM), count(used.increments_per_cycle), number(used.cycle_jump), count(used.stations),
    ...ERRORS.slice(1).map(([name]) => error(name)),
    compared?.errors ? number(compared.cpu_s) : "", compared?.errors ? number(compared.peak_memory_mb) : "",
  ];
}
