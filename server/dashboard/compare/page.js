// Several jobs beside each other: what differs between their specifications, their figures, their curves on the same axes.

import { Chart } from "../charts/chart.js";
import { choices, link } from "../parts/address.js";
import { fetch_json } from "../parts/client.js";
import { card, element, table } from "../parts/element.js";
import { count, length, number, percent } from "../parts/format.js";
import { badge } from "../parts/status.js";
import { differing } from "./fields.js";

const MOST_JOBS = 10;
const MOST_POINTS = 1000;
const UM = 1e3;

/** @type {[string, string, string, (history: any) => (number | null)[]][]} */
const CHARTS = [
  ["receptacle", "Deepest wear of the receptacle", "worn depth, µm", (history) => history.receptacle.max_depth_mm.map((/** @type {number} */ depth) => UM * depth)],
  ["slider", "Deepest wear of the slider", "worn depth, µm", (history) => history.slider.max_depth_mm.map((/** @type {number} */ depth) => UM * depth)],
  ["pressure", "Peak pressure", "pressure, MPa", (history) => history.peak_pressure_mpa],
  ["half-width", "Half-width of the contact", "half-width, µm", (history) => history.contact_half_width_mm.map((/** @type {number} */ width) => UM * width)],
];

/** @type {import("../main.js").Page} */
export async function compare_page(content, { values }, signal) {
  document.title = "Compare · fretwear";
  const ids = (values.get("jobs") ?? "").split(",").filter((id) => id !== "").slice(0, MOST_JOBS);
  content.append(element("h1", {}, "Compare"));
  if (ids.length < 2) {
    content.append(element("p", {}, "Select two to ten jobs in the ", element("a", { href: link("jobs") }, "list"), " and compare them."));
    return;
  }
  const jobs = await Promise.all(ids.map((id) => fetch_json(`/v1/jobs/${id}`, { signal })));
  const names = distinct_names(jobs);
  const charts = element("div", { class: "charts" });
  content.append(figures(jobs, names), charts, differences(jobs, names));
  const histories = await Promise.all(jobs.map((job) => fetch_json(`${job.links.wear_history}?max_points=${MOST_POINTS}`, { signal })));
  const drawn = CHARTS.map((content) => ({ content, chart: new Chart({ name: content[0], signal, state: choices }) }));
  charts.append(...drawn.map(({ chart }) => chart.node));
  for (const { content: [, title, y, of], chart } of drawn) {
    await chart.show({
      title,
      x: { title: "cycle", can_log: true },
      y: { title: y, can_log: true },
      series: histories.map((history, index) => ({ name: names[index], x: history.cycle, y: of(history), colour: index })),
    });
  }
  return () => {};
}

/**
 * Names of jobs; those that are alike have the ends of their ids.
 * @param {any[]} jobs
 * @returns {string[]}
 */
function distinct_names(jobs) {
  const names = jobs.map((job) => job.spec.name ?? job.spec.system.kind);
  return names.map((name, index) => (names.filter((other) => other === name).length > 1 ? `${name} (${jobs[index].id.slice(-4)})` : name));
}

/**
 * The key figures of all jobs.
 * @param {any[]} jobs
 * @param {string[]} names
 * @returns {HTMLElement}
 */
function figures(jobs, names) {
  const rows = jobs.map((job, index) => {
    const { summary } = job;
    const life = (summary?.life ?? []).find((/** @type {any} */ one) => one.cycles != null);
    return [
      element("a", { href: link("job", job.id) }, names[index]), badge(job), count(summary?.cycles_done),
      length(summary?.receptacle.max_depth_mm), length(summary?.slider.max_depth_mm),
      summary ? number(summary.peak_pressure_mpa) : "", count(life?.cycles),
      percent(summary?.accuracy.estimated_relative_error), summary ? number(summary.cost.cpu_s) : "",
    ];
  });
  return card("Results", table({ head: ["job", "status", "cycles", "receptacle", "slider", "peak, MPa", "first life, cycles", "error", "processor time, s"], rows, numbers: [2, 3, 4, 5, 6, 7, 8] }));
}

/**
 * The fields in which the specifications differ.
 * @param {any[]} jobs
 * @param {string[]} names
 * @returns {HTMLElement}
 */
function differences(jobs, names) {
  const rows = differing(jobs.map((job) => job.spec)).map(([pointer, values]) => [element("code", {}, pointer), ...values]);
  return card("What differs", rows.length ? table({ head: ["field", ...names], rows }) : element("p", {}, "The specifications are the same."));
}
