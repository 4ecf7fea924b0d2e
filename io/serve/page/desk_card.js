// The card of a solver: target and units from lists, the text, what it cannot take, download.
import { element, list, make, sentence, show, showText } from "./format.js";

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
  for (const id of ["card-ratio", "card-density"]) element(id).addEventListener("change", () => onChoice());
  for (const id of ["target", "units", "approximate"]) {
    element(id).addEventListener("change", () => {
      localStorage.setItem("viscard-target", element("target").value);
      localStorage.setItem("viscard-units", unitsNow());
      onChoice();
    });
  }
  element("download").addEventListener("click", download);
}

const unitsNow = () => document.querySelector("input[name='units']:checked").value;

// ratio: the first of a fit over mixing ratios; undefined: the fit is of one material.
export function askRatio(ratio) {
  show(element("card-ratio-field"), ratio !== undefined);
  element("card-ratio").value = ratio ?? "";
}

// A law of rubber has no density of its own.
export function askDensity(isAsked) {
  show(element("card-density-field"), isAsked);
  if (!isAsked) element("card-density").value = "";
}

export function chosenCard() {
  const typed = (id) => element(id).value.trim().replace(",", ".");
  const ratio = typed("card-ratio"), density = typed("card-density");
  return { for: element("target").value, units: unitsNow(), ...(ratio ? { ratio } : {}), ...(density ? { density } : {}),
           ...(element("approximate").checked ? { approximate: true } : {}) };
}

const targetNow = () => choices.targets.find((one) => one.name === element("target").value);

function save(name, text) {
  const address = URL.createObjectURL(new Blob([text], { type: "text/plain" }));
  const link = make("a", { href: address, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(address), 60000);
}

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
