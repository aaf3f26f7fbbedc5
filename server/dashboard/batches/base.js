// The specification that the jobs of a batch are variations of.

import { fetch_json } from "../parts/client.js";
import { card, element, table } from "../parts/element.js";
import { has_no_parts, leaves } from "../parts/leaves.js";
import { as_text, heading } from "../parts/quantity.js";

/**
 * The resolved specification of the first job that a batch still has.
 * @param {{jobs: {id: string}[]}} batch
 * @param {AbortSignal} signal
 * @returns {Promise<any>} null if it has none
 */
export async function base_of({ jobs }, signal) {
  if (jobs.length === 0) return null;
  const { spec } = await fetch_json(`/v1/jobs/${jobs[0].id}`, { signal });
  return spec;
}

/**
 * The fields of a specification that do not vary.
 * @param {any} spec
 * @param {string[]} varied pointers of those that do
 * @returns {HTMLElement}
 */
export function base_card(spec, varied) {
  const { provenance = {}, ...given } = spec;
  const is_varied = (/** @type {string} */ pointer) => varied.some((one) => pointer === one || pointer.startsWith(`${one}/`));
  const is_whole = (/** @type {any} */ value) => has_no_parts(value) || (Array.isArray(value) && value.every(has_no_parts));
  const rows = leaves(given, "", is_whole).filter(([pointer, value]) => !is_varied(pointer) && value !== null)
    .map(([pointer, value]) => [heading(pointer), Array.isArray(value) ? value.map(as_text).join("; ") : as_text(value), provenance[pointer] ?? ""]);
  return card("Base specification",
    element("p", { class: "muted" }, "What all jobs share."),
    element("details", {}, element("summary", {}, `${rows.length} fields`), table({ head: ["field", "value", "provenance"], rows })),
    element("details", {}, element("summary", {}, "as JSON, resolved, of the first job"), element("pre", { tabindex: "0" }, JSON.stringify(given, null, 2))));
}
