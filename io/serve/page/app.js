// Puts the parts of the page together and asks viscard serve what is new. The page holds nothing that
// the folder of the series and the running test do not: reloading or closing it changes nothing.
import { ask, Unreachable } from "./api.js";
import { showCaptures, startCaptures } from "./captures.js";
import { element, sentence, showText } from "./format.js";
import { showHands, startHands } from "./hands.js";
import { refreshPlan, showCourse, showPlan, showStart, startPlan } from "./plan.js";
import { startProtocol } from "./protocol.js";
import { fitCapture, startResult } from "./result.js";
import { showRig, startRig } from "./rig.js";
import { isRunning, pollRun, showRigLimits, startRun } from "./run.js";
import { chooseNext, chosenSpecimen, showSeries, startSeries } from "./series.js";
import { startSetup } from "./setup.js";

const kRunning_ms = 200, kIdle_ms = 1500;
const kStateEvery = 3;  // idle polls

let state = null;

async function refresh() {
  state = await ask("/api/state");
  showRig(state);
  showHands(state);
  showRigLimits(state);
  showSeries(state);
  showPlan(state);
  showCaptures(state);
}

function showLink(error) {
  const isLost = error instanceof Unreachable || (error && error.code === "wrong-token");
  showText(element("link"), isLost ? "not connected" : "connected");
  if (!error) return showText(element("lost"), "");
  const text = !(error instanceof Unreachable) ? sentence(error.message)
    : `${sentence(error.message)} If it has ended, start it again and open the address that it prints. `
      + (isRunning() ? "A run was going on: look at the rig." : "");
  showText(element("lost"), text);
}

async function pollForever() {
  let wasRunning = false;
  for (let n = 0; ; ++n) {
    try {
      const isNow = await pollRun();
      const isOld = isNow !== wasRunning || (!isNow && n % kStateEvery === 0);  // or another page began a run
      if (state === null || isOld) await refresh();
      wasRunning = isNow;
      showLink(null);
    } catch (error) {
      showLink(error);
    }
    await new Promise((done) => setTimeout(done, isRunning() ? kRunning_ms : kIdle_ms));
  }
}

async function runEnded(run) {
  await refresh();
  if (!run.outcome || run.outcome.status !== "finished") return;
  await fitCapture(run.file);
  chooseNext(state);
}

const quietly = (work) => work().catch(showLink);

startRig();
startSetup({ onKept: () => refresh() });
startHands({ onDone: () => quietly(refresh) });
startProtocol({ specimen: chosenSpecimen, onCourse: showCourse, onKept: () => refresh() });
startSeries({
  onChoice: () => { showStart(); quietly(refreshPlan); },
  onChange: () => quietly(refresh),
  onFit: (capture) => quietly(() => fitCapture(capture)),
});
startPlan({ onStart: () => quietly(async () => { await pollRun(); await refresh(); }) });
startRun({ onEnd: (run) => quietly(() => runEnded(run)) });
startCaptures();
startResult({ onFitted: () => quietly(refresh) });
pollForever();
