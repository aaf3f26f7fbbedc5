// The filters of the list, which are values of the address.

import { address, change } from "../parts/address.js";
import { fetch_json } from "../parts/client.js";
import { element } from "../parts/element.js";
import { words } from "../parts/format.js";
import { STATUSES } from "../parts/status.js";
import { LabelFilter } from "./labels.js";

/** Pause after a key before a text is searched for, ms. */
const TYPING_MS = 250;

/**
 * The query of the list for values of the address.
 * @param {URLSearchParams} values
 * @param {number} limit
 * @returns {URLSearchParams}
 */
export function query_of(values, limit) {
  const query = new URLSearchParams({ limit: String(limit), total: "true" });
  for (const name of ["status", "system", "text", "sort", "sweep"]) {
    const value = values.get(name);
    if (value) query.set(name, value);
  }
  for (const label of values.getAll("label")) query.append("label", label);
  const page = values.get("page");
  if (page) query.set("page_token", page);
  return query;
}

/**
 * @param {AbortSignal} signal
 * @returns {HTMLElement}
 */
export function filter_bar(signal) {
  const boxes = STATUSES.map((status) => {
    const box = element("input", { type: "checkbox", value: status, change: apply });
    return element("label", { class: "chip" }, box, ` ${status}`);
  });
  const system = element("select", { "aria-label": "system", change: apply }, element("option", { value: "" }, "all systems"));
  const labels = new LabelFilter(signal);
  const text = element("input", { type: "search", placeholder: "name, label or id", "aria-label": "search" });
  /** @type {ReturnType<typeof setTimeout> | undefined} */
  let typing;
  text.addEventListener("input", () => {
    clearTimeout(typing);
    typing = setTimeout(apply, TYPING_MS);
  });
  const bar = element("form", { class: "filters", role: "search", submit: (/** @type {Event} */ event) => event.preventDefault() },
    text, system, labels.node, element("fieldset", {}, element("legend", { class: "hidden" }, "status"), ...boxes));

  function apply() {
    const chosen = [...bar.querySelectorAll("input:checked")].map((box) => /** @type {HTMLInputElement} */ (box).value);
    change({
      status: chosen.join(",") || null,
      system: /** @type {HTMLSelectElement} */ (system).value,
      text: /** @type {HTMLInputElement} */ (text).value.trim(),
      page: null,
    });
  }
  function follow_address() {
    const { page, values } = address();
    if (page !== "jobs") return;
    labels.update();
    const chosen = (values.get("status") ?? "").split(",");
    for (const box of bar.querySelectorAll("input[type=checkbox]"))
      /** @type {HTMLInputElement} */ (box).checked = chosen.includes(/** @type {HTMLInputElement} */ (box).value);
    /** @type {HTMLSelectElement} */ (system).value = values.get("system") ?? "";
    if (document.activeElement !== text) /** @type {HTMLInputElement} */ (text).value = values.get("text") ?? "";
  }
  follow_address();
  addEventListener("hashchange", follow_address, { signal });
  fetch_json("/v1/systems", { signal }).then(({ systems }) => {
    system.append(...systems.map((/** @type {{kind: string}} */ { kind }) => element("option", { value: kind }, words(kind))));
    follow_address();
  });
  return bar;
}
