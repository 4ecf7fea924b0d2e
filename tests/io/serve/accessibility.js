// Faults of the page as it is shown, by WCAG 2.2: returned as sentences. The numbers of the rules stand beside them.
const faults = [];
const isSeen = (node) => node.getClientRects().length > 0 && getComputedStyle(node).visibility !== "hidden";
const nameOf = (node) => `<${node.tagName.toLowerCase()}${node.id ? ` id=${node.id}` : ""}> ${(node.textContent || "").trim().slice(0, 30)}`;

// 4.1.1 (once), 1.3.1: identifiers are unique, and what refers to one finds it.
const ids = [...document.querySelectorAll("[id]")].map((node) => node.id);
for (const id of new Set(ids.filter((one, i) => ids.indexOf(one) !== i))) faults.push(`the id ${id} stands twice`);
for (const attribute of ["for", "aria-controls", "aria-labelledby", "aria-describedby"]) {
  for (const node of document.querySelectorAll(`[${attribute}]`)) {
    for (const id of node.getAttribute(attribute).split(" ")) {
      if (!document.getElementById(id)) faults.push(`${nameOf(node)}: ${attribute} names ${id}, which is not there`);
    }
  }
}

// 3.1.1, 2.4.2, 1.1.1, 4.1.2: language, title, and names of pictures and controls.
if (!document.documentElement.lang) faults.push("the page states no language");
if (!document.title) faults.push("the page has no title");
for (const image of document.querySelectorAll("img")) if (!image.hasAttribute("alt")) faults.push(`${nameOf(image)}: a picture without a text`);
for (const node of document.querySelectorAll("input:not(.dygraph-roller), select, textarea, button, [role=img], [role=region]")) {
  const labels = [...(node.labels ?? [])].map((label) => label.textContent).join("");
  const referred = (node.getAttribute("aria-labelledby") ?? "").split(" ").map((id) => document.getElementById(id)?.textContent ?? "").join("");
  if (![labels, referred, node.getAttribute("aria-label"), node.tagName === "BUTTON" && node.textContent].some((text) => text && text.trim()))
    faults.push(`${nameOf(node)}: nothing names it`);
}

// 1.3.1: headings go down one level at a time.
let level = 0;
for (const heading of [...document.querySelectorAll("h1, h2, h3, h4")].filter(isSeen)) {
  const now = Number(heading.tagName[1]);
  if (now > level + 1) faults.push(`${nameOf(heading)} follows a heading of level ${level}`);
  level = now;
}

// 2.5.8: what is pressed is at least 24 px wide and high, or text in a line.
for (const node of [...document.querySelectorAll("button, select, input:not(.dygraph-roller), summary")].filter(isSeen)) {
  const target = node.closest("label") ?? node, { width, height } = target.getBoundingClientRect();
  if (node.classList.contains("unseen") || node.classList.contains("skip")) continue;
  if (width < 24 || height < 24) faults.push(`${nameOf(node)}: ${width.toFixed(0)} x ${height.toFixed(0)} px are hard to press`);
}

// 1.4.3: contrast of text, of what is not disabled. Colours that are not opaque lie on what is behind them.
const parts = (text) => (text.match(/[\d.]+/g) ?? []).map(Number);
const over = ([r, g, b, a = 1], under) => [r, g, b].map((value, i) => a * value + (1 - a) * under[i]);
function backgroundOf(node) {
  if (node === null) return matchMedia("(prefers-color-scheme: dark)").matches ? [0, 0, 0] : [255, 255, 255];
  const own = parts(getComputedStyle(node).backgroundColor);
  return own.length === 4 && own[3] === 0 ? backgroundOf(node.parentElement) : over(own, own[3] < 1 ? backgroundOf(node.parentElement) : own);
}
const luminance = (rgb) => rgb.map((v) => v / 255).map((v) => (v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4))
  .reduce((sum, v, i) => sum + [0.2126, 0.7152, 0.0722][i] * v, 0);
const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
for (let text = walker.nextNode(); text; text = walker.nextNode()) {
  const node = text.parentElement;
  if (!text.data.trim() || !isSeen(node) || node.closest(":disabled, .unseen, .skip, script, style, option")) continue;
  const style = getComputedStyle(node), behind = backgroundOf(node), front = over(parts(style.color), behind);
  const [high, low] = [luminance(front), luminance(behind)].sort((a, b) => b - a);
  const size = parseFloat(style.fontSize), isLarge = size >= 24 || (size >= 18.66 && Number(style.fontWeight) >= 700);
  const contrast = (high + 0.05) / (low + 0.05);
  if (contrast < (isLarge ? 3 : 4.5)) faults.push(`${nameOf(node)}: contrast ${contrast.toFixed(2)}`);
}

// 1.4.10: nothing makes the page wider than the window.
const { scrollWidth, clientWidth } = document.documentElement;
if (scrollWidth > clientWidth + 1) faults.push(`the page is ${scrollWidth} px wide in a window of ${clientWidth} px`);
return [...new Set(faults)];
