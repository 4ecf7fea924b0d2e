// Requests to viscard serve. The token stands behind "#" in the printed address; it is kept for this
// tab only and removed from the address line.

const kTokenKey = "viscard-token";

function token() {
  const given = location.hash.slice(1);
  if (given) {
    sessionStorage.setItem(kTokenKey, given);
    history.replaceState(null, "", location.pathname);
  }
  return sessionStorage.getItem(kTokenKey) || "";
}

// What viscard serve answers when it cannot do what was asked; `code` is one short word.
export class Refused extends Error {
  constructor(error) {
    super(error.hint ? `${error.message}. ${error.hint}` : error.message);
    this.code = error.code;
  }
}

// No answer at all: the program has ended, or this computer slept.
export class Unreachable extends Error {}

async function request(method, path, body) {
  const headers = { "X-Viscard-Token": token() };
  if (body !== undefined) headers["Content-Type"] = "application/json";
  let response, json;
  try {
    response = await fetch(path, { method, headers, body: body === undefined ? undefined : JSON.stringify(body) });
    json = await response.json();
  } catch {
    throw new Unreachable("viscard serve does not answer");
  }
  if (!response.ok) throw new Refused(json.error);
  return json;
}

export const ask = (path) => request("GET", path);
export const order = (path, body = {}) => request("POST", path, body);
