// The newest jobs with live progress: running jobs through their event streams, the list by polling. The job in the
// URL (`/#ID`) is shown in detail below the list.

import { selected_id, show } from "/assets/job.js";
import { download_link, element, fetch_json, format_duration, format_number, send_request } from "/assets/page.js";

const POLL_MS = 3000;
// A browser opens six connections to a host; other requests need some of them.
const MAX_STREAMS = 3;
const ENDED = ["succeeded", "failed", "cancelled"];

/** Cells of the table rows, by job. */
const rows = new Map();
/** Abort controllers of the open event streams, by job. */
const streams = new Map();

function create_row(job) {
  const cells = {
    name: element("td"),
    status: element("td"),
    bar: element("div"),
    cycle: element("td", { class: "number" }),
    remaining: element("td", { class: "number" }),
    depth: element("td", { class: "number" }),
    actions: element("td", { class: "actions" }),
  };
  cells.name.append(element("a", { href: `#${job.id}`, class: "mono" }, job.name ?? job.id.slice(-12)));
  cells.row = element("tr", { id: `row-${job.id}`, title: job.id }, cells.name,
    element("td", {}, job.system), cells.status,
    element("td", {}, element("div", { class: "bar" }, cells.bar)), cells.cycle, cells.remaining, cells.depth, cells.actions);
  return cells;
}

function update_progress(cells, { cycle, cycles, fraction, eta_s }) {
  cells.bar.style.width = `${100 * fraction}%`;
  cells.bar.parentElement.title = `${(100 * fraction).toFixed(1)} %`;
  cells.cycle.textContent = `${cycle} / ${cycles}`;
  cells.shown_cycle = cycle;
  cells.remaining.textContent = eta_s == null ? "" : format_duration(eta_s);
}

function update_depth(cells, depths_mm) {
  cells.depth.textContent = format_number(Math.max(...depths_mm), 1000);
}

function update_row(cells, job) {
  const ended = ENDED.includes(job.status);
  const reason = job.status === "succeeded" ? null : job.status_reason;
  const status = element("span", { class: job.status }, job.outcome ? `${job.status} (${job.outcome})` : job.status);
  cells.status.replaceChildren(status, ...(reason ? [element("div", { class: "muted reason", title: reason }, reason)] : []));
  update_progress(cells, ended ? { ...job.progress, eta_s: null } : job.progress);
  const figures = job.key_figures;
  if (figures) update_depth(cells, [figures.receptacle_max_depth_mm, figures.slider_max_depth_mm]);
  const action = ended
    ? download_link(`${job.links.self}/results/archive`, `fretwear-${job.id}.zip`, "all results")
    : element("button", { type: "button" }, "cancel");
  if (!ended) action.addEventListener("click", () => cancel(job));
  cells.actions.replaceChildren(action);
}

async function cancel(job) {
  try {
    await fetch_json(`${job.links.self}/cancel`, { method: "POST" });
  } catch (error) {
    document.getElementById("error").textContent = error.message;
  }
  await refresh();
}

/** Parses the events of a stream. */
async function* parse_events(response, signal) {
  const reader = response.body.pipeThrough(new TextDecoderStream()).getReader();
  let text = "";
  while (!signal.aborted) {
    const { value, done } = await reader.read();
    if (done) return;
    const blocks = (text + value).split("\n\n");
    text = blocks.pop();
    for (const block of blocks) {
      const field = (name) => block.split("\n").find((line) => line.startsWith(`${name}:`))?.slice(name.length + 1).trim();
      if (field("event")) yield { name: field("event"), data: JSON.parse(field("data")) };
    }
  }
}

async function follow_events(job) {
  const abort = new AbortController();
  streams.set(job.id, abort);
  try {
    const response = await send_request(`${job.links.self}/events`, { signal: abort.signal });
    for await (const { name, data } of parse_events(response, abort.signal)) {
      const cells = rows.get(job.id);
      if (!cells) break;
      // A stream starts with past events; those older than the displayed cycle are ignored.
      if (name === "progress" && data.cycle >= cells.shown_cycle) update_progress(cells, data);
      if (name === "cycle" && data.cycle >= cells.shown_cycle) update_depth(cells, [data.receptacle.max_depth_mm, data.slider.max_depth_mm]);
      if (name === "done") refresh();
    }
  } catch {
    // The next poll of the list opens the stream again.
  } finally {
    abort.abort();
    streams.delete(job.id);
  }
}

async function refresh() {
  const message = document.getElementById("error");
  try {
    const page = await fetch_json("/v1/jobs?limit=50");
    const listed = new Set(page.jobs.map((job) => job.id));
    for (const id of rows.keys()) if (!listed.has(id)) rows.delete(id);
    for (const job of page.jobs) {
      if (!rows.has(job.id)) rows.set(job.id, create_row(job));
      update_row(rows.get(job.id), job);
    }
    document.getElementById("jobs").replaceChildren(...page.jobs.map((job) => rows.get(job.id).row));
    document.getElementById("more").textContent = page.jobs.length === 0
      ? "No jobs yet. Submit one: curl --json @spec.json " + location.origin + "/v1/jobs"
      : page.next_page_token ? "Older jobs are not shown." : "";
    for (const job of page.jobs)
      if (job.status === "running" && !streams.has(job.id) && streams.size < MAX_STREAMS) follow_events(job);
    const selected = selected_id();
    await show(selected && (await fetch_json(`/v1/jobs/${selected}`)));
    message.textContent = "";
  } catch (error) {
    message.textContent = error.message;
  }
}

addEventListener("hashchange", refresh);
await refresh();
setInterval(refresh, POLL_MS);
