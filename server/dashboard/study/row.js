// One field: its name, control, unit, where its value is from, its description and its fault.

import { element } from "../parts/element.js";
import { name_and_unit } from "../parts/units.js";

/** A field. */
export class Row {
  #input;
  #fault;

  /**
   * @param {{name: string, input: HTMLElement, shape: import("./schema.js").Shape, from: string, reset: (() => void) | null}} content
   */
  constructor({ name, input, shape, from, reset }) {
    const { id } = input;
    const [text, unit] = name_and_unit(name);
    const about = shape.description.replaceAll("`", "").replaceAll("\n", " ");
    this.#input = input;
    this.#fault = element("span", { class: "fault", id: `${id}-fault` });
    input.setAttribute("aria-describedby", `${id}-fault ${id}-about`);
    this.node = element("div", { class: "field" },
      element("label", { for: id, title: about }, text), input,
      element("span", { class: "muted unit" }, unit), element("span", { class: "muted small from" }, from),
      reset ? element("button", { type: "button", class: "quiet", "aria-label": `leave ${text} to its default`, title: "leave it to its default", click: reset }, "×") : element("span", { class: "no-reset" }),
      this.#fault, element("span", { class: "about", id: `${id}-about` }, about));
  }

  /** @param {string} fault */
  refuse(fault) {
    this.#fault.textContent = fault;
    this.#input.setAttribute("aria-invalid", "true");
  }
}
