// The workers of the service: its own, and remote ones with their machines.

import { link } from "../parts/address.js";
import { fetch_json } from "../parts/client.js";
import { definitions, element, table } from "../parts/element.js";
import { count, duration } from "../parts/format.js";

/** Time between looks at the workers while the page is seen, ms: their heartbeats come every 2 s. */
const EVERY_MS = 2000;
const HEAD = ["machine", "jobs", "slots", "memory free", "of", "last contact", "process"];

/** @type {import("../main.js").Page} */
export async function workers_page(content, _address, signal) {
  document.title = "Workers · fretwear";
  const line = element("div", { role: "status" });
  const list = element("div");
  content.append(element("h1", {}, "Workers"), line, list);
  let shown = "";
  const load = async () => {
    const [workers, service] = await Promise.all([fetch_json("/v1/workers", { signal }), fetch_json("/v1/service", { signal })]);
    const state = JSON.stringify([workers, service.jobs]);
    if (state === shown) return;
    shown = state;
    line.replaceChildren(summary(workers, service.jobs));
    list.replaceChildren(workers.remote.length ? remote_table(workers.remote) : element("p", { class: "muted" },
      "No remote worker was in contact within a minute. Another machine becomes one with ", element("code", {}, `fretwear work --server ${location.origin}`), "."));
  };
  await load();
  const timer = setInterval(() => document.hidden || load().catch(() => {}), EVERY_MS);
  signal.addEventListener("abort", () => clearInterval(timer));
}

/**
 * @param {any} workers
 * @param {Record<string, number>} jobs
 */
function summary({ local, remote }, jobs) {
  const sum = (/** @type {(worker: any) => number} */ of) => remote.reduce((/** @type {number} */ total, /** @type {any} */ worker) => total + of(worker), 0);
  const waiting = element("a", { href: link("jobs", null, { status: "queued" }) }, count(jobs.queued));
  return definitions([
    ["in this service", `${count(local.busy)} of ${count(local.total)} busy`],
    ["remote", remote.length > 0 && `${counted(sum(({ jobs }) => jobs), "job", "jobs")} in ${counted(sum(({ slots }) => slots), "slot", "slots")} of ${counted(remote.length, "process", "processes")}`],
    ["jobs that wait", waiting],
  ]);
}

/**
 * @param {number} number
 * @param {string} one
 * @param {string} several
 */
function counted(number, one, several) {
  return `${count(number)} ${number === 1 ? one : several}`;
}

/** @param {any[]} workers */
function remote_table(workers) {
  const memory = (/** @type {number} */ mb) => `${(mb / 1000).toFixed(1)} GB`;
  const row = (/** @type {any} */ { host, jobs, slots, free_memory_mb, memory_mb, last_contact_s, id }) => [
    host || "unnamed", count(jobs), count(slots), memory(free_memory_mb), memory(memory_mb), `${duration(last_contact_s)} ago`, element("code", {}, id),
  ];
  return table({ head: HEAD, rows: workers.map(row), numbers: [1, 2, 3, 4, 5] });
}
