// The dialog that asks for the access token of a service that needs one.

import { element } from "./element.js";

/** The open dialog's answer. @type {Promise<boolean> | null} */
let asked = null;
let dismissed = false;

/**
 * Asks for the token and keeps it for as long as the tab is open; `false` if the reader has dismissed the question. It is not
 * asked again until the reader acts.
 * @returns {Promise<boolean>}
 */
export function ask_for_token() {
  if (dismissed) return Promise.resolve(false);
  asked ??= open_dialog().finally(() => (asked = null));
  return asked;
}

/** @returns {Promise<boolean>} */
function open_dialog() {
  const input = /** @type {HTMLInputElement} */ (element("input", { type: "password", id: "token", autocomplete: "off", required: true }));
  const dialog = /** @type {HTMLDialogElement} */ (element("dialog", { "aria-labelledby": "token-title" },
    element("form", { method: "dialog" },
      element("h2", { id: "token-title" }, "Access token"),
      element("p", {}, "This service answers only with a token."),
      element("label", { for: "token" }, "Token ", input),
      element("p", { class: "actions" },
        element("button", { value: "dismiss", formnovalidate: true }, "Not now"),
        element("button", { value: "use", class: "primary" }, "Use token")))));
  document.body.append(dialog);
  dialog.showModal();
  return new Promise((resolve) => {
    dialog.addEventListener("close", () => {
      const used = dialog.returnValue === "use" && input.value.trim() !== "";
      if (used) sessionStorage.setItem("token", input.value.trim());
      else {
        dismissed = true;
        addEventListener("pointerdown", () => (dismissed = false), { once: true });
        addEventListener("keydown", () => (dismissed = false), { once: true });
      }
      dialog.remove();
      resolve(used);
    });
  });
}
