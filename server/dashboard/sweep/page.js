// A sweep: live while its jobs run, complete after it.

import { base_card, base_of } from "../batches/base.js";
import { counts_of } from "../batches/counts.js";
import { Head } from "../batches/head.js";
import { name_of } from "../batches/kinds.js";
import { element } from "../parts/element.js";
import { count } from "../parts/format.js";
import { follow } from "../parts/feed.js";
import { has_ended } from "../parts/status.js";
import { listed_quantities } from "../parts/summary.js";
import { throttled } from "../parts/throttled.js";
import { fields_of, load_points } from "./points.js";
import { ordered } from "./quantities.js";
import { refused_card } from "./refused.js";
import { PointsTable } from "./table.js";
import { View } from "./view.js";

/** Least time between loads of the table of a running sweep, ms: in all, and for each of its jobs. */
const RELOAD_MS = 700;
const RELOAD_MS_A_JOB = 3;

/** @type {import("../main.js").Page} */
export async function sweep_page(content, { id }, signal) {
  let [{ sweep, points }, listed] = await Promise.all([load_points(id ?? "", signal), listed_quantities(signal)]);
  document.title = `${name_of(sweep, "sweep")} · fretwear`;
  const reload = throttled(async () => {
    const progress = new Map(points.map((point) => [point.id, point.progress]));
    ({ sweep, points } = await load_points(id ?? "", signal));
    for (const point of points) point.progress = progress.get(point.id);
    await show();
  }, Math.max(RELOAD_MS, RELOAD_MS_A_JOB * points.length), signal);
  const head = new Head(sweep, "sweep", reload);
  const quantities = ordered(listed);
  const view = new View(quantities, signal);
  const table = new PointsTable(quantities);
  const base = element("div", { class: "cards" });
  const part = element("p", { class: "muted", hidden: true });
  const refused = element("div", { class: "cards" });
  content.append(head.node, refused, part, view.node, table.node, base);

  const show = async () => {
    head.update(sweep);
    part.hidden = !sweep.asked;
    part.textContent = `The first ${count(points.length)} of ${count(sweep.asked ?? points.length)} points; the table as CSV has all that are queued or have ended.`;
    refused.replaceChildren(...(sweep.refused ? [refused_card(sweep)] : []));
    table.show(points);
    await view.show(points);
  };
  await show();
  const spec = await base_of(sweep, signal);
  if (spec) base.append(base_card(spec, fields_of(points).map(({ pointer }) => pointer)));

  follow({
    changed: (job) => {
      const point = points.find((one) => one.id === job.id);
      // It may be one of a large sweep that is not shown.
      if (sweep.asked && has_ended(job)) reload();
      if (!point) return;
      if (has_ended(job) && !has_ended(point)) reload();
      Object.assign(point, { status: job.status, outcome: job.outcome, progress: job.progress });
      table.update(point);
      if (!sweep.asked) head.update({ ...sweep, counts: counts_of(points) });
    },
    deleted: (deleted) => {
      if (points.some((point) => point.id === deleted)) reload();
    },
    reset: reload,
    started: reload,
  }, signal);
  return () => view.follow_address();
}
