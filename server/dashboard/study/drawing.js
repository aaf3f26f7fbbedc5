// Slider, receptacle and stroke to scale.

import { length } from "../parts/format.js";
import { imposed } from "../parts/motion.js";

const NAMESPACE = "http://www.w3.org/2000/svg";
/** Width and height of the drawing, in its own units. */
const [WIDTH, HEIGHT] = [400, 240];

/**
 * @param {string} name
 * @param {Record<string, string | number>} attributes
 * @param {string} [text]
 */
function shape(name, attributes, text) {
  const node = document.createElementNS(NAMESPACE, name);
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, String(value));
  if (text) node.textContent = text;
  return node;
}

/**
 * The lengths that are drawn, mm.
 * @param {any} system
 */
function lengths(system) {
  const radius = system.contact_radius_mm ?? system.radius_mm ?? (system.wire_diameter_mm ?? 0) / 2;
  const block = system.pad_length_mm ?? system.pcb_length_mm ?? system.flat_length_mm;
  const height = system.pad_height_mm ?? system.pcb_height_mm ?? system.flat_height_mm;
  return { radius, block, height };
}

/**
 * A drawing of a resolved specification with its plan; nothing where lengths are missing.
 * @param {any} spec
 * @param {any} plan
 * @returns {Node[]}
 */
export function drawing(spec, plan) {
  const { radius, block, height } = lengths(spec.system);
  if (!radius || !block || !height) return [];
  const { amplitude_mm: amplitude, text } = imposed(spec, plan);
  const scale = Math.min((WIDTH - 20) / Math.max(block, 2 * (radius + amplitude)), (HEIGHT - 40) / (radius + height));
  const [middle, surface] = [WIDTH / 2, 20 + radius * scale];
  const [r, half, stroke] = [radius * scale, (block * scale) / 2, amplitude * scale];
  const arc = `M ${middle - r} ${surface - r} A ${r} ${r} 0 0 0 ${middle + r} ${surface - r}`;
  const svg = shape("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: "img", "aria-label": "slider on receptacle, to scale" });
  svg.append(
    shape("rect", { x: middle - half, y: surface, width: 2 * half, height: height * scale, class: "receptacle" }),
    shape("path", { d: `${arc} Z`, class: "slider" }),
    shape("path", { d: `M ${middle - Math.max(stroke, 0.5)} ${surface + 5} h ${2 * Math.max(stroke, 0.5)}`, class: "stroke" }),
    shape("text", { x: middle, y: surface - r * 0.55, "text-anchor": "middle" }, `R ${length(radius)}`),
    shape("text", { x: middle, y: surface + height * scale + 15, "text-anchor": "middle" }, `${length(block)} × ${length(height)}, ${text}`));
  return [svg];
}
