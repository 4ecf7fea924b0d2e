// The rig file as text, with the drivers that viscard knows and the ports that are present.
import { ask, order } from "./api.js";
import { element, make, sentence, showText } from "./format.js";

const kWait_ms = 500;  // after the last key

let saved = "", mayKeep = false, timer = 0, asked = 0, onKept = () => {};

const text = () => element("setup-text").value;
const plausible = () => (element("plausible-off").checked ? "off" : "on");
const showKeep = (isRight) => { element("setup-keep").disabled = !mayKeep || !isRight || text() === saved; };

async function look() {
  const number = ++asked;
  showKeep(false);
  showText(element("setup-kept"), "");
  try {
    await order("/api/rig", { text: text(), plausible: plausible() });
    if (number !== asked) return;
    showText(element("setup-trouble"), "");
    showKeep(true);
  } catch (error) {
    if (number === asked) showText(element("setup-trouble"), sentence(error.message));
  }
}

// Sets a key of a section of the text; a section that is missing is added at its end.
function setKey(section, key, value) {
  const lines = text().split("\n"), line = `${key} = "${value}"`;
  let at = lines.findIndex((one) => one.trim() === `[${section}]`);
  if (at < 0) at = lines.push("", `[${section}]`) - 1;
  let end = lines.findIndex((one, i) => i > at && /^\s*\[/.test(one));
  if (end < 0) end = lines.length;
  const known = lines.findIndex((one, i) => i > at && i < end && new RegExp(`^\\s*${key}\\s*=`).test(one));
  if (known >= 0) lines[known] = lines[known].replace(/=\s*("[^"]*"|'[^']*')/, () => `= "${value}"`);
  else lines.splice(at + 1, 0, line);
  element("setup-text").value = lines.join("\n");
  look();
}

function fillChoice(id, first, values) {
  element(id).replaceChildren(make("option", { value: "" }, first), ...values.map((one) => make("option", { value: one }, one)));
}

async function open() {
  if (!element("setup").open) return;
  const found = await ask("/api/rig");
  saved = found.text;
  mayKeep = found.is_kept;
  element("setup-text").value = saved;
  for (const [device, drivers] of [["stage", found.stage_drivers], ["load_cell", found.load_cell_drivers]]) {
    fillChoice(`setup-${device}-driver`, "as in the text", drivers);
    fillChoice(`setup-${device}-port`, found.ports.length > 0 ? "as in the text" : "no serial port is present", found.ports);
  }
  showText(element("setup-file"), mayKeep ? found.file
    : "This is the rig of the demonstration. Begin with viscard serve FOLDER --rig FILE to keep one.");
  showText(element("setup-trouble"), "");
  showKeep(false);
}

async function keep() {
  try {
    const { kept_before: before } = await order("/api/rig", { text: text(), based_on: saved, keep: true, plausible: plausible() });
    saved = text();
    showText(element("setup-kept"), before ? `Kept; the text of before is ${before}. Check the rig now.` : "Kept.");
    showText(element("setup-trouble"), "");
    await onKept();
  } catch (error) {
    showText(element("setup-trouble"), sentence(error.message));
  }
  showKeep(false);
}

export function startSetup(handlers) {
  ({ onKept } = handlers);
  element("setup").addEventListener("toggle", () => open().catch(() => {}));
  element("setup-text").addEventListener("input", () => { showKeep(false); clearTimeout(timer); timer = setTimeout(look, kWait_ms); });
  for (const device of ["stage", "load_cell"]) {
    for (const key of ["driver", "port"]) {
      const choice = element(`setup-${device}-${key}`);
      choice.addEventListener("change", () => { if (choice.value) setKey(device, key, choice.value); });
    }
  }
  element("setup-keep").addEventListener("click", keep);
}
