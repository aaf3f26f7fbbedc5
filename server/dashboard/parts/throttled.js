// Calls that follow each other.

/** Time between two plans of what is typed, ms. */
export const TYPING_MS = 300;

/**
 * Calls a function at most once in so many milliseconds, the last time after the last call.
 * @param {() => unknown} act
 * @param {number} ms
 * @param {AbortSignal} signal
 * @returns {() => void}
 */
export function throttled(act, ms, signal) {
  /** @type {ReturnType<typeof setTimeout> | undefined} */
  let planned;
  return () => (planned ??= setTimeout(() => {
    planned = undefined;
    if (!signal.aborted) act();
  }, ms));
}
