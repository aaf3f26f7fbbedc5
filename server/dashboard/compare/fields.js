// Fields in which documents differ.

import { leaves } from "../parts/leaves.js";

/** Fields that say where a document is from, not what it is. */
const LEFT_OUT = ["/provenance", "/name"];

/**
 * All fields of several documents that are not the same in all, with their values in words.
 * @param {any[]} documents
 * @returns {[string, string[]][]}
 */
export function differing(documents) {
  const all = documents.map((document) => new Map(leaves(document).map(([pointer, value]) => [pointer, String(value)])));
  const pointers = [...new Set(all.flatMap((fields) => [...fields.keys()]))];
  const rows = pointers.map((pointer) => /** @type {[string, string[]]} */ ([pointer, all.map((fields) => fields.get(pointer) ?? "–")]));
  return rows.filter(([pointer, values]) => !LEFT_OUT.some((start) => pointer.startsWith(start)) && new Set(values).size > 1);
}
