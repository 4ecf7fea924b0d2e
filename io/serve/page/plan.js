// The test: its numbers, its expected course as a picture, and the start of a run.
import { order } from "./api.js";
import { Chart, limitsOf } from "./charts.js";
import { duration, element, list, make, numberField, numberFrom, show, showText, sentence, significant } from "./format.js";
import { chosenSpecimen } from "./series.js";

const kFields = [{ key: "depth_m", label: "Depth", unit: "mm", factor: 1e-3 },
                 { key: "ramp_s", label: "Ramp", unit: "s", factor: 1 },
                 { key: "hold_s", label: "Hold", unit: "s", factor: 1 },
                 { key: "unload_to_fraction", label: "Unload to (share)", factor: 1 },
                 { key: "recovery_s", label: "Second hold", unit: "s", factor: 1 },
                 { key: "approach_speed_m_s", label: "Approach at", unit: "mm/s", factor: 1e-3 },
                 { key: "approach_limit_m", label: "Approach at most", unit: "mm", factor: 1e-3 },
                 { key: "contact_force_N", label: "Contact counts from", unit: "mN", factor: 1e-3 },
                 { key: "baseline_s", label: "Rest before and after", unit: "s", factor: 1 }];
const kWait_ms = 400;  // after the last key

let state = null, expected = null, isGood = false, isUnkept = false, isStarting = false, timer = 0, asked = 0, onStart = () => {};
const chart = new Chart(element("plan-chart"), {
  labels: ["time", "force", "depth"], colors: ["force", "depth"], right: "depth",
  units: ["s", "N", "µm"], file: () => `${chosenSpecimen()} expected`,
  titles: { xlabel: "time (s)", ylabel: "force, at most (N)", y2label: "depth (µm)" },
  limits: () => limitsOf(state && state.rig), phases: () => (expected ? expected.phases : []),
  range: () => {
    const rig = state && state.rig;
    const top = Math.max(rig && !rig.trouble ? rig.hard_N : 0, expected ? expected.peak_force_N : 0);
    return [-0.03 * top, 1.2 * top];
  },
  readout: (x, row) => {
    const data = chart.data[row];
    element("plan-readout").textContent = x === null ? ""
      : `${significant(x, 4)} s: ${significant(data[1], 4)} N, ${significant(data[2], 4)} µm`;
  },
});

function isEditable() {
  return state && !state.test.trouble && state.test.protocol === "ramp-hold";
}

// Only what differs from the saved test.
function changes() {
  const test = {};
  for (const field of kFields) {
    const input = element(`plan-${field.key}`);
    input.removeAttribute("aria-invalid");
    const value = numberFrom(input.value);
    if (value === numberFrom(input.dataset.saved)) continue;  // "0,13" is "0.13"
    input.setAttribute("aria-invalid", Number.isNaN(value));
    if (Number.isNaN(value)) throw new Error(`${field.label}: "${input.value}" is not a number.`);
    test[field.key] = value * field.factor;
  }
  return test;
}

function fillForm() {
  for (const field of kFields) {
    const input = element(`plan-${field.key}`);
    const text = String(Number((state.test[field.key] / field.factor).toPrecision(10)));
    const saved = input.dataset.saved ?? "";
    const isTouched = numberFrom(input.value) !== numberFrom(saved) && input.value !== saved;
    if (!isTouched && numberFrom(input.value) !== Number(text)) input.value = text;
    input.dataset.saved = text;
  }
}

function problem(text) {
  element("plan-problems").replaceChildren(...(text ? [make("p", { class: "alert" }, sentence(text))] : []));
}

function showPicture(isThere) {
  for (const id of ["plan-legend", "plan-chart", "plan-summary"]) show(element(id), isThere);
}

function showExpected() {
  problem(expected.problems.join(" "));
  list(element("plan-warnings"), expected.warnings);
  showPicture(true);
  const course = expected.course;
  chart.show(course.time_s.map((t, i) => [t, course.force_N[i], course.depth_m[i] * 1e6]));
  chart.rebuild();
  const longest = duration((expected.duration_s + expected.approach_at_most_s) / state.clock_speed);
  element("plan-summary").textContent =
    `At most ${significant(expected.peak_force_N, 3)} N are expected; the stage stops at ${significant(expected.limit_N, 3)} N. `
    + `For this specimen a depth of ${significant(Math.floor(expected.deepest_safe_depth_m * 1e6) * 1e-3, 4)} mm is still safe. `
    + `With the approach the test takes at most ${longest}.`;
  element("plan-chart").setAttribute("aria-label",
    `Expected course: up to ${significant(expected.peak_force_N, 3)} N at ${significant(Math.max(...course.depth_m) * 1e6, 4)} µm; limit ${significant(expected.limit_N, 3)} N`);
}

