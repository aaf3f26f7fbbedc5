// What both pages use: elements without markup in strings, and requests that show the token where one is needed.

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
