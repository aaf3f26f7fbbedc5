// The connection to the service: a lost one is said in one place, and what waits for it is told when it is back.

import { element } from "./element.js";

/** Time between attempts to reach it again, ms. */
const RETRY_MS = 2000;
/** Answers of a proxy without a service behind it. */
const OF_A_PROXY = [502, 503, 504];

/** A request without an answer of the service. */
export class Unreachable extends Error {
  constructor() {
    super("The service cannot be reached.");
  }
}

let is_away = false;
/** @type {Set<() => void>} */
const listeners = new Set();

/** @param {string} text */
export function show_connection(text) {
  document.getElementById("connection")?.replaceChildren(text ? element("span", { class: "away" }, text) : "");
}

/**
 * Sends a request and notes whether the service has answered.
 * @param {string} path
 * @param {RequestInit} [options]
 * @returns {Promise<Response>}
 */
export async function request(path, options) {
  let response;
  try {
    response = await fetch(path, options);
  } catch (error) {
    if (options?.signal?.aborted || (error instanceof Error && error.name === "AbortError")) throw error;
    lost();
    throw new Unreachable();
  }
  if (OF_A_PROXY.includes(response.status) && !response.headers.get("content-type")?.includes("json")) {
    lost();
    throw new Unreachable();
  }
  found();
  return response;
}

/** Says that the service is away, and tries to reach it until it answers. */
function lost() {
  if (is_away) return;
  is_away = true;
  show_connection("The service cannot be reached; trying again …");
  const attempt = () => setTimeout(() => request("/healthz").catch(() => attempt()), RETRY_MS);
  attempt();
}

function found() {
  if (!is_away) return;
  is_away = false;
  show_connection("");
  for (const listener of [...listeners]) listener();
}

/**
 * Calls a function each time that the service is reached again.
 * @param {() => void} listener
 * @param {AbortSignal} signal
 */
export function when_reached_again(listener, signal) {
  listeners.add(listener);
  signal.addEventListener("abort", () => listeners.delete(listener), { once: true });
}

/**
 * Resolves when the service is reached again, or the signal ends the wait.
 * @param {AbortSignal} signal
 * @returns {Promise<void>}
 */
export function reached_again(signal) {
  if (!is_away || signal.aborted) return Promise.resolve();
  return new Promise((resolve) => {
    const end = new AbortController();
    const done = () => {
      end.abort();
      resolve();
    };
    when_reached_again(done, end.signal);
    signal.addEventListener("abort", done, { once: true });
  });
}
