// The newest jobs, and their progress as it happens: running jobs are followed by their event streams, the list itself
// is looked at every few seconds.

import { ask, document_at, element } from "/assets/page.js";

const LOOK_MS = 3000;
// A browser opens six connections to a host; streams must leave some to everything else.
const STREAMS = 3;
const ENDED = ["succeeded", "failed", "cancelled"];

const rows = new Map();
const followed = new Map();

function number(value, scale = 1) {
  return value == null ? "" : (value * scale).toPrecision(4);
}

function row(job) {
  const parts = {
    status: element("td"),
    bar: element("div"),
    cycle: element("td", { class: "number" }),
    depth: element("td", { class: "number" }),
    actions: element("td"),
  };
  const name = job.spec.name ?? job.id.slice(-12);
  parts.row = element("tr", { title: job.id },
    element("td", {}, element("a", { href: job.links.self, class: "mono" }, name)),
    element("td", {}, job.spec.system.kind), parts.status,
    element("td", {}, element("div", { class: "bar" }, parts.bar)), parts.cycle, parts.depth, parts.actions);
  return parts;
}

function progress(parts, { cycle, cycles, fraction }) {
  parts.bar.style.width = `${100 * fraction}%`;
  parts.cycle.textContent = `${cycle} / ${cycles}`;
}

function depth(parts, sides) {
  if (sides) parts.depth.textContent = number(Math.max(sides.receptacle.max_depth_mm, sides.slider.max_depth_mm), 1000);
}

function shown(parts, job) {
  parts.status.textContent = job.outcome ? `${job.status} (${job.outcome})` : job.status;
  parts.status.className = job.status;
  parts.status.title = job.status_reason ?? "";
  progress(parts, job.progress);
  depth(parts, job.summary);
  const ended = ENDED.includes(job.status);
  const action = ended
    ? element("a", { href: `${job.links.results}/archive` }, "results")
    : element("button", { type: "button" }, "cancel");
  if (!ended) action.addEventListener("click", () => ask(job.links.cancel, { method: "POST" }).then(look));
  parts.actions.replaceChildren(action);
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
      if (name === "progress") progress(parts, data);
      if (name === "cycle") depth(parts, data);
      if (name === "done") look();
    }
  } catch {
    // The next look at the list follows it again.
  } finally {
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
    document.getElementById("more").textContent =
      page.jobs.length === 0 ? "No jobs yet." : page.next_page_token ? "Older jobs are not shown." : "";
    for (const job of page.jobs)
      if (job.status === "running" && !followed.has(job.id) && followed.size < STREAMS) follow(job);
    trouble.textContent = "";
  } catch (error) {
    trouble.textContent = error.message;
  }
}

await look();
setInterval(look, LOOK_MS);
