// What can be done with a batch.

import { fetch_json } from "../parts/client.js";
import { element } from "../parts/element.js";
import { count } from "../parts/format.js";
import { counts_with_later, progress } from "./counts.js";
import { KINDS, name_of } from "./kinds.js";

/**
 * The button that cancels a batch, or deletes it once all of its jobs have ended.
 * @param {any} batch
 * @param {import("./kinds.js").Kind} kind
 * @param {{said: HTMLElement, cancelled: () => void, deleted: () => void}} then
 * @returns {HTMLElement}
 */
export function end_button(batch, kind, { said, cancelled, deleted }) {
  const path = `${KINDS[kind].path}/${batch.id}`;
  const name = name_of(batch, kind);
  const act = async (/** @type {string} */ address, /** @type {string} */ method, /** @type {() => void} */ then) => {
    try {
      await fetch_json(address, { method });
      said.textContent = "";
      then();
    } catch (error) {
      said.textContent = error instanceof Error ? error.message : String(error);
    }
  };
  const counts = counts_with_later(batch);
  const jobs = Object.values(counts).reduce((all, some) => all + some, 0);
  const has_ended = progress(counts) === 1 || jobs === 0;
  const remove = () => confirm(`Delete ${name} with its ${count(jobs)} jobs and their results?`) && act(path, "DELETE", deleted);
  return has_ended
    ? element("button", { type: "button", "aria-label": `Delete ${name}`, click: remove }, "Delete")
    : element("button", { type: "button", "aria-label": `Cancel ${name}`, click: () => act(`${path}/cancel`, "POST", cancelled) }, "Cancel");
}
