// One page to hand on about the chosen tables.
import { order } from "./api.js";
import { pythonKeywords, showSame } from "./desk_options.js";
import { element, list, make, save, sentence, show, showText } from "./format.js";

let chosen = new Set(), made = null;

export function startReport() {
  element("report-make").addEventListener("click", makeReport);
  element("report-download").addEventListener("click", () => save(made.name, made.html, "text/html"));
}

export function showReportTables(names, open) {
  chosen = new Set([...chosen].filter((name) => names.includes(name)));
  if (chosen.size === 0 && open !== null) chosen.add(open);
  element("report-tables").replaceChildren(...names.map((name) => {
    const box = make("input", { type: "checkbox" });
    box.checked = chosen.has(name);
    box.addEventListener("change", () => { if (box.checked) chosen.add(name); else chosen.delete(name); });
    return make("label", {}, box, name);
  }));
}

async function makeReport() {
  const tell = (text, kind) => { element("report-status").className = kind; showText(element("report-status"), text); };
  show(element("report-link"), false);
  list(element("report-notes"), []);
  element("report-same").replaceChildren();
  tell("Writing …", "");
  try {
    const title = element("report-title").value.trim();
    made = await order("/api/desk/report", { tables: [...chosen], ...(title ? { title } : {}) });
    const doubts = [...made.result.defects, ...made.result.disagreements];
    tell(`Written as ${made.name} in the folder.${doubts.length > 0 ? " Not all that it shows is to be trusted." : ""}`, doubts.length > 0 ? "alert" : "good");
    show(element("report-link"), true);
    list(element("report-notes"), [...doubts, ...made.notes].map(sentence));
    const { card: cards, ...options } = made.options;
    showSame(element("report-same"), made.command,
             `import viscard\nviscard.report(${JSON.stringify(made.files)}, ${JSON.stringify(made.next_name)}${pythonKeywords({ ...options, cards })})`, made.result);
  } catch (error) {
    tell(sentence(error.message), "alert");
  }
}
