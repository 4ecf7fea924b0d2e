// The card of a solver: target and units from lists, its options as the program describes them, the text, what it cannot
// take, download.
import { fieldOf } from "./desk_options.js";
import { element, list, make, save, sentence, show, showText } from "./format.js";

// Fields beside the solver; all others are behind "All options of a card".
const kBeside = ["ratio", "extrapolate", "density", "approximate", "accept-flags"];
// Options of a fit over mixing ratios, and of a law of rubber, alone; and those that a law of rubber does not take.
const kOfRatios = ["ratio", "extrapolate"], kOfRubber = ["density", "bulk-modulus"];
const kOfLinear = ["terms", "at-temperature", "bound", "band", "clamp-nu"];

let chosen = {}, shownOf = "";  // options of this table, and what the fields are of
let card = null, choices = null, stem = "material", onChoice = () => {};

const saved = (key, otherwise) => localStorage.getItem(`viscard-${key}`) ?? otherwise;

export function startCard(described, handler) {
  choices = described;
  onChoice = handler;
  element("target").replaceChildren(...choices.targets.map((one) => make("option", { value: one.name }, `${one.code} (${one.name})`)));
  // Buttons, because all of them have room: one click less than a list.
  element("units").append(...choices.units.map((one) => make("label", { title: one.description },
    make("input", { type: "radio", name: "units", value: one.name, checked: one.name === saved("units", "SI") }), one.name)));
  element("target").value = saved("target", choices.targets[0].name);
  for (const id of ["target", "units"]) {
    element(id).addEventListener("change", () => {
      localStorage.setItem("viscard-target", element("target").value);
      localStorage.setItem("viscard-units", unitsNow());
      onChoice();
    });
  }
  element("download").addEventListener("click", download);
}

const unitsNow = () => document.querySelector("input[name='units']:checked").value;

const isOf = (what, { name }) => (kOfRatios.includes(name) ? what === "ratios" : kOfRubber.includes(name) ? what === "rubber"
  : what !== "rubber" || !kOfLinear.includes(name));

// A number with a comma is one with a point; a band has two numbers.
const tidy = (option, value) => (typeof value === "string" && option.type !== "text" ? value.replace(",", ".") : value);

function showFields() {
  const field = (option) => fieldOf(option, chosen, "card", (value) => {
    chosen = Object.fromEntries(Object.entries({ ...chosen, [option.name]: tidy(option, value) }).filter(([, one]) => one !== undefined));
    onChoice();
  }, "not chosen");
  const own = choices.card.filter((option) => isOf(shownOf, option));
  element("card-fields").replaceChildren(...kBeside.map((name) => own.find((one) => one.name === name)).filter(Boolean).map(field));
  element("card-more-fields").replaceChildren(...own.filter(({ name }) => !kBeside.includes(name)).map(field));
}

// what: "linear", "ratios" or "rubber".
export function showCardFields(what) {
  if (shownOf === what) return;
  shownOf = what;
  showFields();
}

// What was chosen for one table, such as to accept its flags, is not for another. ratio: the first of a fit over mixing
// ratios; undefined: the fit is of one material.
export function forgetCard(ratio) {
  chosen = ratio === undefined ? {} : { ratio };
  shownOf = "";
}

export function chosenCard() {
  const own = choices.card.filter((option) => chosen[option.name] !== undefined && isOf(shownOf, option));
  return { for: element("target").value, units: unitsNow(), ...Object.fromEntries(own.map(({ name }) => [name, chosen[name]])) };
}

// The line of Python for the options as its keywords; of a band it has none. material: "result.material", or "result".
export function cardCall(material, options, keywords) {
  if ("band" in options) return "";
  const { ratio, extrapolate, ...more } = options;
  const of = ratio === undefined ? material : `${material}(${Number(ratio)}${extrapolate ? ", may_extrapolate=True" : ""})`;
  return `print(${of}.card(${JSON.stringify(element("target").value)}, ${JSON.stringify(unitsNow())}${keywords(more, choices.card)}))`;
}

const targetNow = () => choices.targets.find((one) => one.name === element("target").value);

function download() {
  save(stem + targetNow().extension, card.card);
  for (const file of card.companions ?? []) save(stem + file.suffix, file.text);
}

export function showCardState(text, kind) {
  card = null;
  element("download").disabled = true;
  show(element("card-text"), false);
  list(element("card-losses"), []);
  element("card-advice").textContent = "";
  const status = element("card-status");
  status.className = kind;
  showText(status, text);
}

export function showCard(answer) {
  card = answer.result;
  stem = answer.material.replace(/\.json$/, "");
  const status = element("card-status");
  status.className = "good";
  if (card.law) showText(status, `Written of the law ${card.law} in ${answer.material}.`);
  else showText(status, `Written of the material in ${answer.material} and read back: ${card.n_terms} term${card.n_terms === 1 ? "" : "s"}, `
    + (card.largest_difference === 0 ? "E(t) is the same." : `E(t) within ${card.largest_difference.toExponential(1)} of it.`));
  element("card-advice").textContent = card.law ? "" : sentence(targetNow().advice);  // which is of linear materials
  list(element("card-losses"), [...card.warnings, ...(card.fidelity ?? []).filter((one) => one.mapping !== "exact")
    .map((one) => `${one.item} ${one.mapping}: ${one.text}`)].map(sentence));
  element("card-text").textContent = card.card;
  show(element("card-text"), true);
  element("download").disabled = false;
}
