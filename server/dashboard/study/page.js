// A new job: a specification as fields and as JSON, its plan as one types, faults at their fields.

import { fetch_json, post_json, Problem } from "../parts/client.js";
import { card, element } from "../parts/element.js";
import { words } from "../parts/format.js";
import { throttled } from "../parts/throttled.js";
import { cloned_batch } from "./clone.js";
import { drawing } from "./drawing.js";
import { Fields, set_value } from "./fields.js";
import { faults_list, plan_cards } from "./plan.js";
import { Submission } from "./submission.js";

/** Pause after a key before the plan is asked for, ms. */
const TYPING_MS = 300;

/** @type {import("../main.js").Page} */
export async function study_page(content, { values }, signal) {
  document.title = "New study · fretwear";
  const { systems } = await fetch_json("/v1/systems", { signal });
  const from = values.get("from");
  const batch = values.get("batch");
  const copied = batch ? await cloned_batch(batch, values.get("as"), signal) : null;
  const start = copied ? copied.base : from ? cloned(await fetch_json(`/v1/jobs/${from}`, { signal })) : { system: { kind: values.get("system") ?? systems[0].kind } };

  const system = /** @type {HTMLSelectElement} */ (element("select", { id: "system" }, ...systems.map((/** @type {any} */ { kind }) => element("option", { value: kind }, words(kind)))));
  const text = /** @type {HTMLTextAreaElement} */ (element("textarea", { spellcheck: "false", "aria-label": "specification as JSON", rows: 14 }));
  const faults = element("div", { role: "alert", class: "faults" });
  const plan = element("div", { class: "cards" });
  const scene = element("div", { class: "drawing" });
  /** The resolved specification of the last plan. @type {any} */
  let resolved = null;
  const fields = new Fields((pointer, value) => {
    const spec = parsed();
    if (!spec) return;
    write(set_value(spec, resolved, pointer, value));
  });
  const refused = (/** @type {Problem} */ problem) => {
    faults.replaceChildren(faults_list(problem));
    fields.mark(problem.faults);
  };
  const submission = new Submission({ signal, cloned: copied, refused });

  /** @returns {any} the specification, or null while the text is not JSON */
  const parsed = () => {
    try {
      return JSON.parse(text.value);
    } catch (error) {
      faults.replaceChildren(element("p", {}, error instanceof Error ? error.message : String(error)));
      return null;
    }
  };
  const write = (/** @type {any} */ spec) => {
    text.value = JSON.stringify(spec, null, 2);
    ask();
  };
  let asked = 0;
  const show_plan = async () => {
    const spec = parsed();
    submission.typed(spec);
    if (!spec) return;
    system.value = spec.system?.kind ?? "";
    const call = ++asked;
    try {
      const found = await post_json("/v1/plans", spec);
      if (call !== asked || signal.aborted) return;
      resolved = found.spec;
      faults.replaceChildren();
      fields.show(resolved, []);
      scene.replaceChildren(...drawing(resolved));
      plan.replaceChildren(...plan_cards(found.plan));
      await submission.planned(found);
    } catch (error) {
      if (call !== asked || signal.aborted) return;
      if (!(error instanceof Problem)) throw error;
      await submission.planned(null);
      refused(error);
    }
  };
  const ask = throttled(show_plan, TYPING_MS, signal);
  text.addEventListener("input", ask);
  system.addEventListener("change", () => write({ system: { kind: system.value } }));

  content.append(element("h1", {}, "New study"),
    element("p", { class: "line" }, element("label", { for: "system" }, "System "), system, ...submission.controls), faults, submission.forms,
    element("div", { class: "cards" }, card("To scale", scene), card("Specification as JSON", text, submission.request)),
    plan, card("Fields", fields.node));
  text.value = JSON.stringify(start, null, 2);
  await show_plan();
}

/**
 * The specification of a job, without where its values are from.
 * @param {any} job
 * @returns {any}
 */
function cloned({ spec: { provenance: _, ...spec } }) {
  return { ...spec, name: `${spec.name ?? words(spec.system.kind)}, changed` };
}
