// Submitting a specification: as one job, as the base of a sweep, or of an accuracy study.

import { choices, link } from "../parts/address.js";
import { post_json, Problem } from "../parts/client.js";
import { Unreachable } from "../parts/connection.js";
import { element } from "../parts/element.js";
import { duration_range } from "../parts/format.js";
import { throttled, TYPING_MS } from "../parts/throttled.js";
import { AccuracyForm } from "./accuracy_form.js";
import { SweepForm } from "./sweep_form.js";

/** @typedef {"job" | "sweep" | "accuracy"} Kind */

/** What is submitted: its name, its collection, its page. @type {Record<Kind, [string, string, string]>} */
const KINDS = { job: ["one job", "/v1/jobs", "job"], sweep: ["sweep", "/v1/sweeps", "sweep"], accuracy: ["accuracy study", "/v1/studies", "accuracy"] };

/** Status of an answer that names faults of the request. */
const REFUSED = 422;

/** The choice of what is submitted, its forms, its request and the button. */
export class Submission {
  /** The specification, while it is one. @type {any} */
  #spec = null;
  #is_accepted = false;
  /** Processor time of the specification as one job, in words. */
  #expected = "";
  /** The sweep whose processor time is known or asked for, as it would be sent. */
  #planned_sweep = "";
  /** Faults that the service has found in it. @type {{pointer: string, detail: string}[]} */
  #sweep_faults = [];
  #plan_sweep;
  #signal;
  #refused;
  #changed = () => {};
  #kind = /** @type {HTMLSelectElement} */ (element("select", { id: "kind", "aria-label": "what is submitted" }, ...Object.entries(KINDS).map(([kind, [name]]) => element("option", { value: kind }, name))));
  #name = /** @type {HTMLInputElement} */ (element("input", { id: "batch-name", type: "text", maxlength: 200, class: "name" }));
  #name_row = element("p", { class: "field" }, element("label", { for: "batch-name" }, "name of all jobs together"), this.#name);
  #sweep = new SweepForm(() => this.#show());
  #accuracy = new AccuracyForm(() => this.#show());
  #body = element("pre", { tabindex: "0" });
  #curl = element("pre", { tabindex: "0" });
  #said = element("span", { role: "status" });
  #button = element("button", { type: "button", class: "primary" }, "Submit");

