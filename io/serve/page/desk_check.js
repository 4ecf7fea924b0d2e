// A card that somebody sent, pasted or dropped: what it means, and its mistakes, marked on its lines.
import { order } from "./api.js";
import { showSame } from "./desk_options.js";
import { element, list, make, sentence, show, showText, significant } from "./format.js";

let targets = [];

export function startCheck(described) {
  targets = described.targets;
  element("check-target").replaceChildren(make("option", { value: "" }, "named in the card"),
    ...targets.map((one) => make("option", { value: one.name }, `${one.code} (${one.name})`)));
  element("check-target").addEventListener("change", check);
  element("check-text").addEventListener("input", check);
}

const lineOf = (text) => { const found = /\blines? (\d+)/.exec(text); return found ? Number(found[1]) : 0; };

function showLines(text, remarks) {
  element("check-lines").replaceChildren(...text.split("\n").map((line, i) => {
    const of = remarks.filter((one) => lineOf(one) === i + 1);
    return make("li", { class: of.length > 0 ? "wrong" : undefined }, line || " ",
                ...of.map((one) => make("span", { class: "remark" }, sentence(one))));
  }));
  show(element("check-lines"), remarks.length > 0);
}

function meaningOf(result) {
  const { material } = result;
  if (!material) return [];
  const terms = material.terms.map((term) => `g ${significant(term.g)} at ${significant(term.tau_s)} s`);
  return [`${result.target}, units ${result.units}`, `E0 ${significant(material.E0_Pa, 6)} Pa`, `Poisson ratio ${significant(material.nu, 6)}`,
          `density ${significant(material.rho_kg_m3, 6)} kg/m³`, ...terms];
}

let asked = 0;
async function check() {
  const text = element("check-text").value;
  const number = ++asked;
  const status = element("check-status");
  const tell = (what, kind) => { status.className = kind; showText(status, what); };
  element("check-same").replaceChildren();
  if (text.trim() === "") { tell("", ""); showLines("", []); return list(element("check-meaning"), []); }
  await new Promise((done) => setTimeout(done, 300));  // while somebody types
  if (number !== asked) return;
  try {
    const target = element("check-target").value;
    const { command, result } = await order("/api/desk/check", { card: text, ...(target ? { for: target } : {}) });
    if (number !== asked) return;
    const mistakes = result.findings.filter((one) => one.mistake);
    tell(mistakes.length === 0 ? "No mistake was found in the card itself. This is what it means:"
      : `${mistakes.length} mistake${mistakes.length === 1 ? "" : "s"}. This is what a solver reads:`, mistakes.length === 0 ? "good" : "alert");
    list(element("check-meaning"), [...result.findings.map((one) => sentence(one.text)), ...meaningOf(result), sentence(result.understood.conventions)]);
    showLines(text, result.findings.map((one) => one.text));
    showSame(element("check-same"), `${command}  # CARD: the file of this card`, "", result);
  } catch (error) {
    if (number !== asked) return;
    const what = error.message.replaceAll(/\/dev\/stdin(: )?/g, "");
    tell(sentence(what), "alert");
    list(element("check-meaning"), []);
    showLines(text, [what]);
  }
}

export function checkCard(text) {
  element("check-text").value = text;
  return check();
}
