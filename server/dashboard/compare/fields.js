// Fields in which documents differ.

/** Fields that say where a document is from, not what it is. */
const LEFT_OUT = ["/provenance", "/name"];

/**
 * All fields of several documents that are not the same in all, with their values in words.
 * @param {any[]} documents
 * @returns {[string, string[]][]}
 */
export function differing(documents) {
  const all = documents.map((document) => new Map(leaves(document, "")));
  const pointers = [...new Set(all.flatMap((fields) => [...fields.keys()]))];
  const rows = pointers.map((pointer) => /** @type {[string, string[]]} */ ([pointer, all.map((fields) => fields.get(pointer) ?? "–")]));
  return rows.filter(([pointer, values]) => !LEFT_OUT.some((start) => pointer.startsWith(start)) && new Set(values).size > 1);
}

/**
 * @param {any} value
 * @param {string} pointer
 * @returns {[string, string][]}
 */
function leaves(value, pointer) {
  if (value === null || typeof value !== "object") return [[pointer, String(value)]];
  return Object.entries(value).flatMap(([key, item]) => leaves(item, `${pointer}/${key}`));
}
