// The control of one value of a specification: a choice, a box, or a text.

import { element } from "../parts/element.js";
import { words } from "../parts/format.js";

/**
 * @param {string} id
 * @param {any} value
 * @param {import("./schema.js").Shape} shape
 * @param {(value: unknown) => void} changed undefined where the value is left to its default
 * @returns {HTMLElement}
 */
export function control(id, value, shape, changed) {
  if (shape.choices) return select(id, value, shape.choices.map((choice) => [choice, words(choice)]), changed);
  if (shape.is("boolean")) return select(id, value === undefined ? undefined : String(value), [["true", "yes"], ["false", "no"]], (chosen) => changed(chosen === undefined ? undefined : chosen === "true"));
  const is_number = shape.is("number") || shape.is("integer");
  const input = /** @type {HTMLInputElement} */ (element("input", { id, type: "text", autocomplete: "off", value: as_text(value), inputmode: is_number ? "decimal" : null, class: !is_number && "wide" }));
  input.addEventListener("change", () => changed(as_value(input.value.trim(), shape)));
  return input;
}

/**
 * A choice of values by their names; one without a value has an empty choice as well.
 * @param {string} id
 * @param {string | undefined} value
 * @param {[string, string][]} choices
 * @param {(value: string | undefined) => void} changed
 */
export function select(id, value, choices, changed) {
  const all = value === undefined || !choices.some(([choice]) => choice === value) ? [["", value ?? ""], ...choices] : choices;
  const node = /** @type {HTMLSelectElement} */ (element("select", { id }, ...all.map(([choice, text]) => element("option", { value: choice, selected: choice === value }, text))));
  node.addEventListener("change", () => changed(node.value || undefined));
  return node;
}

/** @param {any} value */
function as_text(value) {
  if (value === undefined || value === null) return "";
  if (Array.isArray(value)) return value.join(", ");
  return typeof value === "object" ? Object.entries(value).map(([key, item]) => `${key}: ${item}`).join(", ") : String(value);
}

/**
 * What was typed, as the kind of value that the schema names; text that is not of this kind is left to the service to refuse.
 * @param {string} typed
 * @param {import("./schema.js").Shape} shape
 * @returns {unknown}
 */
function as_value(typed, shape) {
  if (shape.items) return typed === "" ? [] : typed.split(/[;\s]+|,\s*/).filter((part) => part !== "").map((part) => as_number(part));
  if (typed === "") return undefined;
  if (shape.is("object")) return Object.fromEntries(typed.split(/[,;]\s*/).filter((pair) => pair !== "").map((pair) => pair.split(/:\s*(.*)/s).slice(0, 2)));
  return shape.is("number") || shape.is("integer") ? as_number(typed.replace(",", ".")) : typed;
}

/** @param {string} typed */
function as_number(typed) {
  const number = Number(typed);
  return Number.isNaN(number) ? typed : number;
}
