// Puts the parts of the desk together. All that is made lies in the folder; the page holds what is chosen for each table.
import { ask, drop, order, Unreachable } from "./api.js";
import { cardCall, chosenCard, forgetCard, showCard, showCardFields, showCardState, startCard } from "./desk_card.js";
import { checkCard, startCheck } from "./desk_check.js";
import { alsoCompare, compare, showCompareTables, startCompare } from "./desk_compare.js";
import { forgetOrders, redrawFit, showFit, showFitState, shownRange } from "./desk_fit.js";
import { placeIsotherms, showEarlier, showIsotherms, startIsotherms, undoMove } from "./desk_isotherms.js";
import { isRubberKind, pythonKeywords, pythonOf, showFields, showSame, startOptions } from "./desk_options.js";
import { chosenPrediction, predictKeywords, showOtherTables, showPrediction, showPredictState, startPredict } from "./desk_predict.js";
import { redrawRatios, showRatios } from "./desk_ratios.js";
import { showReportTables, startReport } from "./desk_report.js";
import { showRubber } from "./desk_rubber.js";
import { showScenes, startScene } from "./desk_scene.js";
import { showTable, showTableError, startTable } from "./desk_table.js";
import { element, make, sentence, show, showText } from "./format.js";

const kSteps = ["table", "fit", "card", "predict", "compare", "check", "scene", "report"];
const kLook_ms = 3000;

let state = null, table = null, choices = {}, view = "table", asked = 0;
let together = {};  // tests that are fitted together, by the name that stands for them in the list of tables
let before = [];  // options of this table, for undo
const chosen = () => choices[table] ?? {};

function showLink(error) {
  const isLost = error instanceof Unreachable || (error && error.code === "wrong-token");
  showText(element("link"), isLost ? "not connected" : "connected");
  showText(element("lost"), !error ? "" : error instanceof Unreachable
    ? `${sentence(error.message)} If it has ended, start viscard desk again and open the address that it prints.`
    : sentence(error.message));
}

// Does one thing; what was asked before it is forgotten, and so are the lines of a view that do it.
async function latest(what, work, onError) {
  const number = ++asked;
  element(`${what}-same`).replaceChildren();
  const isNow = () => number === asked;
  try {
    await work(isNow);
    showLink(null);
  } catch (error) {
    if (!isNow()) return;
    if (error instanceof Unreachable || error.code === "wrong-token") showLink(error);
    else onError(sentence(error.message));
  }
}

function showTables() {
  const names = state.tables.map((one) => one.name);
  together = Object.fromEntries(Object.entries(together).filter(([, tests]) => tests.every((test) => names.includes(test.table))));
  element("tables").replaceChildren(...[...names, ...Object.keys(together)].map((name) => {
    const button = make("button", { type: "button", "aria-current": name === table ? "true" : undefined }, name);
    button.addEventListener("click", () => open(name));
    return make("li", {}, button);
  }));
  show(element("no-tables"), state.tables.length === 0);
  showText(element("folder-trouble"), sentence(state.folder_trouble));
  element("folder").textContent = state.folder;
  showCompareTables(names);
  showOtherTables(names);
  showReportTables(names, together[table] ? null : table);
  showScenes(state.scenes);
}

async function refresh() {
  const before = JSON.stringify(state);
  state = await ask("/api/desk");
  if (JSON.stringify(state) !== before) showTables();
}

function showView(name) {
  view = name;
  for (const step of kSteps) {
    const isThis = step === name;
    show(element(`view-${step}`), isThis);
    element(`tab-${step}`).setAttribute("aria-selected", String(isThis));
    element(`tab-${step}`).tabIndex = isThis ? 0 : -1;
  }
  if (name === "fit") { redrawFit(); redrawRatios(); }
  if (name === "card") makeCard();
  if (name === "predict") predict();
  if (name === "compare") compare();
}

// Of a table that is opened for the first time, the options that are kept beside it hold.
function request() {
  const what = together[table] ? { tests: together[table] } : { table };
  return choices[table] === undefined ? what : { ...what, options: chosen() };
}

