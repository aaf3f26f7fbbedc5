// The filter by labels: those of the address, and a list of those that jobs have.

import { address, change } from "../parts/address.js";
import { fetch_json } from "../parts/client.js";
import { element } from "../parts/element.js";

/** The labels that listed jobs must have. */
export class LabelFilter {
  #list = /** @type {HTMLSelectElement} */ (element("select", { "aria-label": "label", change: () => this.#add() }));
  #chosen = element("span", { class: "chosen" });
  #signal;
  node = element("span", { class: "labels" }, this.#list, this.#chosen);

  /** @param {AbortSignal} signal */
  constructor(signal) {
    this.#signal = signal;
    this.#list.hidden = true;
    this.#load();
  }

  /** Shows the labels of the address. */
  update() {
    const labels = address().values.getAll("label");
    this.#chosen.replaceChildren(...labels.map((label) => {
      const others = labels.filter((other) => other !== label);
      const remove = () => change({ label: others, page: null });
      return element("button", { type: "button", class: "label", "aria-label": `no longer only ${label}`, click: remove }, label.replace(":", ": "), " ×");
    }));
  }

  #add() {
    const label = this.#list.value;
    this.#list.value = "";
    change({ label: [...new Set([...address().values.getAll("label"), label])], page: null });
  }

  async #load() {
    const { labels } = await fetch_json("/v1/labels", { signal: this.#signal });
    const options = labels.map((/** @type {any} */ { key, value, jobs }) => element("option", { value: `${key}:${value}` }, `${key}: ${value} (${jobs})`));
    this.#list.replaceChildren(element("option", { value: "" }, "any label"), ...options);
    this.#list.hidden = labels.length === 0;
  }
}
