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
  const shares = lives.find((/** @type {any} */ life) => life.at_reliability?.length)?.at_reliability.map((/** @type {any} */ at) => at.share) ?? [];
  const is_judged = lives.some((/** @type {any} */ life) => life.verdict);
  const rows = lives.map((/** @type {any} */ life) => [
    element("div", {}, name(life), life.reason ? element("div", { class: "muted small" }, life.reason) : ""),
    life.cycles == null ? words(life.status) : element("strong", {}, count(life.cycles)),
    life.band ? `${count(life.band.b10)} to ${count(life.band.b90)}` : "",
    ...shares.map((/** @type {number} */ _, /** @type {number} */ index) => (life.at_reliability[index] ? count(life.at_reliability[index].of_contacts) : "")),
    ...(is_judged ? [percent(life.connectors_failed_at_target), words(life.verdict ?? "")] : []),
    percent(life.estimated_relative_error),
    life.duration_h == null ? "" : duration(3600 * life.duration_h),
  ]);
  const of_shares = shares.map((/** @type {number} */ share) => `${percent(share)} of connectors last`);
  const of_target = is_judged ? ["connectors that fail before the target", "verdict"] : [];
  const head = ["criterion", "cycles", "10 % to 90 % of parts", ...of_shares, ...of_target, "estimated error", "time"];
  return card("Life", table({ head, rows, numbers: head.map((_, index) => index).slice(1) }));
}