const isByRatio = () => together[table]?.[0].ratio !== undefined;
const isRubber = () => (together[table] ? together[table].some((test) => isRubberKind(test.kind)) : isRubberKind(chosen().kind));

// What viscard.fit() of Python takes: a file, specimens, or tests by kind; and its keywords.
const fitKeywords = () => (isByRatio() ? { joint: true, ratio: together[table].map((test) => Number(test.ratio)), ...chosen() } : chosen());
function pythonData() {
  if (!together[table]) return table;
  if (isByRatio()) return together[table].map((test) => test.table);
  const byKind = {};
  for (const test of together[table]) (byKind[test.kind] ??= []).push(test.table);
  return byKind;
}

async function readTable(isNow) {
  if (together[table]) {
    showTableError("");
    showIsotherms([], {});
    return showFields({ kind: "", modulus_kind: "tension" }, chosen());
  }
  const answer = await order("/api/desk/table", request());
  if (!isNow()) return;
  choices[table] = answer.options;
  if (answer.result) showTable(answer.result, chosen().column ?? []);
  else showTableError(answer.trouble);
  showFields(answer.result ?? { kind: "", modulus_kind: "" }, chosen());
  showIsotherms(answer.result?.isotherms ?? [], chosen());
}

function readAndFit() {
  showFitState("Fitting …", "");
  return latest("fit", async (isNow) => {
    await readTable(isNow);
    if (!isNow()) return;
    showUndo();
    const answer = await order("/api/desk/fit", request());
    if (!isNow()) return;
    const { command, result, options } = answer;
    choices[table] = options;
    if (isByRatio()) showRatios(result);
    else if (result.laws) showRubber(answer);
    else showFit(result, chosen().terms, (terms) => setOption("terms", terms));
    placeIsotherms(result);
    showSame(element("fit-same"), command, pythonOf(pythonData(), fitKeywords()), result);
    if (view === "card") makeCard();
    if (view === "predict") predict();
    if (view === "compare") compare();
  }, (text) => showFitState(text, "alert"));
}

function makeCard() {
  if (table === null) return showCardState("Choose a table first.", "note");
  showCardState("Writing …", "");
  showCardFields(isRubber() ? "rubber" : isByRatio() ? "ratios" : "linear");
  return latest("card", async (isNow) => {
    const answer = await order("/api/desk/card", { ...request(), card: chosenCard() });
    if (!isNow()) return;
    showCard(answer);
    const call = cardCall(isRubber() ? "result" : "result.material", answer.options, pythonKeywords);
    showSame(element("card-same"), `${answer.fit_command}\n${answer.command}`,
             call && `${pythonOf(pythonData(), fitKeywords())}\n${call}`, answer.result);
  }, (text) => showCardState(text, "alert"));
}

function predict() {
  if (table === null) return showPredictState("Choose a table first.", "note");
  const gives = !isByRatio() && !isRubber();  // otherwise the program states why not
  show(element("predict-form"), gives);
  showPredictState("Predicting …", "");
  return latest("predict", async (isNow) => {
    const answer = await order("/api/desk/predict", { ...request(), ...chosenPrediction() });
    if (!isNow()) return;
    showPrediction(answer);
    showSame(element("predict-same"), `${answer.fit_command}\n${answer.command}`,
             `${pythonOf(pythonData(), chosen())}\nprint(viscard.predict(result.material${predictKeywords(answer.options)}))`, answer.result);
  }, (text) => showPredictState(text, gives ? "alert" : "note"));
}

// Options that are set to undefined are taken away.
function setOptions(changes) {
  before.push({ ...chosen() });
  choices[table] = Object.fromEntries(Object.entries({ ...chosen(), ...changes }).filter(([, value]) => value !== undefined));
  if (!("terms" in changes)) forgetOrders();
  return readAndFit();
}
const setOption = (name, value) => setOptions({ [name]: value });

