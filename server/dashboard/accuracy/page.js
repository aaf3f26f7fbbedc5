// An accuracy study: live while its runs are missing, complete after them.

import { base_card, base_of } from "../batches/base.js";
import { counts_of } from "../batches/counts.js";
import { Head } from "../batches/head.js";
import { name_of } from "../batches/kinds.js";
import { fetch_json } from "../parts/client.js";
import { card, element } from "../parts/element.js";
import { follow } from "../parts/feed.js";
import { has_ended } from "../parts/status.js";
import { throttled } from "../parts/throttled.js";
import { choice_card, orders_card, reference_card } from "./cards.js";
import { Diagram } from "./diagram.js";
import { runs_of } from "./runs.js";
import { RunsTable } from "./table.js";

/** Least time between comparisons of a running study, for which the service reads the results of all runs, ms. */
const RELOAD_MS = 1500;

/** @type {import("../main.js").Page} */
export async function accuracy_page(content, { id }, signal) {
  let batch = await fetch_json(`/v1/studies/${id}`, { signal });
  let runs = runs_of(batch);
  document.title = `${name_of(batch, "accuracy")} · fretwear`;
  const reload = throttled(async () => {
    const progress = new Map(runs.map((run) => [run.id, run.progress]));
    batch = await fetch_json(`/v1/studies/${id}`, { signal });
    runs = runs_of(batch).map((run) => ({ ...run, progress: progress.get(run.id) }));
    await show();
  }, RELOAD_MS, signal);
  const head = new Head(batch, "accuracy", reload);
  const diagram = new Diagram(signal);
  const cards = element("div", { class: "cards" });
  const table = new RunsTable();
  const base = element("div", { class: "cards" });
  content.append(head.node, diagram.node, cards, table.node, base);

  const show = async () => {
    const { study } = batch;
    head.update(batch);
    table.show(study, runs);
    cards.replaceChildren(...(study
      ? [choice_card(study, runs), reference_card(study.reference, study.left_out), orders_card(study.reference.orders)]
      : [card("Comparison", element("p", {}, "It begins with the first run at a tolerance that has succeeded."))]));
    await diagram.show(study, runs);
  };
  await show();
  const spec = batch.study?.spec ?? (await base_of(batch, signal));
  if (spec) base.append(base_card(spec, ["/accuracy"]));

  follow({
    changed: (job) => {
      const run = runs.find((one) => one.id === job.id);
      if (!run) return;
      if (has_ended(job) && !has_ended(run)) reload();
      Object.assign(run, { status: job.status, outcome: job.outcome, progress: job.progress });
      table.update(run);
      head.update({ ...batch, counts: counts_of(runs) });
    },
    deleted: (deleted) => {
      if (runs.some((run) => run.id === deleted)) reload();
    },
    reset: reload,
    started: reload,
  }, signal);
  return () => diagram.show(batch.study, runs);
}
