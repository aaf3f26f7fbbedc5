// Requests to the interface of the service, with the access token where it needs one.

import { request, Unreachable } from "./connection.js";
import { ask_for_token } from "./token.js";

/** A problem document (RFC 9457) as an error. */
export class Problem extends Error {
  /**
   * @param {string} message
   * @param {number} status
   * @param {{pointer: string, detail: string}[]} [faults]
   */
  constructor(message, status, faults = []) {
    super(message);
    this.status = status;
    this.faults = faults;
  }
}

/**
 * Sends a request; without an answer of the service it is [`Unreachable`]. Without a valid token the reader is asked for one, once until the page is used again.
 * @param {string} path
 * @param {RequestInit} [options]
 * @returns {Promise<Response>}
 */
export async function send(path, options = {}) {
  const attempt = () => {
    const token = sessionStorage.getItem("token");
    const headers = new Headers(options.headers);
    if (token) headers.set("authorization", `Bearer ${token}`);
    return request(path, { ...options, headers });
  };
  const response = await attempt();
  if (response.status !== 401 || !(await ask_for_token())) return response;
  return attempt();
}

/**
 * Fetches a document; a refusal is a [`Problem`] with its details.
 * @param {string} path
 * @param {RequestInit} [options]
 * @returns {Promise<any>}
 */
export async function fetch_json(path, options) {
  return (await fetch_answer(path, options)).body;
}

/**
 * The same with the headers of the answer.
 * @param {string} path
 * @param {RequestInit} [options]
 * @returns {Promise<{body: any, headers: Headers}>}
 */
export async function fetch_answer(path, options) {
  const response = await send(path, options);
  const { headers } = response;
  if (response.status === 204) return { body: null, headers };
  const body = await response.json().catch((error) => {
    // An answer without a body is null; one that breaks off is none, because its page was left or the connection was lost.
    if (!response.ok || error instanceof SyntaxError) return null;
    throw error.name === "AbortError" ? error : new Unreachable();
  });
  if (!response.ok) throw new Problem(body?.detail ?? body?.title ?? `${path}: ${response.status}`, response.status, body?.faults);
  return { body, headers };
}

/**
 * Sends a document.
 * @param {string} path
 * @param {unknown} body
 * @returns {Promise<any>}
 */
export function post_json(path, body) {
  return fetch_json(path, { method: "POST", headers: { "content-type": "application/json" }, body: JSON.stringify(body) });
}

/**
 * Server-Sent Events of a path until the stream ends or is aborted.
 * @param {string} path
 * @param {AbortSignal} signal
 * @param {string | null} [after] id of the last event that was received
 * @returns {AsyncGenerator<{name: string, id: string | null, data: any}>}
 */
export async function* events(path, signal, after = null) {
  const headers = after == null ? undefined : { "last-event-id": after };
  const response = await send(path, { signal, headers });
  if (!response.ok || !response.body) throw new Problem(`${path}: ${response.status}`, response.status);
  const reader = response.body.pipeThrough(new TextDecoderStream()).getReader();
  let text = "";
  for (;;) {
    // A broken stream ends: what follows is asked for with the next one.
    const { value, done } = await reader.read().catch(() => ({ value: "", done: true }));
    if (done) return;
    const blocks = (text + value).split("\n\n");
    text = blocks.pop() ?? "";
    for (const block of blocks) {
      const field = (/** @type {string} */ name) => block.split("\n").find((line) => line.startsWith(`${name}:`))?.slice(name.length + 1).trim();
      const name = field("event");
      if (name) yield { name, id: field("id") ?? null, data: JSON.parse(field("data") ?? "null") };
    }
  }
}
