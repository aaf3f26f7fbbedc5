// Drawings that wait until they can be seen.

/** Distance from the window at which a part is drawn, before it comes into view. */
const MARGIN = "300px";
/** Pause before the next drawing where the browser does not say when it has nothing else to do, ms. */
const PAUSE_MS = 50;

/** First drawings of parts out of view. @type {(() => unknown)[]} */
const waiting = [];

/** @param {() => void} act */
function when_idle(act) {
  if (window.requestIdleCallback) window.requestIdleCallback(() => act());
  else setTimeout(act, PAUSE_MS);
}

function draw_next() {
  waiting.shift()?.();
  if (waiting.length > 0) when_idle(draw_next);
}

/**
 * A function that has a part of the page drawn: now if it is in view, else when it comes into view. For the first time it is drawn
 * out of view, too, as soon as the browser has nothing else to do.
 * @param {HTMLElement} part
 * @param {() => unknown} draw
 * @param {AbortSignal} signal that ends it with its page
 * @returns {() => unknown}
 */
export function when_seen(part, draw, signal) {
  let [is_seen, is_asked, is_first] = [false, false, true];
  const draw_asked = () => {
    if (!is_asked || signal.aborted) return null;
    is_asked = false;
    return draw();
  };
  const observer = new IntersectionObserver((entries) => {
    is_seen = entries[entries.length - 1].isIntersecting;
    if (is_seen) draw_asked();
  }, { rootMargin: MARGIN });
  observer.observe(part);
  signal.addEventListener("abort", () => observer.disconnect());
  return () => {
    is_asked = true;
    if (is_seen) return draw_asked();
    if (is_first && waiting.push(draw_asked) === 1) when_idle(draw_next);
    is_first = false;
    return null;
  };
}