  /**
   * @param {{signal: AbortSignal, cloned: import("./clone.js").Cloned | null, typed: any, refused: (problem: Problem) => void, changed: () => void}} options
   * `typed` is the state of before, if there is one; `changed` is called when it has changed
   */
  constructor({ signal, cloned, typed, refused, changed }) {
    this.#signal = signal;
    this.#refused = refused;
    this.#plan_sweep = throttled(() => this.#ask_for_sweep(), TYPING_MS, signal);
    const asked = choices.get("as") ?? "";
    this.#kind.value = asked in KINDS ? asked : "job";
    this.#kind.addEventListener("change", () => {
      choices.set("as", this.#kind.value === "job" ? null : this.#kind.value);
      this.#show();
    });
    this.#name.addEventListener("input", () => this.#show());
    this.#button.addEventListener("click", () => this.#submit());
    this.controls = [element("label", {}, "submitted as ", this.#kind), this.#button, this.#said];
    this.forms = element("div", { class: "submission" }, this.#sweep.node, this.#accuracy.node);
    this.request = element("details", {}, element("summary", {}, "the request as a command"), this.#curl, this.#body);
    if (typed) {
      this.#sweep.restore(typed.sweep);
      this.#accuracy.restore(typed.budget);
      this.#name.value = typed.name;
    } else if (cloned) {
      this.#sweep.take(cloned);
      this.#name.value = cloned.name;
    }
    this.#show();
    this.#changed = changed;
  }

  /** What is typed. */
  get state() {
    return { name: this.#name.value, sweep: this.#sweep.state, budget: this.#accuracy.state };
  }

  /** @returns {Kind} */
  get kind() {
    return /** @type {Kind} */ (this.#kind.value);
  }

  /** @param {any} spec the specification as it is typed; null while it is none */
  typed(spec) {
    this.#spec = spec;
    if (spec === null) this.#is_accepted = false;
    this.#show();
  }

  /**
   * @param {any} found the plan of the specification and its resolved form; null where it was refused
   * @param {import("./schema.js").Shape | null} shape what may stand in it
   */
  planned(found, shape) {
    this.#is_accepted = found !== null;
    const { cpu_s, cpu_s_most } = found?.plan.estimates ?? {};
    this.#expected = duration_range(cpu_s, cpu_s_most);
    if (found && shape) this.#sweep.offer(found.spec, shape);
    this.#show();
  }

  #request() {
    const named = this.#name.value.trim() ? { name: this.#name.value.trim() } : {};
    if (this.kind === "sweep") return { ...named, base: this.#spec, ...this.#sweep.variations };
    if (this.kind === "accuracy") return { ...named, base: this.#spec, budget_s: this.#accuracy.budget_s };
    return this.#spec;
  }

  #show() {
    this.#changed();
    this.#said.textContent = "";
    const form = { job: null, sweep: this.#sweep, accuracy: this.#accuracy }[this.kind];
    for (const one of [this.#sweep, this.#accuracy]) one.node.hidden = one !== form;
    if (form && this.#name_row.parentElement !== form.node) form.node.querySelector("h2")?.after(this.#name_row);
    this.#sweep.show();
    this.#accuracy.show(this.#expected);
    this.#plan_sweep();
    const is_ready = this.#is_accepted && this.#spec !== null && (form?.is_complete ?? true);
    this.#button.toggleAttribute("disabled", !is_ready);
    const { jobs } = this.#sweep;
    this.#button.textContent = this.kind === "sweep" && jobs ? `Submit ${jobs === 1 ? "1 job" : `${jobs} jobs`}` : "Submit";
    if (this.#spec === null) return;
    const body = this.#request();
    this.#body.hidden = this.kind === "job";
    this.#body.textContent = JSON.stringify(body, null, 2);
    this.#curl.textContent = `curl --json '${JSON.stringify(body).replaceAll("'", "'\\''")}' ${location.origin}${KINDS[this.kind][1]}`;
  }

  /** Asks what the sweep takes; of one that was asked before, shows the faults again. */
  async #ask_for_sweep() {
    const asked = this.kind === "sweep" && this.#is_accepted && this.#sweep.is_complete ? JSON.stringify(this.#request()) : "";
    if (asked === this.#planned_sweep) return void this.#sweep.mark(this.#sweep_faults);
    this.#planned_sweep = asked;
    this.#sweep_faults = [];
    this.#sweep.expect("");
    if (asked === "") return;
    try {
      const { estimates } = await post_json("/v1/sweeps/plans", JSON.parse(asked));
      if (asked === this.#planned_sweep && !this.#signal.aborted) this.#sweep.expect(duration_range(estimates.cpu_s, estimates.cpu_s_most));
    } catch (error) {
      if (!(error instanceof Problem || error instanceof Unreachable)) throw error;
      if (asked !== this.#planned_sweep || this.#signal.aborted) return;
      if (error instanceof Problem && error.status === REFUSED) {
        // Faults of no field of the sweep are said when it is submitted.
        this.#sweep_faults = error.faults;
        this.#sweep.mark(error.faults);
      } else this.#planned_sweep = "";
    }
  }

  async #submit() {
    const [, path, page] = KINDS[this.kind];
    this.#button.setAttribute("disabled", "");
    this.#said.textContent = this.kind === "accuracy" ? "Choosing the runs …" : "";
    try {
      const { id } = await post_json(path, this.#request());
      if (!this.#signal.aborted) location.hash = link(page, id);
    } catch (error) {
      this.#said.textContent = error instanceof Error ? error.message : String(error);
      this.#button.removeAttribute("disabled");
      if (error instanceof Problem) this.#mark(error);
    }
  }

  /** @param {Problem} problem whose faults are shown at their fields */
  #mark({ message, status, faults }) {
    const form = { job: null, sweep: this.#sweep, accuracy: this.#accuracy }[this.kind];
    const others = form ? form.mark(faults) : faults;
    const of_base = others.map(({ pointer, detail }) => ({ pointer: pointer.replace(/^\/base(?=\/|$)/, ""), detail }));
    if (of_base.length || faults.length === 0) this.#refused(new Problem(message, status, of_base));
  }
}
