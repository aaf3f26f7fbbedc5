// Tables as comma-separated values (RFC 4180).

/** A cell: quoted, with its quotation marks doubled, or plain; then what ends it. */
const CELL = /(?:"((?:[^"]|"")*)"|([^",\r\n]*))(,|\r?\n|$)/gy;

/**
 * The rows of a table, each as a map of column to cell.
 * @param {string} text
 * @returns {Map<string, string>[]}
 */
export function rows_of_csv(text) {
  /** @type {string[][]} */
  const rows = [[]];
  const whole = text.replace(/\r?\n$/, "");
  for (const [, quoted, plain, end] of whole.matchAll(CELL)) {
    rows[rows.length - 1].push(quoted?.replaceAll('""', '"') ?? plain);
    if (end === "") break;
    if (end !== ",") rows.push([]);
  }
  const [head, ...body] = rows;
  return body.map((cells) => new Map(head.map((name, index) => [name, cells[index] ?? ""])));
}

/**
 * A table of cells below their names.
 * @param {string[]} head
 * @param {(string | number)[][]} rows
 * @returns {string}
 */
export function csv(head, rows) {
  return [head, ...rows].map((row) => `${row.map(as_cell).join(",")}\n`).join("");
}

/** @param {string | number} value */
function as_cell(value) {
  const text = String(value);
  return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}
