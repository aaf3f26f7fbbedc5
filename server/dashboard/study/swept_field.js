// One field of a sweep: which it is and which values it takes.

import { element } from "../parts/element.js";
import { as_text, quantity } from "../parts/quantity.js";
import { listed, spread } from "./values.js";

/** The entry for a field that is not listed. */
const OTHER = "other";
/** Values that are shown of a row at most. */
const MOST_SHOWN = 12;

/** @typedef {{pointer: string, value: unknown}} Offered */

let made = 0;

/** A field with its values. */
export class SweptField {
  #id = `swept-${++made}`;
  #changed;
  /** What may stand in a specification. @type {import("./schema.js").Shape | null} */
  #shape = null;
  /** @type {Offered[]} */
  #offered = [];
  #pointer = this.#select("field", []);
  #other = this.#input("pointer", "JSON pointer", "/stop/0/worn_depth_mm");
  #how = this.#select("how", [["list", "list"], ["linear", "from, to, linear"], ["log", "from, to, logarithmic"]]);
  #list = this.#input("values", "values", "1, 2, 5");
  #from = this.#input("from", "from", "from");
  #to = this.#input("to", "to", "to");
  #count = this.#input("count", "number of values", "number");
  #unit = element("span", { class: "muted unit" });
  #shown = element("output", { class: "muted small" });
  #fault = element("span", { class: "fault", id: `${this.#id}-fault`, role: "alert" });

  /**
   * @param {() => void} changed
   * @param {() => void} removed
   */
  constructor(changed, removed) {
    this.#changed = changed;
    this.#count.value = "5";
    this.#pointer.addEventListener("change", () => this.#propose());
    this.node = element("div", { class: "swept", role: "group", "aria-label": "swept field" },
      this.#pointer, this.#other, this.#how, this.#list, this.#from, this.#to, this.#count, this.#unit,
      element("button", { type: "button", class: "quiet", click: removed }, "remove"), this.#shown, this.#fault);
    this.show();
  }

  /**
   * @param {string} name
   * @param {[string, string][]} options
   */
  #select(name, options) {
    const node = /** @type {HTMLSelectElement} */ (element("select", { id: `${this.#id}-${name}`, "aria-label": name === "how" ? "how the values are given" : name }, ...options.map(([value, text]) => element("option", { value }, text))));
    node.addEventListener("change", () => this.#changed());
    return node;
  }

  /**
   * @param {string} name
   * @param {string} label
   * @param {string} placeholder
   */
  #input(name, label, placeholder) {
    const node = /** @type {HTMLInputElement} */ (element("input", { id: `${this.#id}-${name}`, type: "text", "aria-label": label, placeholder, class: name, "aria-describedby": `${this.#id}-fault` }));
    node.addEventListener("input", () => this.#changed());
    return node;
  }

  /** The pointer of the field; empty while none is chosen. */
  get pointer() {
    return this.#pointer.value === OTHER ? this.#other.value.trim() : this.#pointer.value;
  }

  /** @returns {unknown[]} */
  get values() {
    if (this.#how.value === "list") return listed(this.#list.value);
    const number = (/** @type {HTMLInputElement} */ { value }) => (value.trim() === "" ? NaN : Number(value));
    return spread({ from: number(this.#from), to: number(this.#to), count: number(this.#count), is_log: this.#how.value === "log", is_count: this.#is_count });
  }

  /** What may stand at its pointer. */
  get #shapes() {
    return this.#shape?.at(this.pointer) ?? [];
  }

  /** Whether the field is a whole number. */
  get #is_count() {
    return this.#shapes.length > 0 && this.#shapes.every((shape) => shape.is("integer"));
  }

  /** The words that the field can be. @returns {string[]} */
  get #choices() {
    return [...new Set(this.#shapes.flatMap(({ choices, only }) => choices ?? [only]))].filter((choice) => typeof choice === "string");
  }

  /**
   * Offers the fields of a specification.
   * @param {Offered[]} offered
   * @param {import("./schema.js").Shape | null} shape
   */
  offer(offered, shape) {
    const before = this.pointer;
    this.#shape = shape;
    this.#offered = offered;
    const groups = Map.groupBy(offered, ({ pointer }) => pointer.split("/")[1]);
    this.#pointer.replaceChildren(element("option", { value: "" }, "choose a field"),
      ...[...groups].map(([name, fields]) => element("optgroup", { label: name }, ...fields.map(({ pointer }) => element("option", { value: pointer }, quantity(pointer).name)))),
      element("option", { value: OTHER }, "another field …"));
    this.#place(before);
    this.show();
  }

  /**
   * Takes a field with its values.
   * @param {string} pointer
   * @param {unknown[]} values
   */
  take(pointer, values) {
    this.#place(pointer);
    this.#how.value = "list";
    this.#list.value = values.map((value) => (typeof value === "string" ? value : JSON.stringify(value))).join(", ");
  }

  /** What is typed. */
  get state() {
    const [list, from, to, count] = [this.#list, this.#from, this.#to, this.#count].map(({ value }) => value);
    return { pointer: this.pointer, how: this.#how.value, list, from, to, count };
  }

  /** @param {any} typed */
  restore({ pointer, how, list, from, to, count }) {
    this.#place(pointer);
    this.#how.value = how;
    for (const [input, value] of /** @type {[HTMLInputElement, string][]} */ ([[this.#list, list], [this.#from, from], [this.#to, to], [this.#count, count]])) input.value = value;
  }

  /** @param {string} pointer */
  #place(pointer) {
    const is_listed = pointer === "" || this.#offered.some((one) => one.pointer === pointer);
    this.#pointer.value = is_listed ? pointer : OTHER;
    if (!is_listed) this.#other.value = pointer;
  }

  /** Proposes values for a field that was just chosen: all of a choice, the present one of a number. */
  #propose() {
    const present = this.#offered.find(({ pointer }) => pointer === this.pointer)?.value;
    const choices = typeof present === "boolean" ? ["true", "false"] : this.#choices;
    if (typeof present !== "number") this.#how.value = "list";
    this.#list.value = typeof present === "number" ? String(present) : choices.join(", ");
    this.#from.value = typeof present === "number" ? String(present) : "";
    this.#to.value = "";
    this.#changed();
  }

  /** Shows the inputs that its choices need, and the values. */
  show() {
    const is_list = this.#how.value === "list";
    this.#other.hidden = this.#pointer.value !== OTHER;
    this.#list.hidden = !is_list;
    for (const input of [this.#from, this.#to, this.#count]) input.hidden = is_list;
    this.#unit.textContent = quantity(this.pointer).unit;
    const values = this.values;
    const left_out = values.length - MOST_SHOWN;
    this.#shown.textContent = is_list || values.length === 0 ? "" : `${values.slice(0, MOST_SHOWN).map(as_text).join(", ")}${left_out > 0 ? ` and ${left_out} more` : ""}`;
  }

  /** @param {string} text what is wrong with it; empty where nothing is */
  mark(text) {
    this.#fault.textContent = text;
    for (const input of [this.#list, this.#from, this.#to, this.#count, this.#other, this.#pointer]) input.toggleAttribute("aria-invalid", text !== "");
  }
}
