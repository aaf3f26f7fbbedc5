// The motion of a contact: the amplitude that is imposed on it, and how a vibration, a thermal cycle or an insertion leads to it.

import { card, definitions, element } from "./element.js";
import { length, number } from "./format.js";

/** Times in a period of a series at which its extremes are sought. */
const TIMES = 720;

/**
 * The amplitude that is imposed on the contact, mm, and what is said of it; of a mission that of its widest block.
 * @param {any} spec resolved
 * @param {any} plan
 * @returns {{amplitude_mm: number, text: string}}
 */
export function imposed({ motion }, { motion: derived, mission = [] }) {
  if (mission.length) {
    const widest = mission.reduce((/** @type {any} */ one, /** @type {any} */ other) => (other.amplitude_mm > one.amplitude_mm ? other : one));
    return { amplitude_mm: widest.amplitude_mm, text: `stroke ±${length(widest.amplitude_mm)} at most, of ${widest.name || "a block"}` };
  }
  if (derived) return { amplitude_mm: derived.slip_amplitude_mm, text: derived.sticks ? "it sticks: no slip" : `slip ±${length(derived.slip_amplitude_mm)}` };
  if (motion?.kind === "continuous") return { amplitude_mm: 0, text: `${length(motion.distance_mm)} in one direction` };
  const amplitude_mm = motion?.kind === "fourier" ? extreme(motion.terms ?? []) : motion?.amplitude_mm ?? 0;
  return { amplitude_mm, text: `stroke ±${length(amplitude_mm)}` };
}

/**
 * The largest displacement of a Fourier series, mm.
 * @param {{order: number, sine_mm?: number, cosine_mm?: number}[]} terms
 */
function extreme(terms) {
  const at = (/** @type {number} */ phase) => terms.reduce((sum, { order, sine_mm = 0, cosine_mm = 0 }) => sum + sine_mm * Math.sin(order * phase) + cosine_mm * Math.cos(order * phase), 0);
  return Math.max(0, ...Array.from({ length: TIMES }, (_, index) => Math.abs(at((2 * Math.PI * index) / TIMES))));
}

/**
 * How the slip was derived: of the motion, or of each block of a mission that has one; null where none was.
 * @param {any} plan
 * @returns {HTMLElement | null}
 */
export function motion_card({ motion, mission = [] }) {
  const named = motion ? [{ name: "", motion }] : mission.filter((/** @type {any} */ block) => block.motion);
  if (named.length === 0) return null;
  return card("Slip", ...named.flatMap((/** @type {any} */ { name, motion }) => [name ? element("h3", {}, name) : null, ...derivation(motion)]));
}

/** @param {any} motion derived */
function derivation({ relative_amplitude_mm, held_amplitude_mm, slip_amplitude_mm, sticks, slips_from_g, frequency_hz, reason }) {
  return [
    definitions([
      ["slip", sticks ? "none: the contact sticks" : `±${length(slip_amplitude_mm)}`],
      ["the parts move by", `±${length(relative_amplitude_mm)}`],
      ["taken up without slip", `±${length(held_amplitude_mm)}`],
      ["slips from", slips_from_g == null ? null : `${number(slips_from_g)} g`],
      ["frequency of the cycles", `${number(frequency_hz)} Hz`],
    ]),
    element("p", { class: "muted" }, reason),
  ];
}
