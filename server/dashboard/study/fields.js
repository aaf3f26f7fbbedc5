// The values of a specification as fields to edit, with their units and where each is from.

import { element } from "../parts/element.js";
import { words } from "../parts/format.js";
import { leaves } from "../parts/leaves.js";

/** Ends of names that are units, and the units as they are written. */
const UNITS = /** @type {[string, string][]} */ ([
  ["_n_per_mm", "N/mm"], ["_per_mpa", "1/MPa"], ["_kg_m3", "kg/m³"], ["_w_mk", "W/(m K)"], ["_j_kgk", "J/(kg K)"], ["_ohm_m", "Ω m"], ["_per_k", "1/K"],
  ["_mrad", "mrad"], ["_mohm", "mΩ"], ["_mpa", "MPa"], ["_um", "µm"], ["_mm", "mm"], ["_hz", "Hz"], ["_deg", "°"], ["_c", "°C"], ["_n", "N"], ["_s", "s"], ["_h", "h"], ["_a", "A"], ["_g", "g"],
]);
/** Names that are a unit alone: what they are, and the unit. @type {Record<string, [string, string]>} */
const BY_UNIT = { n: ["force", "N"], mpa: ["pressure", "MPa"], n_per_mm: ["line force", "N/mm"], mm: ["depth", "mm"], mohm: ["resistance", "mΩ"] };
/** Parts of a specification that are not edited here. */
const LEFT_OUT = ["provenance", "output", "labels"];

/**
 * A specification with another value at a pointer; what it does not contain on the way is taken from the resolved one.
 * @param {any} spec
 * @param {any} resolved
 * @param {string} pointer
 * @param {unknown} value
 * @returns {any}
 */
export function set_value(spec, resolved, pointer, value) {
  const keys = pointer.split("/").slice(1);
  const changed = structuredClone(spec);
  let [at, known] = [changed, resolved];
  for (const key of keys.slice(0, -1)) {
    known = known?.[key];
    if (at[key] === undefined || typeof at[key] !== "object" || at[key] === null) at[key] = structuredClone(known ?? {});
    at = at[key];
  }
  at[keys[keys.length - 1]] = value;
  return changed;
}

/** The fields. */
export class Fields {
  #changed;
  /** @type {Map<string, HTMLElement>} */
  #rows = new Map();

  /** @param {(pointer: string, value: unknown) => void} changed */
  constructor(changed) {
    this.#changed = changed;
    this.node = element("div", { class: "fields" });
  }

  /**
   * Shows the fields of a resolved specification.
   * @param {any} spec
   * @param {{pointer: string, detail: string}[]} faults
   */
  show(spec, faults) {
    const groups = Object.entries(spec).filter(([name]) => !LEFT_OUT.includes(name));
    const focused = document.activeElement?.id;
    const place = document.activeElement instanceof HTMLInputElement ? document.activeElement.selectionStart : null;
    this.#rows.clear();
    this.node.replaceChildren(...groups.map(([name, value]) =>
      element("fieldset", {}, element("legend", {}, words(name)), ...leaves(value, `/${name}`).map(([pointer, leaf]) => this.#row(pointer, leaf, spec.provenance ?? {})))));
    this.mark(faults);
    const again = focused ? document.getElementById(focused) : null;
    if (again instanceof HTMLInputElement && this.node.contains(again)) {
      again.focus();
      if (again.type === "text") again.setSelectionRange(place, place);
    }
  }

  /**
   * Marks the fields of faults.
   * @param {{pointer: string, detail: string}[]} faults
   */
  mark(faults) {
    for (const [pointer, row] of this.#rows) {
      const found = faults.filter((fault) => fault.pointer === pointer);
      const input = row.querySelector("input");
      const said = row.querySelector(".fault");
      if (said) said.textContent = found.map((fault) => fault.detail).join("; ");
      if (found.length) input?.setAttribute("aria-invalid", "true");
      else input?.removeAttribute("aria-invalid");
    }
  }

  /**
   * @param {string} pointer
   * @param {unknown} value
   * @param {Record<string, string>} provenance
   * @returns {HTMLElement}
   */
  #row(pointer, value, provenance) {
    const keys = pointer.split("/").slice(2);
    const [alone, unit_alone] = BY_UNIT[keys[keys.length - 1] ?? ""] ?? [];
    const found = UNITS.find(([end]) => pointer.endsWith(end));
    const name = alone ? [...keys.slice(0, -1), alone].join(" / ") : (keys.join(" / ") || pointer.slice(1)).slice(0, found ? -found[0].length : undefined);
    const id = `field${pointer.replaceAll("/", "-")}`;
    const input = /** @type {HTMLInputElement} */ (element("input", { id, type: "text", value: value === null ? "" : String(value), inputmode: typeof value === "number" ? "decimal" : null, "aria-describedby": `${id}-fault` }));
    input.addEventListener("change", () => this.#changed(pointer, as_value(input.value, value)));
    const row = element("p", { class: "field" },
      element("label", { for: id }, words(name)), input,
      element("span", { class: "muted unit" }, unit_alone ?? found?.[1] ?? ""), element("span", { class: "muted small from" }, provenance[pointer] ?? ""),
      element("span", { class: "fault", id: `${id}-fault` }));
    this.#rows.set(pointer, row);
    return row;
  }
}

/**
 * What was typed, as the kind of value that stood there.
 * @param {string} typed
 * @param {unknown} before
 * @returns {unknown}
 */
function as_value(typed, before) {
  if (typed.trim() === "") return null;
  if (typeof before === "boolean") return typed === "true";
  const number = Number(typed.replace(",", "."));
  return typeof before === "number" && !Number.isNaN(number) ? number : typed;
}
