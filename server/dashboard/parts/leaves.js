// The values of a document with their JSON pointers (RFC 6901).

/**
 * All values below one that have no parts.
 * @param {any} value
 * @param {string} [pointer] of the value itself
 * @param {(value: any) => boolean} [is_leaf] which values are shown as a whole
 * @returns {[string, any][]}
 */
export function leaves(value, pointer = "", is_leaf = has_no_parts) {
  if (is_leaf(value)) return [[pointer, value]];
  const step = (/** @type {string} */ key) => key.replaceAll("~", "~0").replaceAll("/", "~1");
  return Object.entries(value).flatMap(([key, item]) => leaves(item, `${pointer}/${step(key)}`, is_leaf));
}

/** @param {any} value */
export function has_no_parts(value) {
  return value === null || typeof value !== "object";
}
