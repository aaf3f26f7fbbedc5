// Lives by the criteria of a job.

import { card, element, table } from "../parts/element.js";
import { count, duration, number, percent, words } from "../parts/format.js";

/**
 * @param {any} job
 * @returns {HTMLElement | null}
 */
export function life_card({ summary }) {
  const lives = summary.life ?? [];
  if (lives.length === 0) return null;
  const name = (/** @type {any} */ { criterion, side }) => {
    const { kind, layer, fraction, mm, mohm } = criterion;
    const limit = layer != null ? ` of layer ${layer}` : fraction != null ? ` ${percent(fraction)}` : mm != null ? ` ${number(mm, 1e3)} µm` : mohm != null ? ` ${number(mohm)} mΩ` : "";
    return `${words(kind)}${limit}${side ? `, ${side}` : ""}`;
  };
  const rows = lives.map((/** @type {any} */ life) => [
    element("div", {}, name(life), life.reason ? element("div", { class: "muted small" }, life.reason) : ""),
    life.cycles == null ? words(life.status) : element("strong", {}, count(life.cycles)),
    life.band ? `${count(life.band.b10)} to ${count(life.band.b90)}` : "",
    percent(life.estimated_relative_error),
    life.duration_h == null ? "" : duration(3600 * life.duration_h),
  ]);
  return card("Life", table({ head: ["criterion", "cycles", "10 % to 90 % of parts", "estimated error", "time"], rows, numbers: [1, 2, 3, 4] }));
}
