// The resolved specification with the provenance of every value.

import { download_link } from "../parts/download.js";
import { card, element, table } from "../parts/element.js";
import { has_no_parts, leaves } from "../parts/leaves.js";

/**
 * @param {any} job
 * @returns {HTMLElement}
 */
export function specification_card({ id, spec, links }) {
  const { provenance = {}, ...given } = spec;
  const rows = leaves(given, "", is_shown_whole).map(([pointer, value]) => [element("code", {}, pointer), Array.isArray(value) ? value.join(", ") : String(value), provenance[pointer] ?? ""]);
  return card("Specification",
    element("p", { class: "muted" }, "With every default filled in. ", download_link(links.spec, `fretwear-${id}-spec.json`, "As it was sent (JSON)")),
    table({ head: ["field", "value", "provenance"], rows }),
    element("details", {}, element("summary", {}, "as JSON"), element("pre", { tabindex: "0", "aria-label": "specification as JSON" }, JSON.stringify(given, null, 2))));
}

/** @param {any} value */
function is_shown_whole(value) {
  return has_no_parts(value) || (Array.isArray(value) && value.every(has_no_parts));
}
