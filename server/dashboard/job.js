// Details of a job: status, summary, wear so far, pictures and files.

import { chart } from "/assets/chart.js";
import { download_link, element, fetch_json, format_duration, format_number, send_request } from "/assets/page.js";

const MAX_POINTS = 200;

/** Id and status of the rendered job; details are rendered again only when they change. */
let rendered = "";
/** Number of calls of `show` so far, and of the one whose job is rendered: responses may arrive out of order. */
let calls = 0;
let rendered_call = 0;

/** Job id in the URL. */
export function selected_id() {
  const name = location.hash.slice(1);
  return /^[0-9a-f-]{36}$/.test(name) ? name : null;
}

function definition_list(entries) {
  const present = entries.filter(([, value]) => value != null && value !== "");
  return element("dl", {}, ...present.flatMap(([name, value]) => [element("dt", {}, name), element("dd", {}, value)]));
}

function format_time(text) {
  return text == null ? null : new Date(text).toLocaleString();
}

function render_status(job) {
  const { phase, eta_s, fraction } = job.progress;
  const running = job.status === "running";
  return definition_list([
    ["status", element("span", { class: job.status }, job.outcome ? `${job.status} (${job.outcome})` : job.status)],
    ["reason", job.status_reason],
    ["progress", running ? `${(100 * fraction).toFixed(1)} %, ${phase ?? ""}${eta_s == null ? "" : `, ${format_duration(eta_s)} left`}` : null],
    ["attempts", job.attempts > 1 ? `${job.attempts}` : null],
    ["submitted", format_time(job.created_at)],
    ["started", format_time(job.started_at)],
    ["ended", format_time(job.finished_at)],
  ]);
}

/** Estimated errors in words, e.g. `depth 0.5 %, width 1.2 %, area 0.1 %, peak pressure 2 %`. */
function format_errors({ errors, estimated_relative_error }) {
  const percent = (error) => `${format_number(error, 100)} %`;
  if (errors == null) return estimated_relative_error == null ? null : percent(estimated_relative_error);
  const names = [["depth", "worn_depth"], ["width", "scar_half_width"], ["area", "worn_area"], ["peak pressure", "peak_pressure"]];
  return names.map(([name, field]) => `${name} ${percent(errors[field].relative)}`).join(", ");
}

/** Names of effects by whether they were simulated. */
function effect_names(effects, is_simulated) {
  const on = ["simulated", "forced_on"];
  const names = Object.keys(effects ?? {}).filter((name) => on.includes(effects[name]) === is_simulated);
  return names.join(", ").replaceAll("_", " ");
}

/** The plan's decision about each effect, with the numbers that it was made by. */
function render_plan({ effects }) {
  const percent = (value) => (value == null ? "" : `${format_number(value, 100)} %`);
  const row = ({ effect, decision, value, threshold, indicator, reason }) =>
    element("tr", { title: indicator },
      ...[effect.replaceAll("_", " "), decision.replaceAll("_", " "), percent(value), percent(threshold), reason].map((text) => element("td", {}, text)));
  const head = element("tr", {}, ...["effect", "decision", "change of the outputs", "limit", "reason"].map((text) => element("th", {}, text)));
  return element("details", {}, element("summary", {}, "effects: what is simulated and why"), element("table", {}, head, ...effects.map(row)));
}

function render_summary({ receptacle, slider, peak_pressure_mpa, initial, accuracy, cost, cycles_done, effects, warnings }) {
  const sides = (field, scale, unit) => `${format_number(receptacle[field], scale)} / ${format_number(slider[field], scale)} ${unit}`;
  return definition_list([
    ["cycles", `${cycles_done}, ${accuracy.computed_cycles} of them computed`],
    ["maximum worn depth, receptacle / slider", sides("max_depth_mm", 1000, "µm")],
    ["scar half-width", sides("scar_half_width_mm", 1000, "µm")],
    ["worn area", sides("worn_area_mm2", 1e6, "µm²")],
    ["peak pressure, unworn / worn", `${format_number(initial.peak_pressure_mpa)} / ${format_number(peak_pressure_mpa)} MPa`],
    ["estimated error", format_errors(accuracy)],
    ["warnings", (warnings ?? []).join("; ")],
    ["simulated", effect_names(effects, true)],
    ["left out", effect_names(effects, false)],
    ["computing time", format_duration(cost.wall_s)],
  ]);
}

async function wear_chart(job) {
  const history = await fetch_json(`${job.links.wear_history}?max_points=${MAX_POINTS}`);
  const side = (name) => ({ name, x: history.cycle, y: history[name].max_depth_mm.map((depth) => 1000 * depth) });
  return chart("cycle", "maximum worn depth, µm", [side("receptacle"), side("slider")]);
}

async function picture(path, name) {
  const response = await send_request(path);
  if (!response.ok) return "";
  const url = URL.createObjectURL(new Blob([await response.arrayBuffer()], { type: "image/svg+xml" }));
  const image = element("img", { src: url, alt: name });
  image.addEventListener("load", () => URL.revokeObjectURL(url));
  return element("figure", {}, image, element("figcaption", { class: "muted" }, name));
}

async function render_files(job) {
  const { files, links } = await fetch_json(job.links.results);
  const list = files.map(({ name, bytes }) => element("li", {}, download_link(links[name], name, name),
    element("span", { class: "muted" }, ` ${Math.ceil(bytes / 1000)} kB`)));
  const pictures = files.filter(({ name }) => name.endsWith(".svg"));
  return [
    element("div", { class: "pictures" }, ...(await Promise.all(pictures.map(({ name }) => picture(links[name], name))))),
    element("h3", {}, "files"), element("ul", {}, ...list),
  ];
}

/** Renders the details of a job; clears them for null. */
export async function show(job) {
  const section = document.getElementById("job");
  const call = ++calls;
  if (!job) {
    [rendered, rendered_call] = ["", call];
    return section.replaceChildren();
  }
  const current = `${job.id} ${job.status}`;
  if (current === rendered) {
    section.querySelector("#status").replaceChildren(render_status(job));
    if (job.status !== "running") return;
    const chart = await wear_chart(job);
    if (current === rendered) section.querySelector("#wear").replaceChildren(chart);
    return;
  }
  // After an error, the next poll renders it again.
  const children = [
    element("h2", {}, job.spec.name ?? job.spec.system.kind), element("p", { class: "mono muted" }, job.id),
    element("div", { id: "status" }, render_status(job)), ...(job.summary ? [render_summary(job.summary)] : []),
    element("div", { id: "wear" }, await wear_chart(job)), ...(job.finished_at ? await render_files(job) : []),
    ...(job.plan ? [render_plan(job.plan)] : []),
    element("details", {}, element("summary", {}, "resolved specification and plan"),
      element("div", {}, element("pre", {}, JSON.stringify({ spec: job.spec, plan: job.plan }, null, 2)))),
  ];
  if (selected_id() !== job.id || call < rendered_call) return;
  section.replaceChildren(...children);
  [rendered, rendered_call] = [current, call];
}
