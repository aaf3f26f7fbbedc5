// Several jobs beside each other: what differs between their specifications, their figures, their curves on the same axes.

import { Chart } from "../charts/chart.js";
import { choices, link } from "../parts/address.js";
import { fetch_json } from "../parts/client.js";
import { MOST_COMPARED } from "../parts/comparison.js";
import { card, element, table } from "../parts/element.js";
import { follow } from "../parts/feed.js";
import { count, length, number, percent } from "../parts/format.js";
import { columns_of } from "../parts/histories.js";
import { badge } from "../parts/status.js";
import { throttled } from "../parts/throttled.js";
import { differing } from "./fields.js";

const MOST_POINTS = 1000;
const UM = 1e3;

/** Least time between loads while jobs run, ms. */
const RELOAD_MS = 3000;

/** Name and title of each chart, its axis, its column and the factor to the unit of the axis. @type {[string, string, string, string, number][]} */
const CHARTS = [
  ["receptacle", "Deepest wear of the receptacle", "worn depth, µm", "receptacle_max_depth_mm", UM],
  ["slider", "Deepest wear of the slider", "worn depth, µm", "slider_max_depth_mm", UM],
  ["pressure", "Peak pressure", "pressure, MPa", "peak_pressure_mpa", 1],
  ["half-width", "Half-width of the contact", "half-width, µm", "contact_half_width_mm", UM],
];
const COLUMNS = ["cycle", ...CHARTS.map(([, , , column]) => column)];

/** @type {import("../main.js").Page} */
export async function compare_page(content, { values }, signal) {
  document.title = "Compare · fretwear";
  const ids = (values.get("jobs") ?? "").split(",").filter((id) => id !== "").slice(0, MOST_COMPARED);
  content.append(element("h1", {}, "Compare"));
  if (ids.length < 2) {
    content.append(element("p", {}, "Select two to ten jobs in the ", element("a", { href: link("jobs") }, "list"), " and compare them."));
    return;
  }
  const [results, specifications] = [element("div"), element("div")];
  const charts = CHARTS.map((drawn) => ({ drawn, chart: new Chart({ name: drawn[0], signal, state: choices }) }));
  content.append(results, element("div", { class: "charts" }, charts.map(({ chart }) => chart.node)), specifications);
  const show = async () => {
    const jobs = await Promise.all(ids.map((id) => fetch_json(`/v1/jobs/${id}`, { signal })));
    const names = distinct_names(jobs);
    results.replaceChildren(figures(jobs, names));
    specifications.replaceChildren(differences(jobs, names));
    const histories = await columns_of(ids, COLUMNS, MOST_POINTS, signal);
    for (const { drawn: [, title, y, column, factor], chart } of charts) {
      const curve = (/** @type {string} */ id) => ({ x: histories.get(id)?.cycle ?? [], y: (histories.get(id)?.[column] ?? []).map((value) => factor * value) });
      await chart.show({
        title,
        x: { title: "cycle", can_log: true },
        y: { title: y, can_log: true },
        series: ids.map((id, index) => ({ name: names[index], ...curve(id), colour: index })),
      });
    }
  };
  await show();
  const reload = throttled(show, RELOAD_MS, signal);
  follow({ changed: ({ id }) => ids.includes(id) && reload(), deleted: () => {}, reset: reload, started: reload }, signal);
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
    const lives = (summary?.life ?? []).map((/** @type {any} */ { cycles }) => cycles).filter((/** @type {number | null} */ cycles) => cycles != null);
    return [
      element("a", { href: link("job", job.id) }, names[index]), badge(job), count(summary?.cycles_done),
      length(summary?.receptacle.max_depth_mm), length(summary?.slider.max_depth_mm),
      summary ? number(summary.peak_pressure_mpa) : "", lives.length ? count(Math.min(...lives)) : "",
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
