// Values that are stored while the tab is open, also over reloads.

/** A new value may replace all of those whose keys begin so. */
const REPLACEABLE = ["draft ", "first run "];

/**
 * The value of a key; null where none is stored.
 * @param {string} key
 * @returns {any}
 */
export function stored(key) {
  return JSON.parse(sessionStorage.getItem(key) ?? "null");
}

/**
 * @param {string} key
 * @param {any} value
 */
export function store(key, value) {
  const text = JSON.stringify(value);
  try {
    sessionStorage.setItem(key, text);
  } catch {
    // No space is left.
    for (const old of Object.keys(sessionStorage)) if (REPLACEABLE.some((prefix) => old.startsWith(prefix))) sessionStorage.removeItem(old);
    try {
      sessionStorage.setItem(key, text);
    } catch {
      // It is larger than what a browser stores.
    }
  }
}
