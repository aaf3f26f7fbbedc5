// Numbers, durations and times as a person reads them.

const PREFIXES = /** @type {[number, string][]} */ ([[1, "mm"], [1e-3, "µm"], [1e-6, "nm"]]);

/** Share below which only that is said. */
const LEAST_SHARE = 1e-4;

/**
 * A number with four digits; empty if there is none.
 * @param {number | null | undefined} value
 * @param {number} [scale]
 * @returns {string}
 */
export function number(value, scale = 1) {
  if (value == null) return "";
  const scaled = value * scale;
  const size = Math.abs(scaled);
  if (size !== 0 && (size < 1e-3 || size >= 1e6)) return scaled.toExponential(2).replace("e", " e");
  return Number(scaled.toPrecision(4)).toLocaleString("en", { maximumFractionDigits: 6 });
}

/**
 * A whole number with all of its digits.
 * @param {number | null | undefined} value
 * @returns {string}
 */
export function count(value) {
  return value == null ? "" : Math.round(value).toLocaleString("en");
}

/**
 * A length in mm with the unit that suits it.
 * @param {number | null | undefined} mm
 * @returns {string}
 */
export function length(mm) {
  if (mm == null) return "";
  if (mm === 0) return "0 µm";
  const [scale, unit] = PREFIXES.find(([scale]) => Math.abs(mm) >= 0.1 * scale) ?? PREFIXES[2];
  return `${number(mm / scale)} ${unit}`;
}

/**
 * A share in per cent.
 * @param {number | null | undefined} share
 * @returns {string}
 */
export function percent(share) {
  if (share == null) return "";
  return share !== 0 && Math.abs(share) < LEAST_SHARE ? `< ${100 * LEAST_SHARE} %` : `${Number((100 * share).toPrecision(2))} %`;
}

/**
 * A duration: `7 s`, `12 min`, `3.5 h`, `2.1 d`.
 * @param {number | null | undefined} seconds
 * @returns {string}
 */
export function duration(seconds) {
  if (seconds == null) return "";
  if (seconds < 100) return `${Number(Math.max(seconds, 0).toPrecision(2))} s`;
  if (seconds < 6000) return `${Math.round(seconds / 60)} min`;
  if (seconds < 172_800) return `${(seconds / 3600).toFixed(1)} h`;
  return `${(seconds / 86_400).toFixed(1)} d`;
}

/**
 * A range of durations, from the likely one to one that is enough in nine of ten cases.
 * @param {number | null | undefined} likely s
 * @param {number | null | undefined} most s
 * @returns {string}
 */
export function duration_range(likely, most) {
  const [from, to] = [duration(likely), duration(most)];
  return to === "" || from === to ? from : from === "" ? to : `${from} to ${to}`;
}

/**
 * A time of day or date in the reader's own format.
 * @param {string | null | undefined} text RFC 3339
 * @returns {string}
 */
export function time(text) {
  return text == null ? "" : new Date(text).toLocaleString(undefined, { dateStyle: "medium", timeStyle: "short" });
}

/**
 * Seconds between two times, the second one now if absent.
 * @param {string} from
 * @param {string | null} [to]
 * @returns {number}
 */
export function seconds_between(from, to) {
  return ((to ? Date.parse(to) : Date.now()) - Date.parse(from)) / 1000;
}

/**
 * A size of a file.
 * @param {number} bytes
 * @returns {string}
 */
export function size(bytes) {
  if (bytes < 1000) return `${bytes} B`;
  return bytes < 1e6 ? `${Math.round(bytes / 1e3)} kB` : `${(bytes / 1e6).toFixed(1)} MB`;
}

/**
 * A name of the interface in words.
 * @param {string} name
 * @returns {string}
 */
export function words(name) {
  return name.replaceAll("_", " ");
}
