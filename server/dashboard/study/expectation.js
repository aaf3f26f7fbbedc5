// The drawing and the plan of the last specification that was accepted.

import { card, element } from "../parts/element.js";
import { drawing } from "./drawing.js";
import { plan_cards } from "./plan.js";

const OUTDATED = "This is of the last specification without faults, not of what is written now.";

/** Drawing and plan. */
export class Expectation {
  #scene = element("div", { class: "drawing", role: "group", "aria-label": "drawing" });
  #cards = element("div", { class: "cards", role: "group", "aria-label": "plan" });
  #notes = [element("p", { class: "faults", role: "status" }), element("p", { class: "faults" })];
  #is_shown = false;

  constructor() {
    this.drawing = card("To scale", this.#notes[0], this.#scene);
    this.plan = element("div", {}, this.#notes[1], this.#cards);
  }

  /** @param {{spec: any, plan: any}} found */
  show({ spec, plan }) {
    this.#is_shown = true;
    this.#mark(false);
    this.#scene.replaceChildren(...drawing(spec, plan));
    this.#cards.replaceChildren(...plan_cards(plan));
  }

  /** What is written now has no plan. */
  is_outdated() {
    this.#mark(this.#is_shown);
  }

  /** @param {boolean} is_outdated */
  #mark(is_outdated) {
    for (const note of this.#notes) note.textContent = is_outdated ? OUTDATED : "";
    for (const shown of [this.#scene, this.#cards]) {
      shown.classList.toggle("outdated", is_outdated);
      if (is_outdated) shown.setAttribute("aria-disabled", "true");
      else shown.removeAttribute("aria-disabled");
    }
  }
}
