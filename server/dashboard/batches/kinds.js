// The two kinds of batches: where the interface and the pages have them.

/** @typedef {"sweep" | "accuracy"} Kind */

/** @type {Record<Kind, {name: string, path: string, table: string, page: string}>} */
export const KINDS = {
  sweep: { name: "sweep", path: "/v1/sweeps", table: "outcomes", page: "sweep" },
  accuracy: { name: "accuracy study", path: "/v1/studies", table: "table", page: "accuracy" },
};

/**
 * The name of a batch for people.
 * @param {{id: string, name?: string | null}} batch
 * @param {Kind} kind
 * @returns {string}
 */
export function name_of({ id, name }, kind) {
  return name || `${KINDS[kind].name} ${id.slice(-12)}`;
}
