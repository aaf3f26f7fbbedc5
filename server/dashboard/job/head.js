// What a job is and what it does now, and what can be done with it.

import { link } from "../parts/address.js";
import { fetch_json } from "../parts/client.js";
import { download_link } from "../parts/download.js";
import { definitions, element } from "../parts/element.js";
import { count, duration, duration_range, percent, seconds_between, time, words } from "../parts/format.js";
import { badge, has_ended, progress_bar } from "../parts/status.js";

/** The head of a job's page. */
export class Head {
  #status = element("div", { class: "status", "aria-live": "polite" });
  #actions = element("p", { class: "actions" });
  #said = element("span", { role: "status" });
  /** @type {any} */
  #job;

  /** @param {any} job */
  constructor(job) {
    this.#job = job;
    const { name, system, labels } = job.spec;
    const shown = Object.entries(labels ?? {}).map(([key, value]) => element("span", { class: "label" }, `${key}: ${value}`));
    this.node = element("section", { class: "head" },
      element("h1", {}, name ?? words(system.kind)),
      element("p", { class: "muted" }, words(system.kind), " · ", element("code", {}, job.id), " ", ...shown),
      this.#status, this.#actions);
    this.update(job);
  }

  /** @param {any} job */
  update(job) {
    this.#job = job;
    this.#show(job.progress);
    const { self } = job.links;
    const button = (/** @type {string} */ text, /** @type {string} */ method, /** @type {string} */ path, /** @type {() => void} */ then) =>
      element("button", { type: "button", click: () => this.#act(method, path, then) }, text);
    this.#actions.replaceChildren(...(has_ended(job)
      ? [
        job.summary ? download_link(`${self}/results/archive`, `fretwear-${job.id}.zip`, "All results (zip)") : "",
        job.status === "succeeded" ? "" : button("Run again", "POST", `${self}/retry`, () => location.reload()),
        element("a", { href: link("study", null, { from: job.id }) }, "Clone and change"),
        button("Delete", "DELETE", self, () => (location.hash = "#/jobs")),
      ]
      : [button("Cancel", "POST", `${self}/cancel`, () => {})]), this.#said);
  }

  /** @param {any} progress */
  progress(progress) {
    this.#show({ ...this.#job.progress, ...progress });
  }

  /** @param {any} progress */
  #show(progress) {
    const job = this.#job;
    const ended = has_ended(job);
    const { phase, stage, reason, cycle, cycles, fraction, eta_s, eta_most_s } = progress;
    const is_refined = stage === "refined";
    const running = ended ? [] : [
      is_refined && progress_bar(1, "progress of the first run"),
      progress_bar(fraction, is_refined ? "progress of the finer run" : "progress"),
      element("span", {}, `${is_refined ? "refined · " : ""}${percent(fraction)} · cycle ${count(cycle)} of ${count(cycles)}${phase ? ` · ${words(phase)}` : ""}${eta_s == null ? "" : ` · ${duration_range(eta_s, eta_most_s)} left`}`),
    ];
    const taken = job.started_at && job.finished_at ? duration(seconds_between(job.started_at, job.finished_at)) : null;
    this.#status.replaceChildren(
      element("p", { class: "line" }, badge(job), ...running, job.status === "succeeded" ? "" : element("span", {}, job.status_reason ?? "")),
      reason && !ended ? element("p", { class: "again" }, is_refined ? `Solved again, finer: ${reason}.` : `Begun again at cycle 0: ${reason}.`) : "",
      definitions([
        ["submitted", time(job.created_at)], ["started", time(job.started_at)], ["ended", time(job.finished_at)],
        ["duration", taken], ["attempts", String(job.attempts)],
      ]));
  }

  /**
   * @param {string} method
   * @param {string} path
   * @param {() => void} then
   */
  async #act(method, path, then) {
    if (method === "DELETE" && !confirm("Delete this job with its results?")) return;
    try {
      await fetch_json(path, { method });
      this.#said.textContent = "";
      then();
    } catch (error) {
      this.#said.textContent = error instanceof Error ? error.message : String(error);
    }
  }
}
