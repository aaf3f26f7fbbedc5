// A new job: a specification as fields and as JSON, its plan as one types, faults at their fields.

import { fetch_json, post_json, Problem } from "../parts/client.js";
import { Unreachable, when_reached_again } from "../parts/connection.js";
import { Draft } from "../parts/draft.js";
import { card, element } from "../parts/element.js";
import { words } from "../parts/format.js";
import { throttled, TYPING_MS } from "../parts/throttled.js";
import { cloned_batch, cloned_job } from "./clone.js";
import { Expectation } from "./expectation.js";
import { Fields } from "./fields.js";
import { faults_list } from "./plan.js";
import { Shape } from "./schema.js";
import { Submission } from "./submission.js";
import { taken_over_in_words, with_system } from "./systems.js";

/** What is said of a clone that is not as it was sent. */
const RESOLVED_ONLY = "An earlier version has queued this, which did not store what was sent: every value counts as given here, the defaults too.";

/** @type {import("../main.js").Page} */
export async function study_page(content, { values }, signal) {
  document.title = "New study · fretwear";
  const draft = new Draft();
  const { typed } = draft;
  const { systems } = await fetch_json("/v1/systems", { signal });
  const batch = values.get("batch");
  const copied = batch && !typed ? await cloned_batch(batch, values.get("as"), signal) : null;
  const start = typed ?? copied ?? (await cloned_or_new(values, systems[0].kind, signal));

  const system = /** @type {HTMLSelectElement} */ (element("select", { id: "system" }, ...systems.map((/** @type {any} */ { kind }) => element("option", { value: kind }, words(kind)))));
  const text = /** @type {HTMLTextAreaElement} */ (element("textarea", { spellcheck: "false", "aria-label": "specification as JSON", rows: 14 }));
  const faults = element("div", { role: "alert", class: "faults" });
  const taken_over = element("p", { class: "muted", role: "status" });
  const expectation = new Expectation();
  /** The resolved specification of the last plan. @type {any} */
  let resolved = null;
  /** The kind of the system that is shown, and what is typed for other ones. */
  let kind = "";
  /** @type {Record<string, string>} */
  const of_systems = typed?.of_systems ?? {};
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
  const keep = () => draft.keep({ text: text.value, of_systems, is_as_sent: start.is_as_sent, submission: submission.state });
  const submission = new Submission({ signal, cloned: copied, typed: typed?.submission, refused, changed: () => keep() });

  /** @returns {any} the specification, or null while the text is not JSON */
  const parsed = () => {
    try {
      return JSON.parse(text.value);
    } catch (error) {
      faults.replaceChildren(element("p", {}, error instanceof Error ? error.message : String(error)));
      return null;
    }
  };
  const write_text = (/** @type {string} */ written) => {
    text.value = written;
    keep();
    ask();
  };
  const write = (/** @type {any} */ spec) => write_text(JSON.stringify(spec, null, 2));
  let asked = 0;
  const show_plan = async () => {
    const call = ++asked;
    const spec = parsed();
    submission.typed(spec);
    if (!spec) return expectation.is_outdated();
    kind = system.value = spec.system?.kind ?? "";
    try {
      const found = await post_json("/v1/plans", spec);
      if (call !== asked || signal.aborted) return;
      resolved = found.spec;
      faults.replaceChildren();
      show_fields(spec, []);
      expectation.show(found);
      submission.planned(found, new Shape(system_of(resolved).schema));
    } catch (error) {
      if (call !== asked || signal.aborted) return;
      if (error instanceof Problem) refused(error);
      else if (!(error instanceof Unreachable)) throw error;
      expectation.is_outdated();
      submission.planned(null, null);
    }
  };
  const ask = throttled(show_plan, TYPING_MS, signal);
  text.addEventListener("input", () => write_text(text.value));
  system.addEventListener("change", () => {
    const [spec, next] = [parsed(), system.value];
    const former = spec?.system?.kind ?? kind;
    kind = next;
    taken_over.replaceChildren();
    if (former) of_systems[former] = text.value;
    if (of_systems[next] !== undefined) return write_text(of_systems[next]);
    const said = taken_over_in_words(spec);
    if (said) taken_over.replaceChildren(said, " ", element("button", { type: "button", class: "quiet", click: () => {
      taken_over.replaceChildren();
      write({ system: { kind: next } });
    } }, "start from the preset"));
    write(with_system(spec, next));
  });
  // A field that is still being typed into counts when the page is left.
  const leave = () => {
    const at = document.activeElement;
    if (at instanceof HTMLInputElement && fields.node.contains(at) && at.value !== at.defaultValue) at.dispatchEvent(new Event("change"));
  };
  signal.addEventListener("abort", leave, { once: true });
  addEventListener("pagehide", leave, { signal });
  when_reached_again(ask, signal);

  content.append(element("h1", {}, "New study"),
    element("p", { class: "muted", hidden: start.is_as_sent }, RESOLVED_ONLY),
    element("p", { class: "line" }, element("label", { for: "system" }, "System "), system, ...submission.controls), taken_over, faults, submission.forms,
    element("div", { class: "study" }, card("Fields", fields.node), element("div", {}, expectation.drawing,
      card("Specification as JSON", text, element("details", {}, element("summary", {}, "as a command"), submission.request)), expectation.plan)));
  text.value = typed?.text ?? JSON.stringify(start.spec, null, 2);
  await show_plan();
}

/**
 * First content of the form: the specification of a job, or the preset of a system.
 * @param {URLSearchParams} values of the address
 * @param {string} first kind of the first system
 * @param {AbortSignal} signal
 * @returns {Promise<import("./clone.js").Sent>}
 */
async function cloned_or_new(values, first, signal) {
  const from = values.get("from");
  return from ? cloned_job(from, signal) : { spec: { system: { kind: values.get("system") ?? first } }, is_as_sent: true };
}
