// Shared by the pages: DOM elements, requests with the access token, formatted numbers.

/** Creates an element with attributes and children; text is never parsed as markup. */
export function element(name, attributes = {}, ...children) {
  const node = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
  node.append(...children);
  return node;
}

/** Sends a request; prompts for the token if the service requires one. The token is stored for as long as the tab. */
export async function send_request(path, options = {}) {
  const send = () => {
    const token = sessionStorage.getItem("token");
    const headers = { ...options.headers, ...(token ? { authorization: `Bearer ${token}` } : {}) };
    return fetch(path, { ...options, headers });
  };
  let response = await send();
  if (response.status === 401) {
    const token = prompt("Access token of this service");
    if (token) {
      sessionStorage.setItem("token", token.trim());
      response = await send();
    }
  }
  return response;
}

/** Fetches a JSON document; throws the detail of a problem. */
export async function fetch_json(path, options) {
  const response = await send_request(path, options);
  const body = await response.json().catch(() => null);
  if (!response.ok) throw new Error(body?.detail ?? body?.title ?? `${path}: ${response.status}`);
  return body;
}

/** Formats a number with four digits; empty for null. */
export function format_number(value, scale = 1) {
  return value == null ? "" : Number((value * scale).toPrecision(4)).toString();
}

/** Formats a duration: `7 s`, `12 min`, `3.5 h`. */
export function format_duration(seconds) {
  if (seconds < 100) return `${Number(Math.max(seconds, 0).toPrecision(2))} s`;
  if (seconds < 6000) return `${Math.round(seconds / 60)} min`;
  return `${(seconds / 3600).toFixed(1)} h`;
}

/** A link to a file. With a token the browser cannot follow it, so the file is fetched with the token. */
export function download_link(path, name, text) {
  const link = element("a", { href: path, download: name }, text);
  link.addEventListener("click", async (event) => {
    if (!sessionStorage.getItem("token")) return;
    event.preventDefault();
    const url = URL.createObjectURL(await (await send_request(path)).blob());
    element("a", { href: url, download: name }).click();
    setTimeout(() => URL.revokeObjectURL(url), 60_000);
  });
  return link;
}
