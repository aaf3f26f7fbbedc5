// A change of the system: what was typed for each one, and what a new one takes over.

import { words } from "../parts/format.js";

/** Parts of a specification that belong to one system. */
const OWN = ["system", "model", "provenance"];

/**
 * A specification of another system with what was given besides the dimensions of the former one.
 * @param {any} spec
 * @param {string} kind
 * @returns {any}
 */
export function with_system(spec, kind) {
  return { ...Object.fromEntries(taken_over(spec)), system: { kind } };
}

/**
 * Parts that another system takes over.
 * @param {any} spec
 * @returns {[string, any][]}
 */
function taken_over(spec) {
  return Object.entries(spec ?? {}).filter(([name]) => !OWN.includes(name));
}

/**
 * The same in words; empty where that is nothing.
 * @param {any} spec
 * @returns {string}
 */
export function taken_over_in_words(spec) {
  const names = taken_over(spec).map(([name]) => words(name));
  return names.length ? `Taken over from ${words(spec.system?.kind ?? "the former system")}: ${names.join(", ")}.` : "";
}
