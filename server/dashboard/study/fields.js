// The sections of a specification, each with its values as fields; sections and values are added and removed.

import { element } from "../parts/element.js";
import { words } from "../parts/format.js";
import { leaves } from "../parts/leaves.js";
import { control, select } from "./control.js";
import { set_value, value_at, with_defaults } from "./edit.js";
import { Focus } from "./focus.js";
import { material_choice, platings } from "./materials.js";
import { Row } from "./row.js";

/**
 * @typedef {import("./schema.js").Shape} Shape
 * @typedef {{pointer: string, detail: string}} Fault
 * @typedef {object} Content
 * @property {any} spec as it is written
 * @property {any} resolved with all defaults, of the last plan or of the preset
 * @property {Shape} shape
 * @property {Fault[]} faults
 * @property {any[]} systems with their presets
 */

/** Sections in the order of their importance; other ones follow. */
const ORDER = ["system", "load", "motion", "mission", "materials", "plating", "interface", "environment", "model", "accuracy", "output", "stop", "life", "effects"];
/** Those that are open at first. */
const OPEN = ["study", "system", "load", "motion"];
/** Where a value that is null says something: the wear of a part that does not wear. */
const NONE = /** @type {[RegExp, string][]} */ ([[/^\/interface\/wear\/\w+$/, "does not wear"]]);

/** Lists that are shown where they are empty as well. */
const PLATED = /^\/plating\/(slider|receptacle)$/;

/** The fields. */
export class Fields {
  #changed;
  #open = new Set(OPEN);
  /** Fields without a value that the reader has asked for, by their pointers. */
  #asked = new Set();
  /** Rows and groups that faults are shown at. @type {Map<string, Row | HTMLElement>} */
  #places = new Map();
  /** @type {Content | null} */
  #content = null;
  /** @type {any} */
  #shown = null;

  /** @param {(edit: (spec: any) => any) => void} changed with what a changed field makes of a specification */
  constructor(changed) {
    this.#changed = changed;
    this.node = element("div", { class: "fields" });
  }

  /** @param {Content} content */
  show(content) {
    const { spec, resolved, shape } = content;
    const faults = content.faults.map(at_its_field);
    this.#content = { ...content, faults };
    this.#shown = with_defaults(spec, resolved, shape);
    this.#places.clear();
    const fields = Object.entries(shape.fields ?? {}).filter(([name]) => name !== "provenance");
    const sections = fields.filter(([, field]) => field.fields || field.is_list_of_objects).sort(([one], [other]) => rank(one) - rank(other));
    const single = fields.filter((entry) => !sections.includes(entry));
    const present = sections.filter(([name]) => this.#shown[name] !== undefined || faults.some(({ pointer }) => `${pointer}/`.startsWith(`/${name}/`)));
    const absent = sections.filter((entry) => !present.includes(entry));
    const focus = new Focus(this.node);
    this.node.replaceChildren(
      this.#section("study", this.#rows("", this.#shown, Object.fromEntries(single))),
      ...present.map(([name, field]) => this.#section(name, [...this.#value(`/${name}`, this.#shown[name], field, true), this.#reset(name)])),
      element("p", { class: "line" }, "Add ", ...absent.map(([name, field]) => this.#button(words(name), `add ${words(name)}`, () => {
        this.#open.add(name);
        this.#set(`/${name}`, field.initial);
      }))));
    this.#mark(faults);
    focus.restore();
  }

  /**
   * Focuses the field of a fault.
   * @param {string} pointer
   */
  focus(pointer) {
    const place = this.#places.get(this.#nearest(pointer));
    if (!place) return;
    const node = place instanceof Row ? place.node : place;
    for (const group of [...this.node.querySelectorAll("details")].filter((group) => group.contains(node))) group.open = true;
    /** @type {HTMLElement | null} */ (node.querySelector("input, select") ?? node.querySelector("summary"))?.focus();
  }

