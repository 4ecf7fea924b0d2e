// The running test: force and depth as they arrive, time left, and the two ways to stop it.
import { ask, orderSoon } from "./api.js";
import { Chart, limitsOf, thinned } from "./charts.js";
import { clock, element, fixed, list, make, show, showText, sentence, significant } from "./format.js";

const kMostDrawn = 3000;

let rig = null, run = null, points = [], keepEvery = 0, isWatched = false, onEnd = () => {};

const chart = new Chart(element("run-chart"), {
  labels: ["time", "force", "depth"], colors: ["force", "depth"], right: "depth",
  units: ["s", "N", "µm"], file: () => `${run.file.replace(/\.viscap$/, "")} shown`,
  titles: { xlabel: "time (s)", ylabel: "force (N)", y2label: "depth (µm)" },
  limits: () => limitsOf(rig),
  range: () => (element("run-limits").checked && rig && !rig.trouble ? [-0.05 * rig.hard_N, 1.12 * rig.hard_N] : null),
  readout: (x, row) => {
    const data = chart.data[row];
    element("run-readout").textContent = x === null || !data ? ""
      : `${significant(x, 5)} s: ${significant(data[1], 4)} N, ${significant(data[2], 4)} µm`;
  },
});

function take(answer) {
  const rows = answer.points.time_s.map((t, i) => [t, answer.points.force_N[i], answer.points.depth_m[i] * 1e6]);
  const isNew = !run || run.number !== answer.number || answer.points.from !== points.length;
  points = isNew && answer.points.from === 0 ? rows : points.slice(0, answer.points.from).concat(rows);
  keepEvery = answer.points.keep_every;
  run = answer;
  chart.show(thinned(points, kMostDrawn));
}

function showNumbers() {
  showText(element("run-name"), `${run.specimen}, ${run.file}`);
  const phase = run.is_running ? run.phase_text || run.phase.replaceAll("_", " ") : "The run is over.";
  showText(element("run-phase"), run.is_stopping && run.is_running ? "Stopping and lifting the punch" : phase);
  element("run-force").textContent = `${fixed(run.force_N, 3)} N`;
  element("run-share").textContent = rig && !rig.trouble ? `${fixed(100 * run.force_N / rig.soft_N, 0)} %` : "–";
  element("run-depth").textContent = `${fixed(run.depth_m * 1e6, 1)} µm`;
  element("run-left").textContent = run.is_running ? clock(run.time_left_wall_s) : "0:00";
  element("run-progress").value = run.is_running ? run.fraction : 1;
  element("run-records").textContent = run.records.committed > 0
    ? `${run.records.committed} records are safe from a crash of this program, ${run.records.synced} of them from a power cut.` : "";
  element("stop-text").textContent = `${phase}: ${fixed(run.force_N, 3)} N, ${clock(run.time_left_wall_s)} left`;
  element("run-chart").setAttribute("aria-label",
    `Force and depth against time: ${fixed(run.force_N, 3)} N now, ${fixed(run.peak_force_N, 3)} N at most`);
}

function showOutcome() {
  const place = element("run-outcome");
  if (run.is_running) return place.replaceChildren();
  const outcome = run.outcome;
  if (!outcome) {
    return place.replaceChildren(make("p", { class: "alert", id: "outcome-text" }, `${run.phase ? "The run failed" : "The test did not begin"}: ${sentence(run.trouble)}`));
  }
  const doubts = make("ul", { class: "note" });
  list(doubts, outcome.doubts);
  const isFinished = outcome.status === "finished";
  const text = isFinished
    ? `Finished: ${significant(outcome.peak_force_N, 4)} N at most, ${significant(outcome.depth_m * 1e6, 4)} µm deep, ${outcome.readings.received} readings, ${outcome.readings.missing} missing.`
    : `${outcome.status === "stopped" ? "Stopped by a limit" : "Interrupted"}: ${sentence(outcome.reason)}`;
  place.replaceChildren(make("p", { class: isFinished ? "good" : "alert", id: "outcome-text" }, text), doubts);
}

function showRunning(isRunning) {
  document.body.classList.toggle("running", isRunning);
  show(element("stop-bar"), isRunning);
  const isStopping = Boolean(run && run.is_stopping);
  element("stop-gently").disabled = isStopping;
}

export const isRunning = () => Boolean(run && run.is_running);

// Asks once; returns whether a run is going on.
export async function pollRun() {
  const before = run;
  const answer = await ask(`/api/run?from=${points.length}&keep_every=${keepEvery}`);
  if (answer.number === 0) return false;
  const isOther = !before || before.number !== answer.number;
  if (isOther && answer.points.from !== 0) {  // the points of an earlier run were counted
    points = [];
    keepEvery = 0;
    return pollRun();
  }
  show(element("run"), true);  // first, because a hidden chart has no width
  take(answer);
  showNumbers();
  showRunning(answer.is_running);
  if (answer.is_running && (isOther || !before.is_running)) {
    isWatched = true;
    showOutcome();
    chart.rebuild();
    element("run").scrollIntoView({ block: "start" });
    element("run-title").focus({ preventScroll: true });
  }
  if (!answer.is_running && (isOther || before.is_running)) {
    showOutcome();
    if (isWatched) {
      element("run").scrollIntoView({ block: "start" });  // it has moved back to its place
      onEnd(answer);
    }
    isWatched = false;
  }
  return answer.is_running;
}

async function stop(how) {
  element("stop-gently").disabled = true;
  try {
    await orderSoon("/api/run/stop", { how });
  } catch (error) {
    element("stop-gently").disabled = false;
    showText(element("stop-text"), `${sentence(error.message)} Use the emergency stop of the stage if it still moves.`);
  }
}

export function showRigLimits(state) {
  rig = state.rig;
}

export function startRun(handlers) {
  ({ onEnd } = handlers);
  element("stop-gently").addEventListener("click", () => stop("gently"));
  element("stop-at-once").addEventListener("click", () => stop("at once"));
  element("run-limits").addEventListener("change", () => chart.show(chart.data));
  document.addEventListener("keydown", (event) => {
    if (event.key === "Escape" && isRunning()) stop("gently");
  });
}
