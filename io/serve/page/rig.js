// The rig: what its file says, the ports that are present, and a check of both devices.
import { ask, order } from "./api.js";
import { element, list, make, sentence, show, showText, significant } from "./format.js";

const kPortNames = (device) => (device.port ? `${device.driver} at ${device.port}` : device.driver);

let calibrationTrouble = "";

export function showRig(state) {
  const rig = state.rig;
  calibrationTrouble = rig.calibration_trouble || "";
  const ports = [rig.stage, rig.load_cell].map((device) => (device && device.trouble) || "");
  const troubles = [rig.trouble, rig.calibration_trouble, ...ports].filter(Boolean);
  showText(element("rig-trouble"), troubles.map(sentence).join(" "));
  show(element("rig-facts"), !rig.trouble);
  showText(element("rig-name"), rig.trouble ? "" : rig.name);
  const speed = state.clock_speed === 1 ? "" : `, clock × ${state.clock_speed}`;
  showText(element("emulated"), state.is_emulated ? `emulated rig${speed}` : "");
  element("check").disabled = state.job !== "" || Boolean(rig.trouble);
  if (rig.trouble) return;
  const facts = [["Stage", state.is_emulated ? `emulated ${rig.stage.driver}` : kPortNames(rig.stage)],
                 ["Load cell", state.is_emulated ? `emulated ${rig.load_cell.driver}` : kPortNames(rig.load_cell)],
                 ["Capacity", `${significant(rig.capacity_N, 4)}\u00a0N; the stage stops at ${significant(rig.soft_N, 3)}\u00a0N`],
                 ["Frame", rig.frame_stiffness_N_m > 0 ? `${significant(rig.frame_stiffness_N_m * 1e-3, 4)} N/mm` : "rigid"],
                 ["Calibration", rig.calibration_id || "without a name"]];
  element("rig-facts").replaceChildren(
    ...facts.flatMap(([name, value]) => [make("dt", {}, name), make("dd", {}, value)]));
}

// A light with its word: colour alone says nothing to some.
const light = (state) => make("span", { class: `light ${state}` }, state === "go" ? "ready" : state === "wait" ? "look" : "not fit");

function rowsOfCheck(found) {
  const { stage, load_cell: cell } = found;
  const ofCell = !found.is_usable ? "halt" : found.is_proven ? "go" : "wait";
  return [["Stage", `${stage.identity}, at ${significant(stage.position_m * 1e3, 4)} mm, answers in ${significant(stage.latency_mean_s * 1e3, 2)} ms`, stage.reports_lost > 0 ? "wait" : "go"],
          ["Load cell", `${significant(cell.rate_Hz, 4)} readings/s, ${cell.missing} missing, ${cell.unreadable} unreadable`, cell.missing + cell.unreadable > 0 ? "wait" : "go"],
          ["It reads", `${significant(cell.force_N, 4)} N, noise ${significant(cell.noise_N * 1e3, 3)} mN per reading`, ofCell],
          ["Calibration", calibrationTrouble ? sentence(calibrationTrouble) : "in date", calibrationTrouble ? "wait" : "go"]];
}

async function check() {
  const result = element("check-result");
  element("check").disabled = true;
  result.replaceChildren(make("p", {}, "Measuring …"));
  try {
    const found = await order("/api/check");
    const advice = make("ul", { class: "note" });
    list(advice, found.advice);
    result.replaceChildren(
      make("p", { class: found.is_usable ? "good" : "alert" },
           found.is_usable ? "Ready for a test." : "Not fit for a test yet."),
      make("dl", { class: "facts" },
           ...rowsOfCheck(found).flatMap(([name, value, state]) => [make("dt", {}, name), make("dd", {}, light(state), " ", value)])),
      advice);
  } catch (error) {
    result.replaceChildren(make("p", { class: "alert" }, sentence(error.message)));
  }
  element("check").disabled = false;
}

async function showPorts() {
  if (!element("ports").open) return;
  const { ports } = await ask("/api/ports");
  list(element("port-list"), ports.length > 0
    ? ports.map((port) => `${port.port}: ${port.trouble || "free"}`)
    : ["No serial port is present. Plug the stage and the load cell in and switch them on."]);
}

export function startRig() {
  element("check").addEventListener("click", check);
  element("ports").addEventListener("toggle", () => showPorts().catch(() => {}));
}
