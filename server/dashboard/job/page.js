// One job: live while it runs, complete after it.

import { plotly } from "../charts/library.js";
import { choices } from "../parts/address.js";
import { events, fetch_json } from "../parts/client.js";
import { reached_again, when_reached_again } from "../parts/connection.js";
import { element } from "../parts/element.js";
import { motion_card } from "../parts/motion.js";
import { has_ended } from "../parts/status.js";
import { listed_quantities } from "../parts/summary.js";
import { throttled } from "../parts/throttled.js";
import { checks_card, cost_card, errors_card } from "./accuracy.js";
import { effects_card, warnings_card } from "./effects.js";
import { failure_card } from "./failure.js";
import { Fields } from "./fields.js";
import { files_card } from "./files.js";
import { Head } from "./head.js";
import { HistoryCharts } from "./history.js";
import { life_card } from "./life.js";
import { Maps } from "./maps.js";
import { result_card, stations_card } from "./result.js";
import { SnapshotCharts } from "./snapshots.js";
import { specification_card } from "./specification.js";

/** Time between loads of the history of a running job, ms. */
const HISTORY_MS = 2000;
/** Time between attempts to connect again, ms. */
const RETRY_MS = 2000;

/** @type {import("../main.js").Page} */
export async function job_page(content, { id }, signal) {
  // Loaded while the job is.
  plotly();
  let job = await fetch_json(`/v1/jobs/${id}`, { signal });
  document.title = `${job.spec.name ?? job.spec.system.kind} · fretwear`;
  const head = new Head(job);
  const history = new HistoryCharts(job.id, choices, signal);
  const snapshots = new SnapshotCharts(choices, signal);
  const maps = new Maps(choices, signal);
  const fields = new Fields(choices, signal);
  const results = element("div", { class: "cards" });
  const details = element("div", { class: "cards" });
  const charts = element("div", { class: "charts" });
  content.append(head.node, results, charts, details, element("div", { class: "cards" }, motion_card(job.plan ?? {}) ?? "", effects_card(job), specification_card(job)));
  charts.append(...history.nodes, snapshots.node, fields.node, maps.node);

  const show_history = async () => {
    await Promise.all([history.load(job, signal), snapshots.load(job, signal)]);
  };
  const show_end = async () => {
    const [listed, quantities] = await Promise.all([fetch_json(job.links.results, { signal }), listed_quantities(signal)]);
    const { summary } = job;
    fill(results, summary ? [result_card(job, quantities), life_card(job), errors_card(job), failure_card(job), warnings_card(job)] : [failure_card(job), warnings_card(job)]);
    fill(details, [...(summary ? [stations_card(job), checks_card(job), cost_card(job)] : []), files_card(listed)]);
    await Promise.all([maps.load(listed, signal), fields.load(job, listed)]);
  };
  const show = async () => {
    head.update(job);
    await Promise.all([show_history(), has_ended(job) ? show_end() : null]);
  };
  const refresh = async () => {
    job = await fetch_json(`/v1/jobs/${id}`, { signal });
    await show();
  };
  // The curves of the first run are those that this tab has shown.
  if (job.progress.stage === "refined") history.first_run_ends();
  await show();
  // Results of a job that has ended may not have arrived either.
  when_reached_again(refresh, signal);
  if (!has_ended(job))
    live(id ?? "", signal, {
      progress: (progress) => {
        if (progress.stage === "refined") history.first_run_ends();
        head.progress(progress);
      },
      cycle: throttled(() => show_history(), HISTORY_MS, signal),
      done: refresh,
    });
  return () => {
    snapshots.follow_address();
    fields.follow_address();
  };
}

/**
 * @param {HTMLElement} node
 * @param {(HTMLElement | null)[]} cards
 */
function fill(node, cards) {
  node.replaceChildren(...cards.filter((card) => card !== null));
}

/**
 * Follows the events of a job until it has ended.
 * @param {string} id
 * @param {AbortSignal} signal
 * @param {{progress: (progress: any) => void, cycle: () => void, done: () => Promise<void>}} listener
 */
async function live(id, signal, listener) {
  /** @type {string | null} */
  let last = null;
  while (!signal.aborted) {
    try {
      for await (const { name, id: number, data } of events(`/v1/jobs/${id}/events`, signal, last)) {
        last = number ?? last;
        if (name === "progress") listener.progress(data);
        if (name === "cycle") listener.cycle();
        if (name === "done") return await listener.done();
      }
      const job = await fetch_json(`/v1/jobs/${id}`, { signal });
      if (has_ended(job)) return await listener.done();
    } catch {
      // The service is away; the next attempt finds it or not.
    }
    await Promise.all([new Promise((resolve) => setTimeout(resolve, RETRY_MS)), reached_again(signal)]);
  }
}