// The course of a test that is not kept yet: nothing can be started.
export function showCourse(answer) {
  ++asked;
  isGood = false;
  isUnkept = true;
  expected = answer;
  showExpected();
  showStart();
}

export async function refreshPlan() {
  const number = ++asked;
  isGood = false;
  isUnkept = false;
  showStart();
  const specimen = chosenSpecimen();
  if (!specimen || !state || state.rig.trouble || state.test.trouble) {
    problem(state ? state.test.trouble || "" : "");
    showPicture(false);
    return;
  }
  try {
    const test = isEditable() ? changes() : {};
    const answer = await order("/api/preflight", { specimen, test });
    if (number !== asked) return;  // a later question is under way
    expected = answer;
    showExpected();
    const isSafe = expected.problems.length === 0;
    if (isSafe && Object.keys(test).length > 0) {  // a run takes its numbers from the file
      const saved = await order("/api/test", { test });
      if (number !== asked) return;
      Object.assign(state.test, saved);
      fillForm();
    }
    isGood = isSafe;
  } catch (error) {
    if (number !== asked) return;
    problem(error.message);
  }
  showStart();
}

function reasonNotToStart() {
  if (!state) return "";
  if (state.rig.trouble) return "The rig file cannot be used; see Rig.";
  if (state.folder_trouble) return "Nothing can be recorded; see Specimens.";
  if (!chosenSpecimen()) return "First add a specimen.";
  if (state.job) return `Busy with ${state.job}.`;
  const entry = state.specimens.find((other) => other.name === chosenSpecimen());
  if (entry && entry.trouble) return "This specimen cannot be tested; see Specimens.";
  if (entry && entry.state === "running") return "Another program captures this specimen.";
  if (!isGood) return isUnkept ? "The course above is of the text, which is not kept yet." : "";
  return state.is_emulated ? "" : `Put ${chosenSpecimen()} under the punch, clear of it.`;
}

function isRepeat() {
  const entry = state && state.specimens.find((other) => other.name === chosenSpecimen());
  return Boolean(entry && entry.state === "finished");
}

export function showStart() {
  const name = chosenSpecimen();
  const button = element("start");
  button.textContent = !name ? "Start" : isRepeat() ? `Repeat ${name}` : `Start ${name}`;
  button.disabled = !isGood || isStarting || !state || state.job !== "" || state.folder_trouble !== "";
  element("start-reason").textContent = reasonNotToStart();
}

export function showPlan(newState) {
  const before = state && JSON.stringify([state.test, state.rig]);
  state = newState;
  showText(element("plan-name"), state.test.trouble ? "" : state.test.name);
  show(element("plan-form"), isEditable());
  showText(element("plan-fixed"), state.test.trouble || isEditable() ? ""
    : `This test follows the protocol "${state.test.protocol}". Its numbers stand in test.toml; open the text below to change them.`);
  if (isEditable()) fillForm();
  if (before !== JSON.stringify([state.test, state.rig])) refreshPlan();
  showStart();
}

async function start() {
  isStarting = true;
  showStart();
  showText(element("start-error"), "");
  try {
    // The test as it was shown: it is refused if test.toml has changed since.
    await order("/api/run", { specimen: chosenSpecimen(), test: state.test,
                             repeat: isRepeat(), lift: element("lift").checked });
    element("lift").checked = false;  // decided anew for each run
  } catch (error) {
    showText(element("start-error"), sentence(error.message));
  }
  isStarting = false;
  await onStart();
  showStart();
}

export function startPlan(handlers) {
  ({ onStart } = handlers);
  const form = element("plan-form");
  form.replaceChildren(...kFields.map((field) => numberField("plan", field)));
  form.addEventListener("submit", (event) => event.preventDefault());
  form.addEventListener("input", () => {
    isGood = false;
    ++asked;  // answers to earlier questions no longer count
    showStart();
    showText(element("start-error"), "");
    clearTimeout(timer);
    timer = setTimeout(refreshPlan, kWait_ms);
  });
  element("plausible-off").addEventListener("change", refreshPlan);
  element("start").addEventListener("click", start);
}
