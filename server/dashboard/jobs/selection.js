// Jobs that are selected in the list, and what can be done with all of them.

import { fetch_json } from "../parts/client.js";
import { comparison_link } from "../parts/comparison.js";
import { element } from "../parts/element.js";

/** The selected jobs. */
export class Selection {
  /** @type {Set<string>} */
  #ids = new Set();
  #said = element("span", { role: "status" });
  #buttons;

  /** @param {AbortSignal} signal */
  constructor(signal) {
    const button = (/** @type {string} */ text, /** @type {() => void} */ click) => element("button", { type: "button", disabled: true, click }, text);
    const all = (/** @type {string} */ verb, /** @type {(id: string) => Promise<unknown>} */ act) => () => this.#for_all(verb, act);
    this.#buttons = {
      compare: button("Compare", () => (location.hash = comparison_link([...this.#ids]) ?? location.hash)),
      cancel: button("Cancel", all("cancelled", (id) => fetch_json(`/v1/jobs/${id}/cancel`, { method: "POST", signal }))),
      remove: button("Delete", all("deleted", (id) => fetch_json(`/v1/jobs/${id}`, { method: "DELETE", signal }))),
    };
    this.bar = element("div", { class: "selection" }, ...Object.values(this.#buttons), this.#said);
  }

  /**
   * The box that selects a job.
   * @param {string} id
   * @param {string} name
   * @returns {HTMLElement}
   */
  box_of(id, name) {
    const box = /** @type {HTMLInputElement} */ (element("input", { type: "checkbox", "aria-label": `select ${name}` }));
    box.addEventListener("change", () => {
      if (box.checked) this.#ids.add(id);
      else this.#ids.delete(id);
      this.#show(`${this.#ids.size} selected`);
    });
    return box;
  }

  /** @param {string} id of a job that is no longer there */
  remove(id) {
    if (this.#ids.delete(id)) this.#show(`${this.#ids.size} selected`);
  }

  /** @param {string} text */
  #show(text) {
    const count = this.#ids.size;
    this.#buttons.compare.toggleAttribute("disabled", comparison_link([...this.#ids]) === null);
    this.#buttons.cancel.toggleAttribute("disabled", count === 0);
    this.#buttons.remove.toggleAttribute("disabled", count === 0);
    this.#said.textContent = text;
  }

  /**
   * @param {string} verb
   * @param {(id: string) => Promise<unknown>} act
   */
  async #for_all(verb, act) {
    const ids = [...this.#ids];
    if (verb === "deleted" && !confirm(`Delete ${ids.length} jobs with their results?`)) return;
    const results = await Promise.allSettled(ids.map(act));
    const failures = results.filter((result) => result.status === "rejected").map((result) => /** @type {PromiseRejectedResult} */ (result).reason.message);
    this.#show(`${ids.length - failures.length} ${verb}${failures.length ? `; ${failures.join("; ")}` : ""}`);
  }
}
