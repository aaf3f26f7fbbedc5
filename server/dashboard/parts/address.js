// State in the address: `#/page/id?name=value`, so that links, reloads and the back button lead to it.

/** @typedef {{page: string, id: string | null, values: URLSearchParams}} Address */

/**
 * The present address.
 * @returns {Address}
 */
export function address() {
  const [path, query = ""] = location.hash.slice(1).split("?");
  const [, page = "", id = ""] = path.split("/");
  return { page: page || "jobs", id: id || null, values: new URLSearchParams(query) };
}

/** Values by name; several of one name are a list, null is none.
 * @typedef {Record<string, string | string[] | null>} Values */

/**
 * The link of a page.
 * @param {string} page
 * @param {string | null} [id]
 * @param {Values} [values]
 * @returns {string}
 */
export function link(page, id = null, values = {}) {
  const query = with_changes(new URLSearchParams(), values).toString();
  return `#/${page}${id ? `/${id}` : ""}${query ? `?${query}` : ""}`;
}

/**
 * The link of the present page with other values.
 * @param {Values} changes
 * @returns {string}
 */
export function changed(changes) {
  const { page, id, values } = address();
  const query = with_changes(values, changes).toString();
  return `${link(page, id)}${query ? `?${query}` : ""}`;
}

/**
 * Changes values of the present address: as a new step of the browser's history, or in place where a value follows a slider.
 * Null removes a value.
 * @param {Values} changes
 * @param {{in_place?: boolean}} [how]
 */
export function change(changes, { in_place = false } = {}) {
  if (in_place) history.replaceState(history.state, "", changed(changes));
  else location.hash = changed(changes);
}

/**
 * @param {URLSearchParams} values
 * @param {Values} changes
 */
function with_changes(values, changes) {
  for (const [name, change] of Object.entries(changes)) {
    values.delete(name);
    for (const value of [change].flat()) if (value != null && value !== "") values.append(name, value);
  }
  return values;
}

/** Values of the present address that follow a choice in place, such as an axis or the place of a slider. */
export const choices = {
  get: (/** @type {string} */ name) => address().values.get(name),
  set: (/** @type {string} */ name, /** @type {string | null} */ value) => change({ [name]: value }, { in_place: true }),
};
