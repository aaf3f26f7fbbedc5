// What a comparison of jobs shows.

import { link } from "./address.js";

/** Jobs that one comparison shows at most. */
export const MOST_COMPARED = 10;

/**
 * The link of the comparison of some jobs; null where they are too few or too many.
 * @param {string[]} ids
 * @returns {string | null}
 */
export function comparison_link(ids) {
  return ids.length < 2 || ids.length > MOST_COMPARED ? null : link("compare", null, { jobs: ids.join(",") });
}
