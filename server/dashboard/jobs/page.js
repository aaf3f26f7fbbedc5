// The list of jobs: filters, live rows, selection.

import { address, change, changed, link } from "../parts/address.js";
import { fetch_json } from "../parts/client.js";
import { element } from "../parts/element.js";
import { follow } from "../parts/feed.js";
import { count } from "../parts/format.js";
import { throttled } from "../parts/throttled.js";
import { curves_of } from "./curves.js";
import { filter_bar, query_of } from "./filters.js";
import { Head } from "./head.js";
import { Row } from "./row.js";
import { Selection } from "./selection.js";

/** Jobs of a page of the list. */
const PAGE = 100;
/** Least times between loads of the list, of the summary of the service and of the curves of running jobs, and between updates of ages, ms. */
const RELOAD_MS = 300;
const SUMMARY_MS = 1000;
const CURVES_MS = 5000;
const AGES_MS = 10_000;

/** @type {import("../main.js").Page} */
export async function jobs_page(content, _address, signal) {
  document.title = "Jobs · fretwear";
  /** @type {Map<string, Row>} */
  const rows = new Map();
  const selection = new Selection(signal);
  const body = element("tbody");
  const more = element("p", { class: "more" });
  const summary = element("p", { class: "muted", role: "status" });
  const head = new Head();
  content.append(
    element("h1", {}, "Jobs"), summary, filter_bar(signal), selection.bar,
    element("div", { class: "scroll" }, element("table", { class: "jobs" }, element("thead", {}, head.node), body)), more);

  const row_of = (/** @type {any} */ job) => {
    const known = rows.get(job.id);
    if (known) known.update(job);
    const row = known ?? new Row(job, selection);
    rows.set(job.id, row);
    return row;
  };
  let asked = 0;
  let newest = "";
  const load = async () => {
    const call = ++asked;
    const values = address().values;
    head.update();
    const page = await fetch_json(`/v1/jobs?${query_of(values, PAGE)}`, { signal });
    // An older answer may come later.
    if (call !== asked) return;
    const listed = page.jobs.map((/** @type {any} */ job) => row_of(job));
    newest = page.jobs.reduce((/** @type {string} */ last, /** @type {any} */ { created_at }) => (created_at > last ? created_at : last), newest);
    for (const id of rows.keys()) if (!page.jobs.some((/** @type {any} */ job) => job.id === id)) rows.delete(id);
    body.replaceChildren(...listed.map((/** @type {Row} */ row) => row.node));
    more.replaceChildren(...paging(page, values));
    show_curves([...rows.keys()]);
  };
  const show_curves = async (/** @type {string[]} */ ids) => {
    for (const [id, curve] of await curves_of(ids, signal)) rows.get(id)?.show_curve(curve);
  };
  await load();

  // A new job is listed where it passes the filters, which the service decides.
  const is_new = (/** @type {any} */ job) => {
    if (address().values.get("page") || (newest !== "" && job.created_at <= newest)) return false;
    newest = job.created_at;
    return true;
  };
  const reload = throttled(load, RELOAD_MS, signal);
  /** Jobs whose curves are out of date. @type {Set<string>} */
  const outdated = new Set();
  const follow_curves = throttled(() => {
    const ids = [...outdated].filter((id) => rows.has(id));
    outdated.clear();
    return show_curves(ids);
  }, CURVES_MS, signal);
  const ages = setInterval(() => rows.forEach((row) => row.update_times()), AGES_MS);
  signal.addEventListener("abort", () => clearInterval(ages));
  const refresh_summary = throttled(() => summarize(), SUMMARY_MS, signal);
  const summarize = async () => summary.replaceChildren(...(await service_line(signal)));
  follow({
    changed: (job) => {
      if (rows.has(job.id)) {
        row_of(job);
        outdated.add(job.id);
        follow_curves();
      } else if (is_new(job)) reload();
      refresh_summary();
    },
    deleted: (id) => {
      rows.get(id)?.node.remove();
      rows.delete(id);
      selection.remove(id);
      refresh_summary();
    },
    reset: load,
    started: reload,
  }, signal);
  await summarize();
  return load;
}

/**
 * What is beyond the page, or a hint where there is nothing.
 * @param {any} page
 * @param {URLSearchParams} values
 * @returns {(Node | string)[]}
 */
function paging(page, values) {
  const listed = page.total > page.jobs.length ? `${count(page.jobs.length)} of ${count(page.total)} jobs` : "";
  /** @type {(Node | string)[]} */
  const links = [listed].filter((text) => text !== "");
  if (values.get("page")) links.push(element("a", { href: changed({ page: null }) }, "first page"));
  if (page.next_page_token)
    links.push(element("button", { type: "button", click: () => change({ page: page.next_page_token }) }, "next page"));
  if (page.jobs.length === 0)
    links.push([...values.keys()].length ? "No job passes these filters." : `No jobs yet. Submit one: curl --json @spec.json ${location.origin}/v1/jobs`);
  return links;
}

/**
 * What the service does, in a line.
 * @param {AbortSignal} signal
 * @returns {Promise<(Node | string)[]>}
 */
async function service_line(signal) {
  const { jobs, workers, free_disk_mb } = await fetch_json("/v1/service", { signal });
  const counts = ["running", "queued", "succeeded", "failed", "cancelled"].filter((status) => jobs[status]);
  const disk = free_disk_mb == null ? "" : ` · ${Math.round(free_disk_mb / 1000)} GB free`;
  const listed = counts.map((status) => `${jobs[status]} ${status}`).join(", ") || "no jobs";
  return [`${listed} · `, element("a", { href: link("workers") }, `${workers.busy} of ${workers.total} workers busy`), disk];
}
