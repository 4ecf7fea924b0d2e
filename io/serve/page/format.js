// Numbers and small pieces of the page.

export const element = (id) => document.getElementById(id);

// A new element with attributes and children; a text becomes a text node, so nothing is parsed.
export function make(name, attributes = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (value === true) made.setAttribute(key, "");
    else if (value !== false && value !== undefined) made.setAttribute(key, value);
  }
  made.append(...children);
  return made;
}

// As many digits as a person reads: 0.12346 -> "0.1235".
export function significant(value, digits = 4) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  const text = Number(value.toPrecision(digits)).toString();
  return text.replace("-", "−");
}

let named = (text) => text;
// Messages of commands name options; a page that has fields for them names these: naming(text).
export function nameFieldsBy(naming) {
  named = naming;
}

// "the port is busy" -> "The port is busy." A name keeps its letters: "a.csv: holds ...", "tau_1 is ...".
export function sentence(message) {
  if (!message) return "";
  const text = named(message), whole = /[.!?:]$/.test(text) ? text : `${text}.`;
  const isWord = /^\p{Ll}[\p{L}'’]*(?=[\s,;.!?)]*(\s|$))/u.test(whole);
  return isWord ? whole[0].toUpperCase() + whole.slice(1) : whole;
}

// Always as many decimals, without a minus before zero.
export function fixed(value, decimals) {
  const text = value.toFixed(decimals);
  return Number(text) === 0 ? text.replace("-", "") : text.replace("-", "−");
}

export function clock(seconds) {
  const whole = Math.max(0, Math.ceil(seconds));
  const two = (n) => String(n).padStart(2, "0");
  const h = Math.floor(whole / 3600), m = Math.floor(whole / 60) % 60, s = whole % 60;
  return h > 0 ? `${h}:${two(m)}:${two(s)}` : `${m}:${two(s)}`;
}

// "7:30 min", "2:07:30 h"
export const duration = (seconds) => `${clock(seconds)} ${seconds > 3599 ? "h" : "min"}`;

// The unit in which moduli of this size are shown.
export function modulusUnit(Pa) {
  const size = Math.abs(Pa);
  if (size >= 1e9) return { factor: 1e-9, unit: "GPa" };
  if (size >= 1e6) return { factor: 1e-6, unit: "MPa" };
  if (size >= 1e3) return { factor: 1e-3, unit: "kPa" };
  return { factor: 1, unit: "Pa" };
}

export function range(interval, factor = 1, digits = 4) {
  if (!interval) return "–";
  const end = (x, open) => (x === null ? open : significant(x * factor, digits));
  return `${end(interval[0], "unbounded")} to ${end(interval[1], "unbounded")}`;
}

export function show(node, isShown) {
  node.hidden = !isShown;
}

export function showText(node, text) {
  if (node.textContent !== text) node.textContent = text;
  node.hidden = text === "";
}

export function list(node, texts) {
  node.replaceChildren(...texts.map((text) => make("li", {}, text)));
  node.hidden = texts.length === 0;
}

// Offers a text as a file.
export function save(name, text, type = "text/plain") {
  const address = URL.createObjectURL(new Blob([text], { type }));
  const link = make("a", { href: address, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(address), 60000);
}

// A number field: key and factor of the request, label, unit and starting value as shown.
export function numberField(prefix, field) {
  const input = make("input", { id: `${prefix}-${field.key}`, name: field.key, inputmode: "decimal",
                                autocomplete: "off", value: field.value ?? "" });
  return make("label", {}, field.label,
              make("span", { class: "with-unit" }, input, field.unit ? make("span", {}, field.unit) : ""));
}

// Reads "0,13" and "0.13"; NaN for anything else.
export function numberFrom(text) {
  const tidy = text.trim().replace(",", ".").replace("−", "-");
  return tidy === "" ? NaN : Number(tidy);
}

// The switch of a logarithmic axis, by what lies along it.
export const nameLogSwitch = (id, argument) => showText(element(id), argument === "frequency_Hz" ? "log frequency" : "log time");

const kUnits = { N_m: "N/m" };
// "storage_modulus_Pa" -> how it is shown: "storage modulus (MPa)" and its factor. largest: of the values.
export function axisOf(name, largest = 0) {
  const found = /^(.*?)_(1_Pa|N_m|Pa|N|s|Hz|m|V)$/.exec(name);
  if (!found) return { label: name.replaceAll("_", " "), factor: 1, unit: "" };
  const scale = largest > 0 ? modulusUnit(found[2] === "1_Pa" ? 1 / largest : largest) : { factor: 1, unit: "Pa" };
  const { factor, unit } = found[2] === "Pa" ? scale
    : found[2] === "1_Pa" ? { factor: 1 / scale.factor, unit: `1/${scale.unit}` } : { factor: 1, unit: kUnits[found[2]] ?? found[2] };
  return { label: `${found[1].replaceAll("_", " ")} (${unit})`, factor, unit };
}
