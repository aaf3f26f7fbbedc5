// The resolved specification with the provenance of every value.

import { card, element, table } from "../parts/element.js";

/**
 * @param {any} job
 * @returns {HTMLElement}
 */
export function specification_card({ spec }) {
  const { provenance = {}, ...given } = spec;
  const rows = values(given, "").map(([pointer, value]) => [element("code", {}, pointer), String(value), provenance[pointer] ?? ""]);
  return card("Specification",
    table({ head: ["field", "value", "provenance"], rows }),
    element("details", {}, element("summary", {}, "as JSON"), element("pre", {}, JSON.stringify(given, null, 2))));
}

/**
 * All values with their JSON pointers.
 * @param {any} value
 * @param {string} pointer
 * @returns {[string, unknown][]}
 */
function values(value, pointer) {
  if (value === null || typeof value !== "object") return [[pointer, value]];
  if (Array.isArray(value) && value.every((item) => typeof item !== "object")) return [[pointer, value.join(", ")]];
  const step = (/** @type {string} */ key) => key.replaceAll("~", "~0").replaceAll("/", "~1");
  return Object.entries(value).flatMap(([key, item]) => values(item, `${pointer}/${step(key)}`));
}
