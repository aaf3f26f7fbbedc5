// A new job: a specification as fields and as JSON, its plan as one types, faults at their fields.

import { fetch_json, post_json, Problem } from "../parts/client.js";
import { card, element } from "../parts/element.js";
import { words } from "../parts/format.js";
import { throttled } from "../parts/throttled.js";
import { cloned_batch, cloned_job } from "./clone.js";
import { drawing } from "./drawing.js";
import { Fields } from "./fields.js";
import { faults_list, plan_cards } from "./plan.js";
import { Shape } from "./schema.js";
import { Submission } from "./submission.js";

/** What is said of a clone that is not as it was sent. */
const RESOLVED_ONLY = "An earlier version has queued this, which did not store what was sent: every value counts as given here, the defaults too.";

/** Pause after a key before the plan is asked for, ms. */
const TYPING_MS = 300;

/** @type {import("../main.js").Page} */
export async function study_page(content, { values }, signal) {
  document.title = "New study · fretwear";
  const { systems } = await fetch_json("/v1/systems", { signal });
  const from = values.get("from");
  const batch = values.get("batch");
  const copied = batch ? await cloned_batch(batch, values.get("as"), signal) : null;
  const start = copied ?? (from ? await cloned_job(from, signal) : { spec: { system: { kind: values.get("system") ?? systems[0].kind } }, is_as_sent: true });

  const system = /** @type {HTMLSelectElement} */ (element("select", { id: "system" }, ...systems.map((/** @type {any} */ { kind }) => element("option", { value: kind }, words(kind)))));
  const text = /** @type {HTMLTextAreaElement} */ (element("textarea", { spellcheck: "false", "aria-label": "specification as JSON", rows: 14 }));
  const faults = element("div", { role: "alert", class: "faults" });
  const plan = element("div", { class: "cards" });
  const scene = element("div", { class: "drawing" });
  /** The resolved specification of the last plan. @type {any} */
  let resolved = null;
  const fields = new Fields((edit) => {
    const spec = parsed();
    if (spec) write(edit(spec));
  });
  const system_of = (/** @type {any} */ spec) => systems.find((/** @type {any} */ { kind }) => kind === spec.system?.kind);
  const show_fields = (/** @type {any} */ spec, /** @type {import("./fields.js").Fault[]} */ faults) => {
    const of = system_of(spec);
    if (of) fields.show({ spec, resolved: resolved?.system.kind === of.kind ? resolved : of.preset, shape: new Shape(of.schema), faults, systems });
  };
  const refused = (/** @type {Problem} */ problem) => {
    const spec = parsed();
    if (spec) show_fields(spec, problem.faults);
    faults.replaceChildren(faults_list(problem, (pointer) => fields.focus(pointer)));
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
      show_fields(spec, []);
      scene.replaceChildren(...drawing(resolved));
      plan.replaceChildren(...plan_cards(found.plan));
      submission.planned(found, new Shape(system_of(resolved).schema));
    } catch (error) {
      if (call !== asked || signal.aborted) return;
      if (!(error instanceof Problem)) throw error;
      refused(error);
      submission.planned(null, null);
    }
  };
  const ask = throttled(show_plan, TYPING_MS, signal);
  text.addEventListener("input", ask);
  system.addEventListener("change", () => write({ system: { kind: system.value } }));

  content.append(element("h1", {}, "New study"),
    element("p", { class: "muted", hidden: start.is_as_sent }, RESOLVED_ONLY),
    element("p", { class: "line" }, element("label", { for: "system" }, "System "), system, ...submission.controls), faults, submission.forms,
    element("div", { class: "study" }, card("Fields", fields.node), element("div", {}, card("To scale", scene),
      card("Specification as JSON", text, element("details", {}, element("summary", {}, "as a command"), submission.request)), plan)));
  text.value = JSON.stringify(start.spec, null, 2);
  await show_plan();
}
