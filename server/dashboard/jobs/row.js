// A job in the list.

import { link } from "../parts/address.js";
import { element } from "../parts/element.js";
import { count, duration, duration_range, length, percent, seconds_between, time, words } from "../parts/format.js";
import { badge, has_ended, progress_bar, refined } from "../parts/status.js";
import { sparkline } from "./sparkline.js";

const NUMBERS = ["left", "depth", "life", "duration", "age"];

/** A row of the table, which follows its job. */
export class Row {
  /** @type {Record<string, HTMLElement>} */
  #cells = {};
  #curve = element("span");
  #depth = element("span", { class: "depth" });
  #job;

  /**
   * @param {any} job its short document
   * @param {import("./selection.js").Selection} selection
   */
  constructor(job, selection) {
    this.#job = job;
    for (const name of ["status", "progress", ...NUMBERS]) this.#cells[name] = element("td", { class: NUMBERS.includes(name) && "number" });
    const box = selection.box_of(job.id, job.name ?? job.id);
    const labels = Object.entries(job.labels ?? {}).map(([key, value]) => element("span", { class: "label" }, `${key}: ${value}`));
    const { status, progress, left, depth, life, duration, age } = this.#cells;
    depth.append(this.#curve, this.#depth);
    age.title = time(job.created_at);
    this.node = element("tr", { "data-job": job.id }, element("td", {}, box),
      element("td", { class: "name" }, element("a", { href: link("job", job.id) }, job.name ?? job.id.slice(-12)), ...labels),
      element("td", {}, words(job.system)), status, progress, left, depth, life, duration, age);
    this.update(job);
  }

  /** @param {any} job its short document */
  update(job) {
    this.#job = job;
    const { status, progress, left, life } = this.#cells;
    const { cycle, cycles, fraction, eta_s, eta_most_s } = job.progress;
    const reason = job.status !== "succeeded" && job.status_reason;
    this.node.className = job.status;
    status.replaceChildren(badge(job), reason ? element("div", { class: "reason", title: job.status_reason }, job.status_reason) : "");
    progress.replaceChildren(...(has_ended(job)
      ? [`${count(cycle)} cycles`]
      : [progress_bar(fraction, `progress of ${job.name ?? job.id}`), element("div", { class: "muted" }, `${refined(job.progress)}${percent(fraction)}, cycle ${count(cycle)} of ${count(cycles)}`)]));
    left.textContent = has_ended(job) ? "" : duration_range(eta_s, eta_most_s);
    const figures = job.key_figures;
    if (figures) this.#depth.textContent = length(Math.max(figures.receptacle_max_depth_mm, figures.slider_max_depth_mm));
    life.textContent = figures?.life_cycles == null ? "" : `${count(figures.life_cycles)} cycles`;
    this.update_times();
  }

  /** Shows the durations as of now. */
  update_times() {
    const { created_at, started_at, finished_at } = this.#job;
    this.#cells.duration.textContent = started_at ? duration(seconds_between(started_at, finished_at)) : "";
    this.#cells.age.textContent = duration(seconds_between(created_at));
  }

  /**
   * Shows the curve of the deepest wear.
   * @param {{cycles: number[], depths: number[]}} curve
   */
  show_curve({ cycles, depths }) {
    this.#curve.replaceChildren(sparkline(cycles, depths) ?? "");
    const last = depths.at(-1);
    if (!this.#job.key_figures && last) this.#depth.textContent = length(last);
  }
}
