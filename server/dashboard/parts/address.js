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

/**
 * The link of a page.
 * @param {string} page
 * @param {string | null} [id]
 * @param {Record<string, string | null>} [values]
 * @returns {string}
 */
export function link(page, id = null, values = {}) {
  const present = Object.entries(values).filter(([, value]) => value != null && value !== "");
  const query = new URLSearchParams(/** @type {[string, string][]} */ (present)).toString();
  return `#/${page}${id ? `/${id}` : ""}${query ? `?${query}` : ""}`;
}

/**
 * Changes values of the present address: as a new step of the browser's history, or in place where a value follows a slider.
 * Null removes a value.
 * @param {Record<string, string | null>} changes
 * @param {{in_place?: boolean}} [how]
 */
export function change(changes, { in_place = false } = {}) {
  const { page, id, values } = address();
  for (const [name, value] of Object.entries(changes)) {
    if (value == null || value === "") values.delete(name);
    else values.set(name, value);
  }
  const hash = link(page, id, Object.fromEntries(values));
  if (in_place) history.replaceState(null, "", hash);
  else location.hash = hash;
}

/** Values of the present address that follow a choice in place, such as an axis or the place of a slider. */
export const choices = {
  get: (/** @type {string} */ name) => address().values.get(name),
  set: (/** @type {string} */ name, /** @type {string | null} */ value) => change({ [name]: value }, { in_place: true }),
};
