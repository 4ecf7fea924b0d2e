// A card that somebody sent, pasted or dropped: what it means, and its mistakes, marked on its lines.
import { order } from "./api.js";
import { showSame } from "./desk_options.js";
import { element, list, make, sentence, show, showText, significant } from "./format.js";

let targets = [];

export function startCheck(described) {
  targets = described.targets;
  element("check-target").replaceChildren(make("option", { value: "" }, "named in the card"),
    ...targets.map((one) => make("option", { value: one.name }, `${one.code} (${one.name})`)));
  element("check-units").replaceChildren(make("option", { value: "" }, "stated in the card, or SI"),
    ...described.units.map((one) => make("option", { value: one.name, title: one.description }, one.name)));
  for (const id of ["check-target", "check-units", "check-plausible"]) element(id).addEventListener("change", check);
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

// "mu_1_Pa" and 2e5 as "mu_1 200000 Pa".
function valueOf({ name, value }) {
  const isPressure = name.endsWith("_Pa");
  return `${name.replace(/_Pa$/, "")} ${significant(value, 6)}${isPressure ? " Pa" : ""}`;
}

// What the check has read, as the command prints it; of a card without a solid nothing.
function valuesOf(result) {
  const termOf = (term) => `g ${significant(term.g)} at ${significant(term.tau_s)} s`;
  if (result.law !== undefined) {
    return [`Law ${result.law}, ${result.basis}`, ...result.parameters.map(valueOf), ...result.terms.map(termOf),
            result.bulk_modulus_Pa === null ? "incompressible" : `bulk modulus ${significant(result.bulk_modulus_Pa, 6)} Pa`];
  }
  const { material, values } = result, kFewValues = 8;  // a reduction, not a table
  if (!material) return values && values.length <= kFewValues ? values.map(valueOf) : [];
  return [`E0 ${significant(material.E0_Pa, 6)} Pa`, `Poisson ratio ${significant(material.nu, 6)}`,
          material.rho_kg_m3 > 0 ? `density ${significant(material.rho_kg_m3, 6)} kg/m³` : "no density", ...material.terms.map(termOf)];
}

function showResult(result, text) {
  const values = valuesOf(result), { findings } = result;
  const status = element("check-status");
  status.className = findings.some((one) => one.mistake) || !result.agrees ? "alert" : findings.length > 0 ? "note" : "good";
  showText(status, `${sentence(result.verdict)} ${values.length > 0 ? "This is what a solver reads:" : "No values were read."}`);
  list(element("check-meaning"), [...findings.map((one) => sentence(one.text)), `${result.target}, units ${result.units}`, ...values,
                                  ...(result.understood ? [sentence(result.understood.conventions)] : [])]);
  showLines(text, findings.map((one) => one.text));
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
    const target = element("check-target").value, units = element("check-units").value;
    const { command, result } = await order("/api/desk/check", { card: text, ...(target ? { for: target } : {}), ...(units ? { units } : {}),
                                                                 ...(element("check-plausible").checked ? { plausible: "off" } : {}) });
    if (number !== asked) return;
    showResult(result, text);
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
