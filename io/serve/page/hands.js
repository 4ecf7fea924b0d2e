// Hands on the bench between runs: moves of the stage, and weights on the load cell.
import { ask, order, orderSoon } from "./api.js";
import { Chart } from "./charts.js";
import { element, fixed, list, make, numberFrom, sentence, show, showText, significant } from "./format.js";

const kWatch_ms = 120;  // the stage stops when nobody has asked for half a second
const kSteps_um = [10, 50, 200, 1000];
const kLift_mm = 2;

let rig = null, isEmulated = true, isMoving = false, isBusy = false, position_m = null, zero_m = 0, onDone = () => {};

// --- the stage ------------------------------------------------------------------------------------

const isRunning = () => document.body.classList.contains("running");
const stepNow_um = () => Number(document.querySelector("input[name='step']:checked").value);

function showButtons() {
  const isFree = Boolean(rig) && !rig.trouble && !isBusy && !isMoving;
  for (const id of ["jog-toward", "jog-away", "jog-lift", "jog-home", "weigh"]) element(id).disabled = !isFree;
  element("jog-stop").disabled = !isMoving;
  element("jog-zero").disabled = position_m === null || !isFree;
  element("force-zero").disabled = !isFree;
}

function showPosition() {
  element("jog-position").textContent = position_m === null ? "–"
    : `${fixed(position_m * 1e3, 3)} mm${zero_m === 0 ? "" : `, ${fixed((position_m - zero_m) * 1e3, 3)} mm from your zero`}`;
}

function tell(text, kind) {
  element("jog-status").className = kind;
  showText(element("jog-status"), text);
}

function showEnd({ moved, trouble, position_m: now_m }) {
  position_m = now_m;
  showPosition();
  if (trouble) {
    element("jog-force").textContent = "–";
    return tell(sentence(trouble), "alert");
  }
  if (moved.zero_m !== null) zero_m = moved.zero_m;
  showPosition();
  element("jog-force").textContent = `${fixed(moved.force_after_N, 3)} N`;
  const note = moved.note ? ` ${sentence(moved.note)}` : "";
  const way = `${significant(Math.abs(moved.to_m - moved.from_m) * 1e6, 4)} µm`;
  if (moved.is_stopped_by_force) tell(`The force stopped the stage after ${way}.${note}`, "note");
  else if (moved.note) tell(`Moved by ${way}.${note}`, "note");
  else tell(moved.to_m === moved.from_m ? "The stage stands." : `Moved by ${way}.`, "good");
}

async function move(how, way_mm) {
  if (isMoving || isRunning()) return;
  const limit_N = numberFrom(element("jog-limit").value);
  if (Number.isNaN(limit_N)) return tell("The limit of force is not a number.", "alert");
  isMoving = true;
  showButtons();
  tell("Moving …", "");
  element("jog-stop").focus();
  try {
    let now = await order("/api/move", { how, ...(how === "home" ? {} : { way_m: way_mm * 1e-3, limit_N }) });
    while (now.is_moving) {
      await new Promise((done) => setTimeout(done, kWatch_ms));
      now = await ask("/api/move");
      element("jog-force").textContent = `${now.force_N < 0 ? "" : "+"}${fixed(now.force_N, 3)} N since the move began`;
    }
    showEnd(now);
  } catch (error) {
    tell(sentence(error.message), "alert");
  }
  isMoving = false;
  showButtons();
  onDone();
}

async function stopMove() {
  try {
    await orderSoon("/api/run/stop", { how: "gently" });
  } catch (error) {
    tell(`${sentence(error.message)} Use the emergency stop of the stage if it still moves.`, "alert");
  }
}

async function zero(work) {
  isBusy = true;
  showButtons();
  try {
    await work();
  } catch (error) {
    tell(sentence(error.message), "alert");
  }
  isBusy = false;
  showButtons();
}

// The rig file keeps the zero of a stage; an emulated one has it as long as this page.
const zeroPosition = () => zero(async () => {
  zero_m = isEmulated ? position_m : (await order("/api/zero", { what: "position" })).zero_m;
  showPosition();
  tell("Positions count from here.", "good");
});

const zeroForce = () => zero(async () => {
  const zeroed = await order("/api/zero", { what: "force" });
  element("jog-force").textContent = `${fixed(zeroed.force_after_N, 3)} N`;
  tell(`The instrument was zeroed; it read ${fixed(zeroed.force_before_N, 3)} N before.`, "good");
});

