// What a batch is and how far it is, and what can be done with it.

import { link } from "../parts/address.js";
import { comparison_link } from "../parts/comparison.js";
import { download_link } from "../parts/download.js";
import { definitions, element } from "../parts/element.js";
import { count, duration, seconds_between, time } from "../parts/format.js";
import { end_button } from "./actions.js";
import { counts_line, counts_with_later, progress, progress_line, state_badge } from "./counts.js";
import { KINDS, name_of } from "./kinds.js";

/** The head of a batch's page. */
export class Head {
  #status = element("div", { class: "status", "aria-live": "polite" });
  #actions = element("p", { class: "actions" });
  #said = element("span", { role: "status" });
  #kind;
  #reload;
  #shown = "";

  /**
   * @param {any} batch
   * @param {import("./kinds.js").Kind} kind
   * @param {() => void} reload
   */
  constructor(batch, kind, reload) {
    this.#kind = kind;
    this.#reload = reload;
    this.node = element("section", { class: "head" },
      element("h1", {}, name_of(batch, kind)),
      element("p", { class: "muted" }, KINDS[kind].name, " · ", element("code", {}, batch.id)),
      this.#status, this.#actions);
    this.update(batch);
  }

  /** @param {any} batch */
  update(batch) {
    const counts = counts_with_later(batch);
    const { never_queued } = batch;
    const shown = JSON.stringify([counts, never_queued]);
    if (shown === this.#shown) return;
    this.#shown = shown;
    const name = name_of(batch, this.#kind);
    this.#status.replaceChildren(
      element("p", { class: "line" }, state_badge(counts), progress(counts) < 1 && progress_line(counts, name), counts_line(counts)),
      definitions([
        ["submitted", `${time(batch.created_at)}, ${duration(Math.round(seconds_between(batch.created_at)))} ago`],
        ["never queued", never_queued > 0 ? `${count(never_queued)} jobs: the sweep was cancelled before` : null],
      ]));
    this.#actions.replaceChildren(...this.#links(batch),
      end_button(batch, this.#kind, { said: this.#said, cancelled: this.#reload, deleted: () => (location.hash = link("sweeps")) }), this.#said);
  }

  /** @param {any} batch */
  #links({ id, jobs }) {
    const { path, table, name } = KINDS[this.#kind];
    const file = `${name.replace(" ", "-")}-${id}`;
    const comparison = comparison_link(jobs.map((/** @type {{id: string}} */ job) => job.id));
    return [
      download_link(`${path}/${id}/${table}`, `${file}.csv`, "Table (CSV)"),
      this.#kind === "accuracy" ? download_link(`${path}/${id}/picture?format=svg`, `${file}.svg`, "Diagram (SVG)") : "",
      element("a", { href: link("jobs", null, { sweep: id }) }, "Its jobs in the list"),
      comparison ? element("a", { href: comparison }, "Compare its jobs") : "",
      element("a", { href: link("study", null, { as: this.#kind, batch: id }) }, "Clone and change"),
    ];
  }
}
