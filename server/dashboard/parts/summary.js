// The quantities of a summary, as the service lists them.

import { fetch_json } from "./client.js";
import { count, length, number } from "./format.js";

/**
 * @typedef {object} Listed
 * @property {string} column in the table of a sweep
 * @property {string} [pointer] to it in a summary; absent where it follows from several fields
 * @property {string} title
 * @property {string} [side]
 * @property {string} unit in which it is shown; empty of a count
 * @property {number} factor from the unit of its values
 */

/**
 * @param {AbortSignal} signal
 * @returns {Promise<Listed[]>}
 */
export async function listed_quantities(signal) {
  return (await fetch_json("/v1/quantities", { signal })).quantities;
}

/**
 * The value of a quantity in a summary.
 * @param {any} summary
 * @param {Listed} quantity
 * @returns {number | null | undefined}
 */
export function value_in(summary, { pointer = "" }) {
  return pointer.split("/").slice(1).reduce((part, key) => part?.[key], summary);
}

/**
 * A value with its unit; empty if there is none.
 * @param {number | null | undefined} value
 * @param {Listed} quantity
 * @returns {string}
 */
export function with_unit(value, { unit, factor }) {
  if (value == null) return "";
  if (unit === "") return count(value);
  return unit === "µm" ? length(value) : `${number(value, factor)} ${unit}`;
}
