// Requests to the program that serves this page. The token stands behind "#" in the printed address; it is kept for this
// tab only and removed from the address line.

import { sentence } from "./format.js";

const kTokenKey = "viscard-token";
const kLongest_ms = 10000;  // for a question, or to stop; a fit or a check takes as long as it takes

// A link within the page has a hash too.
function token() {
  const given = location.hash.slice(1);
  if (/^[0-9a-f]{32}$/.test(given)) {
    sessionStorage.setItem(kTokenKey, given);
    history.replaceState(null, "", location.pathname);
  }
  return sessionStorage.getItem(kTokenKey) || "";
}

// What the program answers when it cannot do what was asked; `code` is one short word.
export class Refused extends Error {
  constructor(error) {
    super([error.message, error.hint].map(sentence).join(" ").trim());
    this.code = error.code;
  }
}

// No answer at all: the program has ended, or this computer slept.
export class Unreachable extends Error {}

async function request(method, path, body, longest_ms) {
  const headers = { "X-Viscard-Token": token() };
  const isFile = body instanceof Blob;
  if (body !== undefined) headers["Content-Type"] = isFile ? "application/octet-stream" : "application/json";
  let response, json;
  try {
    response = await fetch(path, { method, headers, body: body === undefined || isFile ? body : JSON.stringify(body),
                                   signal: longest_ms ? AbortSignal.timeout(longest_ms) : undefined });
    json = await response.json();
  } catch {
    throw new Unreachable("viscard does not answer");
  }
  if (!response.ok) throw new Refused(json.error);
  return json;
}

export const ask = (path) => request("GET", path, undefined, kLongest_ms);
// The box below the test, for every request that reads numbers.
const judged = () => (document.getElementById("plausible-off")?.checked ? { plausible: "off" } : {});
export const order = (path, body = {}) => request("POST", path, { ...judged(), ...body });
export const orderSoon = (path, body = {}) => request("POST", path, body, kLongest_ms);
export const drop = (path, file) => request("POST", `${path}?name=${encodeURIComponent(file.name)}`, file);
