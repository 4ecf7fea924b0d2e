// The whole test file as text: tests of every protocol, each with an example.
import { ask, order } from "./api.js";
import { element, make, sentence, showText } from "./format.js";

const kWait_ms = 500;  // after the last key

let saved = "", examples = [], timer = 0, asked = 0, specimenOf = () => null, onCourse = () => {}, onKept = () => {};

const text = () => element("protocol-text").value;
const showKeep = () => { element("protocol-keep").disabled = text() === saved; };

// Shows the expected course of the text; false if it is no test.
async function look() {
  const number = ++asked, specimen = specimenOf();
  showKeep();
  try {
    const answer = specimen ? await order("/api/preflight", { specimen, text: text() }) : null;
    if (number !== asked) return;
    showText(element("protocol-trouble"), answer ? "" : "The expected course needs a specimen; add one first.");
    if (answer) onCourse(answer);
  } catch (error) {
    if (number === asked) showText(element("protocol-trouble"), sentence(error.message));
  }
}

async function open() {
  if (!element("protocol").open) return;
  ({ text: saved, examples } = await ask("/api/test"));
  element("protocol-text").value = saved;
  element("protocol-example").replaceChildren(make("option", { value: "" }, "of this series"),
    ...examples.map((one) => make("option", { value: one.name }, one.name.replace(/^\d+_/, "ramp and hold: "))));
  showText(element("protocol-trouble"), "");
  showKeep();
}

function take() {
  const example = examples.find((one) => one.name === element("protocol-example").value);
  element("protocol-text").value = example ? example.text : saved;
  look();
}

async function keep() {
  try {
    await order("/api/test", { text: text() });
    saved = text();
    showText(element("protocol-trouble"), "");
    await onKept();
  } catch (error) {
    showText(element("protocol-trouble"), sentence(error.message));
  }
  showKeep();
}

// specimen(): the chosen one; onCourse(preflight), onKept().
export function startProtocol(handlers) {
  ({ specimen: specimenOf, onCourse, onKept } = handlers);
  element("protocol").addEventListener("toggle", () => open().catch(() => {}));
  element("protocol-example").addEventListener("change", take);
  element("protocol-text").addEventListener("input", () => { showKeep(); clearTimeout(timer); timer = setTimeout(look, kWait_ms); });
  element("protocol-keep").addEventListener("click", keep);
}