function startStage() {
  element("jog-steps").append(...kSteps_um.map((um, i) => make("label", {},
    make("input", { type: "radio", name: "step", value: um, checked: i === 0 }), um < 1000 ? `${um} µm` : `${um / 1000} mm`)));
  element("jog-toward").addEventListener("click", () => move("toward", stepNow_um() * 1e-3));
  element("jog-away").addEventListener("click", () => move("away", stepNow_um() * 1e-3));
  element("jog-lift").addEventListener("click", () => move("away", kLift_mm));
  element("jog-home").addEventListener("click", () => move("home", 0));
  element("jog-stop").addEventListener("click", stopMove);
  element("jog-zero").addEventListener("click", zeroPosition);
  element("force-zero").addEventListener("click", zeroForce);
  document.addEventListener("keydown", (event) => { if (event.key === "Escape" && isMoving) stopMove(); });
}

// --- the load cell --------------------------------------------------------------------------------

let points = [];
const chart = new Chart(element("weigh-chart"), {
  labels: ["mass", "reading"], colors: ["force"], points: ["reading"],
  titles: { xlabel: "mass (g)", ylabel: "reading" },
});

// Up and down with one weight at a time, as often as there are series.
function sequence_g() {
  const masses = element("weigh-masses").value.split(/[;,\s]+/).filter(Boolean).map(numberFrom);
  if (masses.length === 0 || masses.some((mass) => !(mass > 0))) return null;
  const up = [...new Set(masses)].sort((a, b) => a - b), down = [...up.slice(0, -1).reverse(), 0];
  const n = Math.min(20, Math.max(1, Math.round(numberFrom(element("weigh-series").value)) || 1));
  return [0, ...Array.from({ length: n }, () => [...up, ...down]).flat()];
}

function tellWeighing(text, kind) {
  element("weigh-status").className = kind;
  showText(element("weigh-status"), text);
}

function showNext() {
  const sequence = sequence_g(), next = sequence ? sequence[points.length] : undefined;
  const what = !sequence ? "Weights are numbers in g, such as 20, 50, 100, 200." : next === undefined ? "All weights are done."
    : next === 0 ? "Take everything off the load cell." : `Put ${significant(next, 6)} g on the load cell and nothing else.`;
  element("weigh-next").textContent = what;
  const isDone = Boolean(sequence) && next === undefined;
  element("weigh").textContent = `Weigh (${points.length} of ${sequence ? sequence.length : "–"})`;
  show(element("weigh"), Boolean(sequence) && !isDone);
  element("weigh-back").disabled = points.length === 0 || isBusy;
  element("weigh-make").disabled = !isDone || isBusy;
  for (const id of ["weigh-masses", "weigh-series"]) element(id).disabled = points.length > 0;
  show(element("weigh-chart"), points.length > 1);
  chart.show(points.map((point) => [point.mass_kg * 1e3, point.reading]).sort((a, b) => a[0] - b[0]));
  showButtons();
}

async function busy(work) {
  isBusy = true;
  showNext();
  try {
    await work();
  } catch (error) {
    tellWeighing(sentence(error.message), "alert");
  }
  isBusy = false;
  showNext();
}

const weigh = () => busy(async () => {
  const sequence = sequence_g(), mass_kg = sequence[points.length] * 1e-3;
  tellWeighing("Reading for four seconds. Touch nothing.", "");
  points.push(await order("/api/weigh", { mass_kg, largest_kg: Math.max(...sequence) * 1e-3 }));
  const { reading, reading_se } = points[points.length - 1];
  tellWeighing(`${significant(reading, 7)} ± ${significant(2 * reading_se, 2)}`, "");
});

const make_record = () => busy(async () => {
  const gravity = element("weigh-gravity").value.trim();
  const use = element("weigh-use").checked;
  const found = await order("/api/calibrate", { points, use, ...(gravity ? { gravity_m_s2: numberFrom(gravity) } : {}) });
  const percent = 100 * 2 * found.gain_u_V_N / Math.abs(found.gain_V_N);
  tellWeighing(`Gain ${significant(found.gain_V_N, 6)} V/N ± ${significant(percent, 3)} %, up to ${significant(found.in_use_N, 3)} N. `
    + `The record is ${found.file}.${use ? " The rig file names it now." : ""}`, "good");
  list(element("weigh-budget"), found.budget.map((row) => `${row.source}: ${significant(100 * row.relative_u, 2)} %, ${row.how}`));
  points = [];
  onDone();
});

function startCell() {
  for (const id of ["weigh-masses", "weigh-series"]) element(id).addEventListener("input", showNext);
  element("weigh").addEventListener("click", weigh);
  element("weigh-back").addEventListener("click", () => { points.pop(); showNext(); });
  element("weigh-make").addEventListener("click", make_record);
  element("calibrate").addEventListener("toggle", showNext);
}

export function showHands(state) {
  rig = state.rig;
  isEmulated = state.is_emulated;
  const canUse = !state.is_emulated && !rig.trouble;
  show(element("weigh-use-field"), canUse);
  if (!canUse) element("weigh-use").checked = false;
  isBusy = isBusy && state.job !== "";
  showButtons();
}

export function startHands(handlers) {
  ({ onDone } = handlers);
  startStage();
  startCell();
  showNext();
}
