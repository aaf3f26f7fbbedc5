// What a sweep varies: its fields with their values, and how they are combined.

import { card, element } from "../parts/element.js";
import { count } from "../parts/format.js";
import { leaves } from "../parts/leaves.js";
import { SweptField } from "./swept_field.js";

/** Jobs that the service accepts in a sweep at most: of every combination, and of a list. */
const MOST_JOBS = 1e6;
const MOST_LISTED = 1000;
/** Parts of a specification that are not swept. */
const LEFT_OUT = ["/provenance", "/output", "/labels", "/name"];
/** Parts that can be given by a name of the library as well. */
const BY_NAME = ["/materials/slider", "/materials/receptacle"];

/** The form of a sweep. */
export class SweepForm {
  #changed;
  /** @type {SweptField[]} */
  #fields = [];
  /** @type {import("./swept_field.js").Offered[]} */
  #offered = [];
  /** @type {import("./schema.js").Shape | null} */
  #shape = null;
  /** Processor time of all jobs together, in words; empty while it is not known. */
  #together = "";
  #rows = element("div");
  #combined = /** @type {HTMLSelectElement} */ (element("select", { id: "combined" }, element("option", { value: "grid" }, "every combination"), element("option", { value: "list" }, "first with first, second with second, …")));
  #combined_label = element("label", {}, "Values combined as ", this.#combined);
  #said = element("p", { role: "status" });

  /** @param {() => void} changed */
  constructor(changed) {
    this.#changed = changed;
    this.#combined.addEventListener("change", changed);
    this.node = card("Sweep", element("p", { class: "muted" }, "One job for each value of a field, or for each combination of values of several fields."), this.#rows,
      element("p", { class: "line" }, element("button", { type: "button", click: () => this.#add() }, "Add a field"), this.#combined_label), this.#said);
    this.#insert();
  }

  #add() {
    this.#insert();
    this.#changed();
  }

  #insert() {
    const field = new SweptField(this.#changed, () => {
      this.#remove(field);
      this.#changed();
    });
    field.offer(this.#offered, this.#shape);
    this.#fields.push(field);
    this.#rows.append(field.node);
    return field;
  }

  /** @param {SweptField} field */
  #remove(field) {
    this.#fields = this.#fields.filter((one) => one !== field);
    field.node.remove();
  }

  /**
   * Takes the fields of a sweep that is cloned.
   * @param {import("./clone.js").Cloned} cloned
   */
  take({ fields, is_grid }) {
    for (const { pointer, values } of fields) (this.#fields.find((one) => one.pointer === "") ?? this.#insert()).take(pointer, values);
    this.#combined.value = is_grid ? "grid" : "list";
  }

  /** What is typed. */
  get state() {
    return { combined: this.#combined.value, fields: this.#fields.map(({ state }) => state) };
  }

  /** @param {any} typed */
  restore({ combined, fields }) {
    for (const field of [...this.#fields]) this.#remove(field);
    for (const typed of fields) this.#insert().restore(typed);
    this.#combined.value = combined;
  }

  /**
   * Offers the fields of a specification that has been planned.
   * @param {any} resolved
   * @param {import("./schema.js").Shape} shape
   */
  offer(resolved, shape) {
    const all = leaves(resolved).filter(([pointer, value]) => value !== null && !LEFT_OUT.some((start) => pointer.startsWith(start)));
    const by_name = BY_NAME.filter((pointer) => resolved.materials?.[pointer.split("/")[2]]);
    this.#offered = [...all.map(([pointer, value]) => ({ pointer, value })), ...by_name.map((pointer) => ({ pointer, value: "" }))];
    this.#shape = shape;
    for (const field of this.#fields) field.offer(this.#offered, shape);
    this.show();
  }

  /** The part of the request that names the variations. */
  get variations() {
    const entries = this.#fields.filter(({ pointer }) => pointer !== "").map(({ pointer, values }) => /** @type {[string, unknown[]]} */ ([pointer, values]));
    if (this.#combined.value === "grid" || entries.length < 2) return { grid: Object.fromEntries(entries) };
    const length = Math.min(...entries.map(([, values]) => values.length));
    return { list: Array.from({ length }, (_, index) => Object.fromEntries(entries.map(([pointer, values]) => [pointer, values[index]]))) };
  }

  /** Jobs of the sweep. */
  get jobs() {
    const { grid, list } = this.variations;
    if (list) return list.length;
    const lengths = Object.values(grid ?? {}).map((values) => values.length);
    return lengths.length ? lengths.reduce((all, some) => all * some, 1) : 0;
  }

  get #most_jobs() {
    return this.variations.list ? MOST_LISTED : MOST_JOBS;
  }

  /** Whether it can be submitted. */
  get is_complete() {
    return this.jobs >= 1 && this.jobs <= this.#most_jobs && this.#fields.every((field) => this.#fault(field) === "");
  }

  /**
   * What is wrong with a field before it is sent.
   * @param {SweptField} field
   */
  #fault(field) {
    const { pointer, values } = field;
    if (pointer === "") return this.#fields.length > 1 ? "choose a field, or remove this one" : "";
    if (this.#fields.some((other) => other !== field && other.pointer === pointer)) return "this field is chosen twice";
    const longest = Math.max(...this.#fields.map((one) => one.values.length));
    if (this.#combined.value === "list" && values.length && values.length < longest) return `${values.length} values; another field has ${longest}`;
    return "";
  }

  /** @param {string} together processor time of all jobs; empty while it is not known */
  expect(together) {
    this.#together = together;
    this.#say();
  }

  show() {
    this.#combined_label.hidden = this.#fields.length < 2;
    for (const field of this.#fields) {
      field.show();
      field.mark(this.#fault(field));
    }
    this.#say();
  }

  /** Says how many jobs it makes; faults that the service has found stay at their fields. */
  #say() {
    const { jobs } = this;
    this.#said.textContent = jobs === 0 ? "Choose a field and its values."
      : jobs > this.#most_jobs ? `${count(jobs)} jobs; a sweep has at most ${count(this.#most_jobs)}.`
        : `${jobs === 1 ? "1 job" : `${count(jobs)} jobs`}${this.#together && `, ${this.#together} of processor time together`}.`;
  }

  /**
   * Shows faults of the service at their fields; returns those that are none of theirs.
   * @param {{pointer: string, detail: string}[]} faults
   */
  mark(faults) {
    const token = /^\/(?:grid|list\/\d+)\/([^/]+)/;
    const target = (/** @type {string} */ pointer) => token.exec(pointer)?.[1].replaceAll("~1", "/").replaceAll("~0", "~");
    for (const field of this.#fields) {
      const own = faults.filter(({ pointer }) => target(pointer) === field.pointer);
      if (own.length) field.mark([...new Set(own.map(({ detail }) => detail))].join("; "));
    }
    return faults.filter(({ pointer }) => !this.#fields.some((field) => field.pointer === target(pointer)));
  }
}