// Of any table, as the field Kind does of the open one.
async function setKind(name, kind) {
  if (name === table) {
    await setOption("kind", kind || undefined);
    return compare();
  }
  const kept = choices[name] ?? (await order("/api/desk/table", { table: name })).options;
  const options = Object.fromEntries(Object.entries({ ...kept, kind }).filter(([, value]) => value !== ""));
  choices[name] = (await order("/api/desk/table", { table: name, options })).options;
  return compare();
}

function showUndo() {
  element("undo").disabled = before.length === 0;
  showEarlier(before.length > 0);
  element("fit-all").disabled = chosen().from === undefined && chosen().to === undefined;
}

function undo() {
  if (view === "fit" && undoMove()) return;
  if (before.length === 0) return;
  choices[table] = before.pop();
  forgetOrders();
  readAndFit();
}

function open(name) {
  table = name;
  before = [];
  forgetOrders();
  showIsotherms([], {});
  if (!together[name]) alsoCompare(name);
  forgetCard(together[name]?.[0].ratio);
  showTables();
  element("table-name").textContent = name;
  if (view !== "table" && view !== "fit") showView("fit");
  return readAndFit();
}

function openTogether(tests) {
  const name = tests.map((test) => (test.ratio ? `${test.table} (${test.ratio}:1)` : test.table)).join(" + ");
  together[name] = tests;
  delete choices[name];
  showView("fit");
  return open(name);
}

async function take(files) {
  showText(element("drop-error"), "");
  if (view === "check" && files.length === 1) return checkCard(await files[0].text());
  let last = null;
  for (const file of files) {
    try {
      if (file.size > state.largest_drop_B) throw new Error(`${file.name} is larger than ${state.largest_drop_B >> 20} MiB`);
      last = (await drop("/api/desk/drop", file)).name;
    } catch (error) {
      showText(element("drop-error"), sentence(error.message));
    }
  }
  await refresh();
  if (last !== null) {
    showView("table");
    await open(last);
  }
}

function startDrop() {
  const zone = element("drop"), input = element("file");
  input.addEventListener("change", () => { const files = [...input.files]; input.value = ""; take(files); });
  for (const event of ["dragenter", "dragover"]) {
    addEventListener(event, (e) => { e.preventDefault(); zone.classList.add("over"); });
  }
  addEventListener("dragleave", (e) => { if (!e.relatedTarget) zone.classList.remove("over"); });
  addEventListener("drop", (e) => { e.preventDefault(); zone.classList.remove("over"); take([...e.dataTransfer.files]); });
}

function startTabs() {
  for (const step of kSteps) element(`tab-${step}`).addEventListener("click", () => showView(step));
  document.querySelector(".tabs").addEventListener("keydown", (event) => {
    const move = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!move) return;
    const next = kSteps[(kSteps.indexOf(view) + move + kSteps.length) % kSteps.length];
    showView(next);
    element(`tab-${next}`).focus();
  });
}

async function start() {
  startDrop();
  startTabs();
  const described = await ask("/api/desk/choices");
  startOptions(described, setOption);
  startIsotherms({ onFit: setOptions, onUndo: undo });
  startCard(described, makeCard);
  startTable(described, (words) => setOption("column", words));
  startPredict(described, predict);
  startCompare({ optionsOf: (name) => choices[name], onTogether: openTogether, onKind: setKind });
  startCheck(described);
  startScene(described, refresh);
  startReport();
  element("undo").addEventListener("click", undo);
  element("fit-range").addEventListener("click", () => { const [from, to] = shownRange(); setOptions({ from, to }); });
  element("fit-all").addEventListener("click", () => setOptions({ from: undefined, to: undefined }));
  addEventListener("keydown", (event) => {
    const isTyping = event.target.matches("input:not([type=checkbox]):not([type=radio]), textarea");
    if (event.key === "z" && (event.ctrlKey || event.metaKey) && !isTyping) { event.preventDefault(); undo(); }
  });
  await refresh();
  showLink(null);
  setInterval(() => refresh().then(() => showLink(null)).catch(showLink), kLook_ms);
}

start().catch(showLink);
