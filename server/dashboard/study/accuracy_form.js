// What an accuracy study is asked for.

import { card, element } from "../parts/element.js";

/** Budget of the service unless another is given, and the range that it accepts, processor seconds. */
const BUDGET_S = 180;
const [LEAST_S, MOST_S] = [1, 86_400];

/** The form of an accuracy study. */
export class AccuracyForm {
  #budget = /** @type {HTMLInputElement} */ (element("input", { id: "budget", type: "text", inputmode: "decimal", value: BUDGET_S, "aria-describedby": "budget-fault" }));
  #fault = element("span", { class: "fault", id: "budget-fault", role: "alert" });
  #expected = element("p", { role: "status" });

  /** @param {() => void} changed */
  constructor(changed) {
    this.#budget.addEventListener("input", changed);
    this.node = card("Accuracy study",
      element("p", { class: "muted" }, "The specification at tolerances from 10 % to 0.3 %, and on a grid of contact elements, increments and cycle jumps that leads to a reference: as many of these runs, and as fine, as the budget is expected to suffice for. Its own accuracy is not used."),
      element("p", { class: "field" }, element("label", { for: "budget" }, "budget of processor time"), this.#budget, element("span", { class: "muted unit" }, "s"), this.#fault), this.#expected);
  }

  /** @returns {number} */
  get budget_s() {
    return this.#budget.value.trim() === "" ? NaN : Number(this.#budget.value);
  }

  /** What is typed. */
  get state() {
    return this.#budget.value;
  }

  /** @param {string} typed */
  restore(typed) {
    this.#budget.value = typed;
  }

  get is_complete() {
    return this.budget_s >= LEAST_S && this.budget_s <= MOST_S;
  }

  /** @param {string} expected processor time of the specification as it is; empty while it is not known */
  show(expected) {
    this.#mark(this.is_complete ? "" : `a number from ${LEAST_S} to ${MOST_S}`);
    this.#expected.textContent = expected ? `One run at the accuracy of the specification is expected to take ${expected}.` : "";
  }

  /** @param {string} text */
  #mark(text) {
    this.#fault.textContent = text;
    this.#budget.toggleAttribute("aria-invalid", text !== "");
  }

  /**
   * Shows faults of the service at their fields; returns those that are none of theirs.
   * @param {{pointer: string, detail: string}[]} faults
   */
  mark(faults) {
    const own = faults.filter(({ pointer }) => pointer === "/budget_s");
    if (own.length) this.#mark(own.map(({ detail }) => detail).join("; "));
    return faults.filter((fault) => !own.includes(fault));
  }
}
