// A job in the list.

import { link } from "../parts/address.js";
import { element } from "../parts/element.js";
import { count, duration, length, percent, seconds_between, time, words } from "../parts/format.js";
import { badge, has_ended, progress_bar } from "../parts/status.js";

/** A row of the table, which follows its job. */
export class Row {
  /** @type {Record<string, HTMLElement>} */
  #cells = {};

  /**
   * @param {any} job its short document
   * @param {import("./selection.js").Selection} selection
   */
  constructor(job, selection) {
    for (const name of ["status", "progress", "left", "depth", "duration"])
      this.#cells[name] = element("td", { class: ["left", "depth", "duration"].includes(name) && "number" });
    const box = selection.box_of(job.id, job.name ?? job.id);
    const labels = Object.entries(job.labels ?? {}).map(([key, value]) => element("span", { class: "label" }, `${key}: ${value}`));
    const { status, progress, left, depth, duration } = this.#cells;
    this.node = element("tr", { "data-job": job.id }, element("td", {}, box),
      element("td", { class: "name" }, element("a", { href: link("job", job.id) }, job.name ?? job.id.slice(-12)), ...labels),
      element("td", {}, words(job.system)), status, progress, left, depth, duration,
      element("td", { class: "nowrap" }, time(job.created_at)));
    this.update(job);
  }

  /** @param {any} job its short document */
  update(job) {
    const { status, progress, left, depth, duration: taken } = this.#cells;
    const { cycle, cycles, fraction, eta_s } = job.progress;
    const reason = job.status !== "succeeded" && job.status_reason;
    this.node.className = job.status;
    status.replaceChildren(badge(job), reason ? element("div", { class: "reason", title: job.status_reason }, job.status_reason) : "");
    progress.replaceChildren(...(has_ended(job)
      ? [`${count(cycle)} cycles`]
      : [progress_bar(fraction, `progress of ${job.name ?? job.id}`), element("div", { class: "muted" }, `${percent(fraction)}, cycle ${count(cycle)} of ${count(cycles)}`)]));
    left.textContent = has_ended(job) ? "" : duration(eta_s);
    const figures = job.key_figures;
    depth.textContent = figures ? length(Math.max(figures.receptacle_max_depth_mm, figures.slider_max_depth_mm)) : "";
    taken.textContent = job.started_at ? duration(seconds_between(job.started_at, job.finished_at)) : "";
  }
}
