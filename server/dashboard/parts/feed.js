// Changes of all jobs, from one stream.

import { events, Problem } from "./client.js";
import { reached_again, show_connection, when_reached_again } from "./connection.js";

/** Time between attempts to connect again, ms. */
const RETRY_MS = 2000;

/**
 * @typedef {object} Listener
 * @property {(job: any) => void} changed with the short document of a job
 * @property {(id: string) => void} deleted
 * @property {() => void} reset where changes were missed: what is shown must be loaded again
 * @property {() => void} [started] once changes are received, all those after this moment
 */

/**
 * @param {number} ms
 * @param {AbortSignal} signal
 */
function pause(ms, signal) {
  return new Promise((resolve) => {
    setTimeout(resolve, ms);
    signal.addEventListener("abort", resolve, { once: true });
  });
}

/**
 * Follows the changes of jobs until the signal; connects again where the service was away, without losing any.
 * @param {Listener} listener
 * @param {AbortSignal} signal
 */
export async function follow(listener, signal) {
  // Loads may have failed in between.
  when_reached_again(listener.reset, signal);
  /** @type {string | null} */
  let last = null;
  while (!signal.aborted) {
    try {
      for await (const { name, id, data } of events("/v1/events", signal, last)) {
        last = id ?? last;
        if (name === "job") listener.changed(data);
        else if (name === "deleted") listener.deleted(data.id);
        else if (name === "reset") listener.reset();
        else if (name === "start") listener.started?.();
      }
    } catch (error) {
      if (signal.aborted) return;
      if (error instanceof Problem && error.status === 401) return show_connection("no access");
    }
    if (signal.aborted) return;
    await Promise.all([pause(RETRY_MS, signal), reached_again(signal)]);
  }
}
