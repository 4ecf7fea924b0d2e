// Several tables in one picture: data and fit of each, and their moduli in a table.
import { order } from "./api.js";
import { fitCall, kinds, showSame } from "./desk_options.js";
import { lawOf } from "./desk_rubber.js";
import { element, make, sentence, show, showText } from "./format.js";
import { keyOf, kMostCurves, overlay, showModuliBeside, startOverlay } from "./overlay.js";

// The mixing ratio that a name states: "pdms_1to13.csv", "13-1 b.csv"; otherwise nothing.
function ratioIn(name) {
  const found = /(?:^|[^0-9.])(?:1[ _]?(?:to|-|:)[ _]?(\d{1,2}(?:\.\d)?)|(\d{1,2}(?:\.\d)?)[ _]?(?:to|-|:)[ _]?1)(?![0-9])/i.exec(name);
  return found ? found[1] ?? found[2] : "";
}

let ratios = {};  // by table, as they were typed
let chosen = new Set(), fits = {}, chart = null, asked = 0;
let kept = {}, commands = {};  // options and command of each fit, by table
let optionsOf = () => ({}), onTogether = () => {}, onKind = () => {};

// onKind(table, kind): the kind of a table was chosen; "": the table decides.
export function startCompare(handlers) {
  ({ optionsOf, onTogether, onKind } = handlers);
  element("compare-together").addEventListener("click", () => onTogether(withKind().map((name) => ({ table: name, kind: kindOf(name) }))));
  element("compare-ratios").addEventListener("click", () => onTogether(withRatio().map((name) => ({ table: name, ratio: ratios[name] }))));
  startOverlay("compare", draw);
}

export function showCompareTables(names) {
  chosen = new Set([...chosen].filter((name) => names.includes(name)));
  element("compare-tables").replaceChildren(...names.map((name) => {
    const box = make("input", { type: "checkbox" });
    box.checked = chosen.has(name);
    box.addEventListener("change", () => {
      if (box.checked && chosen.size >= kMostCurves) { box.checked = false; return tell(`At most ${kMostCurves} tables are compared.`); }
      if (box.checked) chosen.add(name); else chosen.delete(name);
      compare();
    });
    ratios[name] ??= ratioIn(name);
    const ratio = make("input", { "aria-label": `Mixing ratio of ${name}`, placeholder: "ratio", title: "parts of base to one of curing agent",
                                  inputmode: "decimal", autocomplete: "off", size: "4", value: ratios[name] });
    ratio.addEventListener("input", () => {
      ratios[name] = ratio.value.trim().replace(",", ".").replace(/\s*:\s*1$/, "");  // 13:1 is 13
      const isWrong = ratios[name] !== "" && !(Number(ratios[name]) > 0);
      ratio.setAttribute("aria-invalid", String(isWrong));
      tell(isWrong ? `${name}: "${ratio.value}" is no mixing ratio; it is left out of a fit by ratio.` : "");
      showButtons();
    });
    const kind = make("select", { "aria-label": `Kind of test of ${name}` }, make("option", { value: "" }, "kind"),
                      ...kinds().map((one) => make("option", { value: one }, one)));
    kind.dataset.table = name;
    kind.addEventListener("change", () => onKind(name, kind.value).catch((error) => tell(sentence(error.message), "alert")));
    return make("div", { class: "specimen" }, make("label", { class: "switch" }, box, name), kind, ratio);
  }));
  showKinds();
}

// As it was chosen, or as the table was read; a table that cannot be fitted alone may have one too.
const kindOf = (name) => kept[name]?.kind ?? fits[name]?.kind;

function showKinds() {
  for (const select of element("compare-tables").querySelectorAll("select")) {
    const name = select.dataset.table, own = fits[name]?.kind;
    select.options[0].textContent = own && !kept[name]?.kind ? own : "kind";
    select.value = kept[name]?.kind ?? "";
    show(select, chosen.has(name));
  }
}

export function alsoCompare(name) {
  if (chosen.size < kMostCurves) chosen.add(name);
}

const tell = (text, kind = "note") => { element("compare-status").className = kind; showText(element("compare-status"), text); };

export async function compare() {
  const number = ++asked;
  tell("");
  element("compare-same").replaceChildren();
  for (const name of chosen) {
    const request = { table: name, ...(optionsOf(name) ? { options: optionsOf(name) } : {}) };
    try {
      const answer = await order("/api/desk/fit", request);
      if (number !== asked) return;
      ({ result: fits[name], options: kept[name], command: commands[name] } = answer);
    } catch (error) {
      if (number !== asked) return;
      fits[name] = null;
      tell(error.message.startsWith(name) ? error.message : `${name}: ${error.message}`, "alert");
      kept[name] = request.options ?? (await order("/api/desk/table", { table: name }).catch(() => null))?.options ?? {};
    }
    if (number !== asked) return;
  }
  showKinds();
  draw();
  showRows();
  const names = fitted();
  if (names.length === 0) return;
  const doubtful = names.filter((name) => fits[name].trustworthy === false);
  if (doubtful.length > 0) tell(`${element("compare-status").textContent} Do not trust the fit of ${doubtful.join(", ")} before you have read its flags.`.trim(), "alert");
  const calls = names.map((name) => fitCall(name, kept[name])).join(",\n        ");
  showSame(element("compare-same"), names.map((name) => commands[name]).join("\n"), `import viscard\nfits = [${calls}]`,
           { input_files: names.flatMap((name) => fits[name].input_files ?? []) });
}

const fitted = () => [...chosen].filter((name) => fits[name]);
const withKind = () => [...chosen].filter(kindOf);
const withRatio = () => fitted().filter((name) => Number(ratios[name]) > 0);

function showButtons() {
  element("compare-together").disabled = withKind().length < 2;
  element("compare-ratios").disabled = withRatio().length < 3;  // fewer show no law
}

// Those without a curve have no key. Of a law of rubber the moduli at rest; its parameters are not those of others.
const drawn = () => fitted().filter((name) => fits[name].curves);
function showRows() {
  showModuliBeside(element("compare-moduli"), fitted().map((name) => ({ name, key: fits[name].curves && keyOf(drawn().indexOf(name)),
                                                                       fit: fits[name].laws ? { ...lawOf(fits[name]), terms: [] } : fits[name] })));
}

function draw() {
  if (chart) chart.close();
  chart = null;
  const names = drawn();
  showButtons();
  show(element("compare-body"), fitted().length > 0);
  show(element("compare-chart"), names.length > 0);
  if (names.length === 0) return;
  const kinds = new Set(names.map((name) => `${fits[name].curves.argument} ${fits[name].curves.columns[0].name}`));
  if (kinds.size > 1 && !element("compare-relative").checked) tell("These tables are of different quantities; relative values can be compared.");
  const { argument, columns: [quantity] } = fits[names[0]].curves;
  chart = overlay("compare", names.map((name) => {
    const { values, columns: [{ measured, fitted: ofFit }] } = fits[name].curves;
    return { name, x: values, measured, fit_x: values, fitted: ofFit };
  }), { argument, quantity: quantity.name, file: () => "comparison" });
}
