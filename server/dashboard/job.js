// One job in full: where it stands and why, its figures, its wear so far, its pictures and its files.

import { chart } from "/assets/chart.js";
import { ask, document_at, download_link, element, figure, span_of } from "/assets/page.js";

const POINTS = 200;

/** What is shown, so that it is only made anew when it changes. */
let present = "";
/** Turns begun, and the one whose job is shown: answers may overtake each other. */
let turns = 0;
let shown = 0;

/** The id that the address names. */
export function showing() {
  const name = location.hash.slice(1);
  return /^[0-9a-f-]{36}$/.test(name) ? name : null;
}

function pairs(entries) {
  const known = entries.filter(([, value]) => value != null && value !== "");
  return element("dl", {}, ...known.flatMap(([name, value]) => [element("dt", {}, name), element("dd", {}, value)]));
}

function time(text) {
  return text == null ? null : new Date(text).toLocaleString();
}

function standing(job) {
  const { phase, eta_s, fraction } = job.progress;
  const running = job.status === "running";
  return pairs([
    ["status", element("span", { class: job.status }, job.outcome ? `${job.status} (${job.outcome})` : job.status)],
    ["reason", job.status_reason],
    ["progress", running ? `${(100 * fraction).toFixed(1)} %, ${phase ?? ""}${eta_s == null ? "" : `, ${span_of(eta_s)} left`}` : null],
    ["attempts", job.attempts > 1 ? `${job.attempts}` : null],
    ["accepted", time(job.created_at)],
    ["started", time(job.started_at)],
    ["ended", time(job.finished_at)],
  ]);
}

function figures({ receptacle, slider, peak_pressure_mpa, initial, accuracy, cost, cycles_done }) {
  const sides = (field, scale, unit) => `${figure(receptacle[field], scale)} / ${figure(slider[field], scale)} ${unit}`;
  return pairs([
    ["cycles", `${cycles_done}, ${accuracy.computed_cycles} of them computed`],
    ["deepest, receptacle / slider", sides("max_depth_mm", 1000, "µm")],
    ["half-width of the scar", sides("scar_half_width_mm", 1000, "µm")],
    ["worn area", sides("worn_area_mm2", 1e6, "µm²")],
    ["peak pressure, unworn / worn", `${figure(initial.peak_pressure_mpa)} / ${figure(peak_pressure_mpa)} MPa`],
    ["estimated error", accuracy.estimated_relative_error == null ? null : `${figure(accuracy.estimated_relative_error, 100)} %`],
    ["computing time", span_of(cost.wall_s)],
  ]);
}

async function wear(job) {
  const history = await document_at(`${job.links.wear_history}?max_points=${POINTS}`);
  const side = (name) => ({ name, x: history.cycle, y: history[name].max_depth_mm.map((depth) => 1000 * depth) });
  return chart("cycle", "deepest, µm", [side("receptacle"), side("slider")]);
}

async function picture(path, name) {
  const answer = await ask(path);
  if (!answer.ok) return "";
  const address = URL.createObjectURL(new Blob([await answer.arrayBuffer()], { type: "image/svg+xml" }));
  const image = element("img", { src: address, alt: name });
  image.addEventListener("load", () => URL.revokeObjectURL(address));
  return element("figure", {}, image, element("figcaption", { class: "soft" }, name));
}

async function produced(job) {
  const { files, links } = await document_at(job.links.results);
  const list = files.map(({ name, bytes }) => element("li", {}, download_link(links[name], name, name),
    element("span", { class: "soft" }, ` ${Math.ceil(bytes / 1000)} kB`)));
  const pictures = files.filter(({ name }) => name.endsWith(".svg"));
  return [
    element("div", { class: "pictures" }, ...(await Promise.all(pictures.map(({ name }) => picture(links[name], name))))),
    element("h3", {}, "files"), element("ul", {}, ...list),
  ];
}

/** Shows a job, or nothing. */
export async function show(job) {
  const place = document.getElementById("job");
  const turn = ++turns;
  if (!job) {
    [present, shown] = ["", turn];
    return place.replaceChildren();
  }
  const wanted = `${job.id} ${job.status}`;
  if (wanted === present) {
    place.querySelector("#standing").replaceChildren(standing(job));
    if (job.status !== "running") return;
    const picture = await wear(job);
    if (wanted === present) place.querySelector("#wear").replaceChildren(picture);
    return;
  }
  // What fails here is made again the next time.
  const children = [
    element("h2", {}, job.spec.name ?? job.spec.system.kind), element("p", { class: "mono soft" }, job.id),
    element("div", { id: "standing" }, standing(job)), ...(job.summary ? [figures(job.summary)] : []),
    element("div", { id: "wear" }, await wear(job)), ...(job.finished_at ? await produced(job) : []),
    element("details", {}, element("summary", {}, "resolved specification and plan"),
      element("div", {}, element("pre", {}, JSON.stringify({ spec: job.spec, plan: job.plan }, null, 2)))),
  ];
  if (showing() !== job.id || turn < shown) return;
  place.replaceChildren(...children);
  [present, shown] = [wanted, turn];
}
