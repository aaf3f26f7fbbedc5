// The workers of the service: its own, and remote ones with their machines.

import { link } from "../parts/address.js";
import { fetch_json } from "../parts/client.js";
import { definitions, element, table } from "../parts/element.js";
import { count, duration } from "../parts/format.js";

/** Time between looks at the workers while the page is seen, ms: their heartbeats come every 2 s. */
const EVERY_MS = 2000;
const HEAD = ["machine", "jobs", "slots", "memory free", "of", "last contact", "process", ""];

/** @type {import("../main.js").Page} */
export async function workers_page(content, _address, signal) {
  document.title = "Workers · fretwear";
  const line = element("div", { role: "status" });
  const list = element("div");
  content.append(element("h1", {}, "Workers"), line, list);
  const said = element("p", { role: "status" });
  content.append(said);
  let shown = "";
  const drain = async (/** @type {string} */ id) => {
    try {
      await fetch_json(`/v1/workers/${id}/drain`, { method: "POST" });
      said.textContent = "";
      await load();
    } catch (error) {
      said.textContent = error instanceof Error ? error.message : String(error);
    }
  };
  const load = async () => {
    const [workers, service] = await Promise.all([fetch_json("/v1/workers", { signal }), fetch_json("/v1/service", { signal })]);
    const state = JSON.stringify([workers, service.jobs]);
    if (state === shown) return;
    shown = state;
    line.replaceChildren(summary(workers, service.jobs));
    list.replaceChildren(workers.remote.length ? remote_table(workers.remote, drain) : element("p", { class: "muted" },
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

/**
 * @param {any[]} workers
 * @param {(id: string) => void} drain
 */
function remote_table(workers, drain) {
  const memory = (/** @type {number} */ mb) => `${(mb / 1000).toFixed(1)} GB`;
  const end = (/** @type {any} */ { host, id, is_draining, failing }) => is_draining
    ? element("span", { class: "muted" }, "takes no more jobs")
    : element("span", {}, failing ? `Solves nothing at present: ${failing} ` : "", element("button", { type: "button", "aria-label": `Drain ${host || "unnamed"} ${id}`, title: "It takes no more jobs and ends when it has solved those that it has.", click: () => drain(id) }, "Drain"));
  const row = (/** @type {any} */ worker) => [
    worker.host || "unnamed", count(worker.jobs), count(worker.slots), memory(worker.free_memory_mb), memory(worker.memory_mb),
    `${duration(worker.last_contact_s)} ago`, element("code", {}, worker.id), end(worker),
  ];
  return table({ head: HEAD, rows: workers.map(row), numbers: [1, 2, 3, 4, 5] });
}
