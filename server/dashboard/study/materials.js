// Choices of materials and platings: those of the library, and those of the systems' presets.

import { words } from "../parts/format.js";
import { select } from "./control.js";

/** Choice of a material whose properties are given one by one. */
const OWN = "own properties";

/**
 * The choice of a material of the library, or of own properties.
 * @param {string} id
 * @param {any} value its name, or its properties
 * @param {import("./schema.js").Shape} shape
 * @param {(value: unknown) => void} changed
 */
export function material_choice(id, value, shape, changed) {
  const names = shape.forms.flatMap((form) => form.choices ?? []);
  const chosen = typeof value === "string" ? value : value?.name ?? (value ? OWN : undefined);
  const { name: _, ...properties } = typeof value === "object" && value !== null ? value : {};
  return select(id, chosen, [...names.map((name) => /** @type {[string, string]} */ ([name, words(name)])), [OWN, OWN]], (choice) => changed(choice === OWN ? properties : choice));
}

/**
 * The platings of the presets of a side, and none, by what they are of.
 * @param {any[]} systems
 * @param {"slider" | "receptacle"} side
 * @returns {Map<string, any[]>}
 */
export function platings(systems, side) {
  const found = /** @type {Map<string, any[]>} */ (new Map([["bare", []]]));
  for (const { preset } of systems) {
    const layers = (preset.plating?.[side] ?? []).map((/** @type {any} */ { material, ...layer }) => ({ material: material.name ?? material, ...layer }));
    const name = layers.map((/** @type {any} */ layer) => `${layer.thickness_um} µm ${words(String(layer.material))}`).join(" on ");
    const known = [...found.keys()].find((other) => other.startsWith(name) && JSON.stringify(found.get(other)) === JSON.stringify(layers));
    if (name && !known) found.set(`${name} (${words(preset.system.kind)})`, layers);
  }
  return found;
}
