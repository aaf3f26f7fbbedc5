// The newest jobs, and their progress as it happens: running jobs are followed by their event streams, the list itself
// is looked at every few seconds. The job that the address names (`/#ID`) is shown in full below.

import { show, showing } from "/assets/job.js";
import { ask, document_at, download_link, element, figure, span_of } from "/assets/page.js";

const LOOK_MS = 3000;
// A browser opens six connections to a host; streams must leave some to everything else.
const STREAMS = 3;
const ENDED = ["succeeded", "failed", "cancelled"];

const rows = new Map();
const followed = new Map();

function row(job) {
  const parts = {
    name: element("td"),
    status: element("td"),
    bar: element("div"),
    cycle: element("td", { class: "number" }),
    left: element("td", { class: "number" }),
    depth: element("td", { class: "number" }),
    actions: element("td", { class: "actions" }),
  };
  parts.name.append(element("a", { href: `#${job.id}`, class: "mono" }, job.spec.name ?? job.id.slice(-12)));
  parts.row = element("tr", { id: `row-${job.id}`, title: job.id }, parts.name,
    element("td", {}, job.spec.system.kind), parts.status,
    element("td", {}, element("div", { class: "bar" }, parts.bar)), parts.cycle, parts.left, parts.depth, parts.actions);
  return parts;
}

function progress(parts, { cycle, cycles, fraction, eta_s }) {
  parts.bar.style.width = `${100 * fraction}%`;
  parts.bar.parentElement.title = `${(100 * fraction).toFixed(1)} %`;
  parts.cycle.textContent = `${cycle} / ${cycles}`;
  parts.at = cycle;
  parts.left.textContent = eta_s == null ? "" : span_of(eta_s);
}

function depth(parts, sides) {
  if (sides) parts.depth.textContent = figure(Math.max(sides.receptacle.max_depth_mm, sides.slider.max_depth_mm), 1000);
}

function shown(parts, job) {
  const ended = ENDED.includes(job.status);
  const reason = job.status === "succeeded" ? null : job.status_reason;
  const status = element("span", { class: job.status }, job.outcome ? `${job.status} (${job.outcome})` : job.status);
  parts.status.replaceChildren(status, ...(reason ? [element("div", { class: "soft reason", title: reason }, reason)] : []));
  progress(parts, ended ? { ...job.progress, eta_s: null } : job.progress);
  depth(parts, job.summary);
  const action = ended
    ? download_link(`${job.links.results}/archive`, `fretwear-${job.id}.zip`, "all results")
    : element("button", { type: "button" }, "cancel");
  if (!ended) action.addEventListener("click", () => cancel(job));
  parts.actions.replaceChildren(action);
}

async function cancel(job) {
  try {
    await document_at(job.links.cancel, { method: "POST" });
  } catch (error) {
    document.getElementById("trouble").textContent = error.message;
  }
  await look();
}

/** The events of a stream, one after the other. */
async function* events(answer, signal) {
  const reader = answer.body.pipeThrough(new TextDecoderStream()).getReader();
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

async function follow(job) {
  const stop = new AbortController();
  followed.set(job.id, stop);
  try {
    const answer = await ask(job.links.events, { signal: stop.signal });
    for await (const { name, data } of events(answer, stop.signal)) {
      const parts = rows.get(job.id);
      if (!parts) break;
      // A stream begins with what happened before; the list has told more than that already.
      if (name === "progress" && data.cycle >= parts.at) progress(parts, data);
      if (name === "cycle" && data.cycle >= parts.at) depth(parts, data);
      if (name === "done") look();
    }
  } catch {
    // The next look at the list follows it again.
  } finally {
    stop.abort();
    followed.delete(job.id);
  }
}

async function look() {
  const trouble = document.getElementById("trouble");
  try {
    const page = await document_at("/v1/jobs?limit=50");
    const kept = new Set(page.jobs.map((job) => job.id));
    for (const id of rows.keys()) if (!kept.has(id)) rows.delete(id);
    for (const job of page.jobs) {
      if (!rows.has(job.id)) rows.set(job.id, row(job));
      shown(rows.get(job.id), job);
    }
    document.getElementById("jobs").replaceChildren(...page.jobs.map((job) => rows.get(job.id).row));
    document.getElementById("more").textContent = page.jobs.length === 0
      ? "No jobs yet. Submit one: curl --json @spec.json " + location.origin + "/v1/jobs"
      : page.next_page_token ? "Older jobs are not shown." : "";
    for (const job of page.jobs)
      if (job.status === "running" && !followed.has(job.id) && followed.size < STREAMS) follow(job);
    const named = showing();
    await show(named && (page.jobs.find((job) => job.id === named) ?? (await document_at(`/v1/jobs/${named}`))));
    trouble.textContent = "";
  } catch (error) {
    trouble.textContent = error.message;
  }
}

addEventListener("hashchange", look);
await look();
setInterval(look, LOOK_MS);
