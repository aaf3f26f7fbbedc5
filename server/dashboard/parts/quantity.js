// What fields of a specification are: their names in words and the units that their names end with.

import { number, words } from "./format.js";
import { name_and_unit } from "./units.js";

/**
 * The name in words and the unit of a field.
 * @param {string} pointer
 * @returns {{name: string, unit: string}}
 */
export function quantity(pointer) {
  const keys = pointer.split("/").slice(1);
  const last = keys.pop() ?? "";
  const [name, unit] = name_and_unit(last);
  return { name: [...keys.map(words), name].join(" / "), unit };
}

/**
 * The name of a field with its unit, as a heading.
 * @param {string} pointer
 * @returns {string}
 */
export function heading(pointer) {
  const { name, unit } = quantity(pointer);
  return unit ? `${name}, ${unit}` : name;
}

/**
 * A value of a field in words.
 * @param {unknown} value
 * @returns {string}
 */
export function as_text(value) {
  if (typeof value === "number") return number(value);
  if (typeof value === "string") return words(value);
  return value === undefined ? "–" : JSON.stringify(value);
}