  /**
   * @param {string} pointer
   * @param {unknown} value undefined removes it
   */
  #set(pointer, value) {
    if (!this.#content) return;
    const { shape } = this.#content;
    this.#changed((spec) => set_value(spec, this.#shown, shape, pointer, value));
  }

  /**
   * @param {string} name
   * @param {(HTMLElement | null)[]} children
   */
  #section(name, children) {
    const value = name === "study" ? null : this.#shown[name];
    const said = leaves(value ?? "").map(([, leaf]) => leaf).filter((leaf) => typeof leaf === "string" && leaf !== "").slice(0, 3).map(words).join(", ");
    const group = /** @type {HTMLDetailsElement} */ (element("details", { class: "group", "data-group": name, open: this.#open.has(name) },
      element("summary", {}, element("strong", {}, words(name)), " ", element("span", { class: "muted small" }, said), element("span", { class: "fault" })),
      ...children));
    group.addEventListener("toggle", () => (group.open ? this.#open.add(name) : this.#open.delete(name)));
    this.#places.set(`/${name}`, group);
    return group;
  }

  /**
   * The button that takes a section back to what the system has of it, if anything.
   * @param {string} name
   */
  #reset(name) {
    if (name === "system" || this.#content?.spec[name] === undefined) return null;
    const has_preset = this.#content.systems.some(({ kind, preset }) => kind === this.#shown.system?.kind && preset[name] !== undefined);
    const text = has_preset ? "back to the preset" : "remove";
    return element("p", {}, this.#button(text, `${text}: ${words(name)}`, () => this.#set(`/${name}`, undefined)));
  }

  /**
   * The fields of a value: of an object, of a list of objects, or a single one.
   * @param {string} pointer
   * @param {any} value
   * @param {Shape} shape
   * @param {boolean} [is_section]
   * @returns {HTMLElement[]}
   */
  #value(pointer, value, shape, is_section = false) {
    const name = words(pointer.split("/").pop() ?? "");
    if (shape.forms.some((form) => form.fields)) return [this.#material(pointer, name, value, shape)];
    if (shape.fields) return is_section ? this.#object(pointer, value, shape) : [this.#group(pointer, name, this.#object(pointer, value, shape), this.#is_given(pointer) ? () => this.#set(pointer, undefined) : null)];
    if (!shape.is_list_of_objects) return [this.#row(pointer, value, shape)];
    const items = (value ?? []).map((/** @type {any} */ item, /** @type {number} */ index) => this.#group(`${pointer}/${index}`, `${PLATED.test(pointer) ? "layer" : name} ${index + 1}`,
      this.#object(`${pointer}/${index}`, item, /** @type {Shape} */ (shape.items)), () => this.#set(`${pointer}/${index}`, undefined)));
    const add = this.#button(PLATED.test(pointer) ? "add a layer" : `add to ${name}`, `add to ${pointer}`, () => this.#set(`${pointer}/${value?.length ?? 0}`, shape.items?.initial));
    const foot = element("p", { class: "line" }, add, this.#plating_choice(pointer));
    return is_section ? [...items, foot] : [this.#group(pointer, name, [...items, foot], null)];
  }

  /**
   * @param {string} pointer
   * @param {any} value
   * @param {Shape} shape
   * @returns {HTMLElement[]}
   */
  #object(pointer, value, shape) {
    const none = NONE.find(([place]) => place.test(pointer))?.[1];
    const { tag, fields } = shape;
    if (!fields) return [];
    if (!tag) return this.#rows(pointer, value, fields, shape);
    const place = `${pointer}/${tag}`;
    const choices = /** @type {[string, string][]} */ ((fields[tag].choices ?? []).map((choice) => [choice, words(choice)]));
    const chosen = value === null && none ? "none" : value?.[tag];
    const choose = (/** @type {string | undefined} */ kind) => {
      if (kind === "none" && none) return this.#set(pointer, null);
      const rest = Object.entries(value ?? {}).filter(([name]) => name !== tag && shape.applies(name, kind));
      this.#set(pointer, { ...(kind && { [tag]: kind }), ...Object.fromEntries(rest) });
    };
    const choice = select(field_id(place), chosen, none ? [...choices, ["none", none]] : choices, choose);
    const row = this.#place_row(place, tag, choice, fields[tag]);
    if (value === null || value === undefined) return [row];
    const { [tag]: _, ...others } = fields;
    return [row, ...this.#rows(pointer, value, others, shape)];
  }

  /**
   * The fields that are present, missing or asked for, and a choice of those to add.
   * @param {string} pointer
   * @param {any} value
   * @param {Record<string, Shape>} fields
   * @param {Shape} [shape]
   * @returns {HTMLElement[]}
   */
  #rows(pointer, value, fields, shape) {
    const faults = this.#content?.faults ?? [];
    const names = [...new Set([...Object.keys(value ?? {}), ...Object.keys(fields)])].filter((name) => fields[name] && !fields[name].is_fixed);
    const kind = shape?.tag ? value?.[shape.tag] : undefined;
    const applies = (/** @type {string} */ name) => !shape || shape.applies(name, kind);
    const is_shown = (/** @type {string} */ name) => {
      const place = `${pointer}/${name}`;
      const is_null = value?.[name] === null && !NONE.some(([of]) => of.test(place));
      return (value?.[name] !== undefined && !is_null) || this.#asked.has(place) || PLATED.test(place) || (shape?.requires(name) && applies(name)) || faults.some((fault) => `${fault.pointer}/`.startsWith(`${place}/`));
    };
    const shown = names.filter(is_shown);
    const more = names.filter((name) => !shown.includes(name) && applies(name));
    const rows = shown.flatMap((name) => this.#value(`${pointer}/${name}`, value?.[name], fields[name]));
    if (more.length === 0) return rows;
    const add = /** @type {HTMLSelectElement} */ (element("select", { "aria-label": `add a field${pointer && ` of ${pointer}`}` }, element("option", { value: "" }, "add a field …"), ...more.map((name) => element("option", { value: name, title: fields[name].description }, words(name)))));
    add.addEventListener("change", () => this.#add(`${pointer}/${add.value}`, fields[add.value]));
    return [...rows, element("p", { class: "field" }, add)];
  }

  /**
   * @param {string} pointer
   * @param {Shape} shape
   */
  #add(pointer, shape) {
    if (shape.choices || shape.fields || shape.forms.some((form) => form.choices) || shape.is_list_of_objects) {
      const choices = shape.choices ?? shape.forms.flatMap((form) => form.choices ?? []);
      return this.#set(pointer, choices.length ? choices[0] : shape.initial);
    }
    this.#asked.add(pointer);
    if (this.#content) this.show(this.#content);
    this.focus(pointer);
  }

  /**
   * @param {string} pointer
   * @param {any} value
   * @param {Shape} shape
   */
  #row(pointer, value, shape) {
    const changed = (/** @type {unknown} */ next) => this.#set(pointer, next);
    return this.#place_row(pointer, pointer.split("/").pop() ?? "", control(field_id(pointer), value, shape, changed), shape);
  }

  /**
   * @param {string} pointer
   * @param {string} name
   * @param {HTMLElement} input
   * @param {Shape} shape
   */
  #place_row(pointer, name, input, shape) {
    const parent = pointer.slice(0, pointer.lastIndexOf("/"));
    const can_reset = this.#is_given(pointer) && !(this.#is_given(parent) && input.tagName === "SELECT" && parent !== "");
    const row = new Row({ name, input, shape, from: this.#shown.provenance?.[pointer] ?? "", reset: can_reset ? () => {
      this.#asked.delete(pointer);
      this.#set(pointer, undefined);
    } : null });
    this.#places.set(pointer, row);
    return row.node;
  }

  /**
   * @param {string} pointer
   * @param {string} name
   * @param {any} value
   * @param {Shape} shape
   */
  #material(pointer, name, value, shape) {
    const choice = material_choice(field_id(pointer), value, shape, (next) => this.#set(pointer, next));
    const row = this.#place_row(pointer, pointer.split("/").pop() ?? "", choice, shape);
    const object = shape.forms.find((form) => form.fields);
    if (!object || value === null || typeof value !== "object") return row;
    const { name: _, ...fields } = object.fields ?? {};
    const key = `${pointer} properties`;
    const details = /** @type {HTMLDetailsElement} */ (element("details", { open: this.#open.has(key) }, element("summary", {}, `properties of ${name}`), ...this.#rows(pointer, value, fields, object)));
    details.addEventListener("toggle", () => (details.open ? this.#open.add(key) : this.#open.delete(key)));
    return element("div", {}, row, details);
  }

  /** @param {string} pointer of a plated side */
  #plating_choice(pointer) {
    const side = PLATED.exec(pointer)?.[1];
    if (!side || !this.#content) return null;
    const presets = platings(this.#content.systems, /** @type {"slider" | "receptacle"} */ (side));
    const choice = /** @type {HTMLSelectElement} */ (element("select", { "aria-label": `plating of the ${side}` }, element("option", { value: "" }, "take a plating …"), ...[...presets.keys()].map((name) => element("option", {}, name))));
    choice.addEventListener("change", () => this.#set(pointer, presets.get(choice.value)));
    return choice;
  }

  /**
   * @param {string} pointer
   * @param {string} name
   * @param {(HTMLElement | null)[]} children
   * @param {(() => void) | null} remove
   */
  #group(pointer, name, children, remove) {
    const group = element("fieldset", {}, element("legend", {}, name, remove && this.#button("remove", `remove ${pointer}`, remove)), element("span", { class: "fault" }), ...children);
    this.#places.set(pointer, group);
    return group;
  }

  /**
   * @param {string} text
   * @param {string} label
   * @param {() => void} click
   */
  #button(text, label, click) {
    return element("button", { type: "button", class: "quiet", "aria-label": label, click }, text);
  }

  /** @param {string} pointer */
  #is_given(pointer) {
    return value_at(this.#content?.spec, pointer) !== undefined;
  }

  /** @param {string} pointer */
  #nearest(pointer) {
    let place = pointer;
    while (place && !this.#places.has(place)) place = place.slice(0, place.lastIndexOf("/"));
    return place;
  }

  /**
   * Shows every fault at its field, or at the group that it is of, and opens what that is in.
   * @param {Fault[]} faults
   */
  #mark(faults) {
    /** @type {Map<string, string[]>} */
    const said = new Map();
    for (const { pointer, detail } of faults) {
      const place = this.#nearest(pointer);
      said.set(place, [...(said.get(place) ?? []), place === pointer ? detail : `${pointer}: ${detail}`]);
    }
    for (const [pointer, details] of said) {
      const place = this.#places.get(pointer);
      if (!place) continue;
      const node = place instanceof Row ? place.node : place;
      if (place instanceof Row) place.refuse(details.join("; "));
      else /** @type {HTMLElement} */ (node.querySelector(".fault")).textContent = details.join("; ");
      for (const group of [...this.node.querySelectorAll("details")].filter((group) => group.contains(node))) group.open = true;
    }
  }
}

/**
 * A fault of an object that lacks a field, at that field.
 * @param {Fault} fault
 * @returns {Fault}
 */
function at_its_field({ pointer, detail }) {
  const field = /^missing field `(\w+)`/.exec(detail)?.[1];
  return { pointer: field ? `${pointer}/${field}` : pointer, detail };
}

/** @param {string} pointer */
function field_id(pointer) {
  return `field${pointer.replaceAll("/", "-")}`;
}

/** @param {string} name of a section */
function rank(name) {
  return (ORDER.indexOf(name) + ORDER.length + 1) % (ORDER.length + 1);
}
