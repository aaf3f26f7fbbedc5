// What the pages use: elements without markup in strings, requests that show the token where one is needed, and figures.

/** An element with attributes, text and children; text is never read as markup. */
export function element(name, attributes = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...children);
  return made;
}

/** A request; asks for the token once if the service wants one. The token lives as long as the tab. */
export async function ask(path, options = {}) {
  const send = () => {
    const token = sessionStorage.getItem("token");
    const headers = { ...options.headers, ...(token ? { authorization: `Bearer ${token}` } : {}) };
    return fetch(path, { ...options, headers });
  };
  let answer = await send();
  if (answer.status === 401) {
    const token = prompt("This service asks for its access token");
    if (token) {
      sessionStorage.setItem("token", token.trim());
      answer = await send();
    }
  }
  return answer;
}

/** A JSON document, or an error with the problem's own words. */
export async function document_at(path, options) {
  const answer = await ask(path, options);
  const body = await answer.json().catch(() => null);
  if (!answer.ok) throw new Error(body?.detail ?? body?.title ?? `${path}: ${answer.status}`);
  return body;
}

/** A number with four digits; nothing for none. */
export function figure(value, scale = 1) {
  return value == null ? "" : Number((value * scale).toPrecision(4)).toString();
}

/** A span of time in words: `7 s`, `12 min`, `3.5 h`. */
export function span_of(seconds) {
  if (seconds < 100) return `${Number(Math.max(seconds, 0).toPrecision(2))} s`;
  if (seconds < 6000) return `${Math.round(seconds / 60)} min`;
  return `${(seconds / 3600).toFixed(1)} h`;
}

/** A link to a file. Where a token is needed the browser cannot follow it, so the file is fetched with the token. */
export function download_link(path, name, words) {
  const link = element("a", { href: path, download: name }, words);
  link.addEventListener("click", async (event) => {
    if (!sessionStorage.getItem("token")) return;
    event.preventDefault();
    const address = URL.createObjectURL(await (await ask(path)).blob());
    element("a", { href: address, download: name }).click();
    setTimeout(() => URL.revokeObjectURL(address), 60_000);
  });
  return link;
}
