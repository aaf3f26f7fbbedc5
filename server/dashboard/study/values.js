// Values of a swept field, from what is typed.

/** Digits of values between two others. */
const DIGITS = 6;

/**
 * A list as it is typed: numbers, words or JSON, separated by commas.
 * @param {string} text
 * @returns {unknown[]}
 */
export function listed(text) {
  try {
    return JSON.parse(`[${text}]`);
  } catch {
    const parts = text.split(",").map((part) => part.trim()).filter((part) => part !== "");
    return parts.map((part) => (Number.isNaN(Number(part)) ? word(part) : Number(part)));
  }
}

/** @param {string} part */
function word(part) {
  try {
    return JSON.parse(part);
  } catch {
    return part;
  }
}

/**
 * Values at equal distances or, on a logarithmic scale, at equal ratios; those of counts are whole numbers.
 * @param {{from: number, to: number, count: number, is_log: boolean, is_count: boolean}} asked
 * @returns {number[]} none where there are no such values
 */
export function spread({ from, to, count, is_log, is_count }) {
  const is_possible = Number.isFinite(from) && Number.isFinite(to) && Number.isInteger(count) && count >= 2 && (!is_log || (from > 0 && to > 0));
  if (!is_possible) return [];
  const at = (/** @type {number} */ share) => (is_log ? from * (to / from) ** share : from + (to - from) * share);
  const values = Array.from({ length: count }, (_, index) => at(index / (count - 1)));
  return [...new Set(values.map((value) => (is_count ? Math.round(value) : Number(value.toPrecision(DIGITS)))))];
}
