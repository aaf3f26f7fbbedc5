// The page that the address asks for.

import { accuracy_page } from "./accuracy/page.js";
import { batches_page } from "./batches/page.js";
import { compare_page } from "./compare/page.js";
import { job_page } from "./job/page.js";
import { jobs_page } from "./jobs/page.js";
import { address } from "./parts/address.js";
import { reached_again, Unreachable } from "./parts/connection.js";
import { study_page } from "./study/page.js";
import { sweep_page } from "./sweep/page.js";
import { workers_page } from "./workers/page.js";

/** @typedef {import("./parts/address.js").Address} Address */
/** A page fills its element, ends with its signal, and returns what to do when values of its own address change.
 * @typedef {(content: HTMLElement, address: Address, signal: AbortSignal) => Promise<((values: URLSearchParams) => void) | void>} Page */

/** @type {Record<string, Page>} */
const PAGES = { jobs: jobs_page, job: job_page, compare: compare_page, study: study_page, sweeps: batches_page, sweep: sweep_page, accuracy: accuracy_page, workers: workers_page };

let present = { key: "", end: new AbortController(), changed: /** @type {((values: URLSearchParams) => void) | void} */ (undefined) };

/** @param {string} text */
function show_message(text) {
  const message = document.getElementById("message");
  if (message) message.textContent = text;
}

async function open_page() {
  // An address of earlier versions: `#ID`.
  const id = /^#([0-9a-f-]{36})$/.exec(location.hash)?.[1];
  if (id) return location.replace(`#/job/${id}`);
  const asked = address();
  const key = `${asked.page}/${asked.id ?? ""}`;
  if (key === present.key && present.changed) return present.changed(asked.values);
  present.end.abort();
  const end = new AbortController();
  present = { key, end, changed: undefined };
  show_message("");
  const content = /** @type {HTMLElement} */ (document.getElementById("content"));
  for (const node of document.querySelectorAll("nav a"))
    node.toggleAttribute("aria-current", node.getAttribute("href") === `#/${asked.page}`);
  content.replaceChildren();
  content.setAttribute("aria-busy", "true");
  try {
    const page = PAGES[asked.page] ?? jobs_page;
    const changed = await page(content, asked, end.signal);
    if (!end.signal.aborted) present.changed = changed;
  } catch (error) {
    if (end.signal.aborted) return;
    if (error instanceof Unreachable) open_again(end.signal);
    else show_message(error instanceof Error ? error.message : String(error));
  } finally {
    if (!end.signal.aborted) content.removeAttribute("aria-busy");
  }
}

/**
 * Opens a page that could not be opened once the service is reached again.
 * @param {AbortSignal} signal
 */
async function open_again(signal) {
  await reached_again(signal);
  if (signal.aborted) return;
  present.key = "";
  open_page();
}

addEventListener("hashchange", open_page);
addEventListener("unhandledrejection", (event) => {
  const { reason } = event;
  // A lost connection is said beside the pages, and a request of a page that was left is no fault.
  if (reason instanceof Unreachable || reason?.name === "AbortError") event.preventDefault();
  else show_message(reason?.message ?? String(reason));
});
open_page();
