// The captures of the series over one another: force against time since contact, with their fits or without.
import { element, make, sentence, show, showText } from "./format.js";
import { keyOf, kMostCurves, overlay, showModuliBeside, startOverlay } from "./overlay.js";
import { orderWhenFree } from "./result.js";
import { isRunning } from "./run.js";

let files = [], curves = {}, fits = {}, chart = null, asked = 0;
let places = new Map();  // of those that are drawn: the colour of each stays

const withFit = () => element("captures-fit").checked;
const shown = () => files.filter((file) => places.has(file) && curves[file]);

function draw() {
  if (chart) chart.close();
  chart = null;
  const names = shown();
  show(element("captures-body"), names.length > 0);
  if (names.length === 0) return;
  chart = overlay("captures", names.map((file) => {
    const { contact_s, zero_N, time_s, force_N } = curves[file], { curves: ofFit } = fits[file] ?? {};
    const start_s = ofFit?.motion_start_s[0] ?? contact_s;  // the fit finds the contact from the force
    return { name: file.replace(/\.viscap$/, ""), place: places.get(file), x: time_s.map((t) => t + contact_s - start_s), measured: force_N,
             ...(ofFit ? { fit_x: ofFit.time_s.map((t) => t - start_s), fitted: ofFit.fitted.map((y) => y - zero_N) } : {}) };
  }), { argument: "time_s", quantity: "force_N", xlabel: "time since contact (s)", file: () => "captures" });
  const fitted = withFit() ? names.filter((file) => fits[file]) : [];
  show(element("captures-table"), fitted.length > 0);
  showModuliBeside(element("captures-moduli"), fitted.map((file) => ({ name: file.replace(/\.viscap$/, ""), key: keyOf(places.get(file)), fit: fits[file] })));
}

// Reads what is not here yet. The rig does one thing at a time: during a run nothing is read.
async function load() {
  const number = ++asked, troubles = [];
  // A capture that is taken away meanwhile gives its name to the next one.
  const get = async (kept, path, file, more = {}) => {
    if (file in kept) return;
    const got = await orderWhenFree(path, { capture: file, ...more });
    if (files.includes(file)) kept[file] = got;
  };
  for (const file of files.filter((one) => places.has(one))) {
    if (isRunning() || number !== asked) break;
    if (!curves[file] || (withFit() && !(file in fits))) showText(element("captures-status"), `Reading ${file} …`);
    try {
      await get(curves, "/api/captures/curve", file);
      if (withFit()) await get(fits, "/api/fit", file, { keep: false });
    } catch (error) {
      // A fit that fails fails again, and the rig does one thing at a time.
      if (file in curves && error.code && error.code !== "busy") fits[file] = null;
      troubles.push(`${file}: ${sentence(error.message)}`);
    }
  }
  if (number !== asked) return;
  showText(element("captures-status"), troubles.join(" "));
  draw();
}

function place(file) {
  for (let k = 0; k < kMostCurves; ++k) {
    if (![...places.values()].includes(k)) return places.set(file, k);
  }
  return null;
}

function showList() {
  element("captures-list").replaceChildren(...files.map((file) => {
    const box = make("input", { type: "checkbox", checked: places.has(file) });
    box.addEventListener("change", () => {
      if (!box.checked) places.delete(file);
      else if (!place(file)) showText(element("captures-status"), `At most ${kMostCurves} are drawn; switch one off first.`);
      if (box.checked && !places.has(file)) { box.checked = false; return; }
      showList();
      element("captures-list").querySelectorAll("input")[files.indexOf(file)].focus();
      load();
    });
    return make("label", {}, box, ...(places.has(file) ? [keyOf(places.get(file))] : []), file.replace(/\.viscap$/, ""));
  }));
}

export function showCaptures(state) {
  const now = state.specimens.flatMap((entry) => entry.captures).filter(({ status }) => status === "finished" || status === "interrupted").map(({ file }) => file);
  show(element("captures"), now.length > 0);
  if (now.join("/") === files.join("/")) return;
  places = new Map([...places].filter(([file]) => now.includes(file)));
  for (const file of now) if (!files.includes(file)) place(file);
  for (const file of files.filter((one) => !now.includes(one))) {
    delete curves[file];
    delete fits[file];
  }
  files = now;
  showList();
  if (element("captures-open").open) load();
}

export function startCaptures() {
  startOverlay("captures", () => (withFit() ? load() : draw()));
  element("captures-open").addEventListener("toggle", () => { if (element("captures-open").open) load(); });
}
