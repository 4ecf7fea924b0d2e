#include "io/report/report_html.h"

namespace viscard {
namespace {

constexpr const char* kTextAndTables = R"(
:root { --ink: #1f2933; --soft: #5b6570; --line: #d5dae0; --wash: #f5f7f9; --link: #005b8f;
  --page: #fff; --chosen: #e8f1f8; --good: #00664a; --bad: #a33c00; }
* { box-sizing: border-box; }
html { -webkit-text-size-adjust: 100%; }
body { margin: 0; color: var(--ink); background: var(--page);
  font: 16px/1.55 system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", "DejaVu Sans", Arial, sans-serif; }
main, header.top, footer { max-width: 1104px; margin: 0 auto; padding: 0 32px; }
header.top { padding-top: 44px; }
.logo { display: block; max-width: 240px; max-height: 72px; margin-bottom: 14px; }
footer { padding-top: 8px; padding-bottom: 48px; color: var(--soft); font-size: 14px; }
h1 { font-size: 30px; line-height: 1.2; margin: 0 0 10px; letter-spacing: -0.01em; }
h2 { font-size: 21px; margin: 52px 0 10px; padding-top: 14px; border-top: 1px solid var(--line); }
h3 { font-size: 17px; margin: 32px 0 6px; }
p { max-width: 78ch; margin: 8px 0 14px; }
a { color: var(--link); }
.lead { font-size: 17px; }
.by { color: var(--soft); font-size: 14px; margin: 0 0 6px; }
nav ol { list-style: none; margin: 18px 0 0; padding: 0; display: flex; flex-wrap: wrap; gap: 4px 20px; font-size: 14px; }
.table { overflow-x: auto; margin: 18px 0 26px; }
table { border-collapse: collapse; font-size: 14px; line-height: 1.4; border-bottom: 1.5px solid var(--ink); }
caption { caption-side: top; text-align: left; padding: 0 0 8px; max-width: min(92ch, calc(100vw - 64px)); color: var(--ink); }
th, td { padding: 5px 11px; text-align: left; vertical-align: top; font-weight: 400; }
th:first-child, td:first-child { padding-left: 4px; }
thead th { font-weight: 600; border-top: 1.5px solid var(--ink); border-bottom: 1px solid var(--ink); vertical-align: bottom; }
tbody th { font-weight: 600; }
tr.group > * { border-top: 1px solid var(--line); }
.n { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
thead .n { white-space: normal; }
.nw { white-space: nowrap; }
.ci { color: var(--soft); font-size: 13px; white-space: nowrap; }
.unit { color: var(--soft); font-weight: 400; }
.yes { color: var(--good); } .no { color: var(--bad); font-weight: 600; }
tr.chosen > * { background: var(--chosen); font-weight: 600; }
)";

constexpr const char* kFiguresAndDetails = R"(figure { margin: 22px 0 26px; }
.drawing { overflow-x: auto; }
.drawing svg.plot { display: block; width: 100%; height: auto; }
figcaption { font-size: 14px; line-height: 1.45; max-width: 92ch; margin-top: 6px; }
.row { display: grid; grid-template-columns: repeat(auto-fit, minmax(440px, 1fr)); gap: 0 24px; align-items: start; }
.row figure { margin-bottom: 12px; max-width: 640px; }
ul.flags { margin: 6px 0 18px; padding-left: 20px; max-width: 92ch; }
ul.flags li { margin: 3px 0; }
details { border: 1px solid var(--line); border-radius: 6px; margin: 8px 0; background: var(--page); }
summary { cursor: pointer; padding: 8px 14px; font-size: 14px; }
summary:focus-visible, a:focus-visible, pre:focus-visible { outline: 2px solid var(--link); outline-offset: 2px; }
details .tools { padding: 0 14px; font-size: 14px; margin: 0 0 6px; }
pre { margin: 0; padding: 12px 14px; background: var(--wash); border-top: 1px solid var(--line); overflow: auto;
  max-height: 520px; font: 12.5px/1.5 ui-monospace, "DejaVu Sans Mono", Menlo, Consolas, monospace; tab-size: 4; }
code { font: 13px/1.5 ui-monospace, "DejaVu Sans Mono", Menlo, Consolas, monospace; overflow-wrap: anywhere; }
dl { display: grid; grid-template-columns: max-content 1fr; gap: 4px 20px; font-size: 14px; margin: 10px 0 20px; }
dt { color: var(--soft); } dd { margin: 0; overflow-wrap: anywhere; }
)";

// Narrow screens, dark ones, and paper.
constexpr const char* kMedia =
    R"(@media screen and (max-width: 560px) { main, header.top, footer { padding-left: 16px; padding-right: 16px; }
  .row { grid-template-columns: minmax(0, 1fr); } dl { grid-template-columns: 1fr; } dd { margin-bottom: 6px; }
  h1 { font-size: 24px; overflow-wrap: anywhere; } h2 { font-size: 19px; overflow-wrap: anywhere; }
  caption { max-width: calc(100vw - 32px); } th, td { padding: 5px 8px; }
  tbody th, .nw { white-space: normal; overflow-wrap: anywhere; } tbody th { min-width: 90px; }
  /* Drawings keep a size that can be read, and scroll. */
  .drawing svg.plot { width: auto; max-width: none; height: auto; zoom: 0.8; } }
/* Inverted and turned back to their hues, colours stay those of the legend and white becomes the page. */
@media screen and (prefers-color-scheme: dark) {
  :root { --ink: #e3e7eb; --soft: #a2acb6; --line: #3a424b; --wash: #1c2126; --link: #6db8ea;
    --page: #141414; --chosen: #1d3446; --good: #52c79c; --bad: #ff9d62; }
  .drawing svg.plot { filter: invert(0.92) hue-rotate(180deg); } }
@media print {
  @page { margin: 16mm 14mm; }
  body { font-size: 10pt; } h1 { font-size: 18pt; } h2 { font-size: 13pt; margin-top: 18pt; } h3 { font-size: 11pt; }
  main, header.top, footer { max-width: none; padding: 0; }
  nav, .tools { display: none; } a { color: inherit; text-decoration: none; }
  table, figcaption, dl, .by { font-size: 8.5pt; } .table { overflow: visible; }
  figure, tr, dl > * { break-inside: avoid; } h2, h3, caption { break-after: avoid; }
  .row { grid-template-columns: 1fr 1fr; }
  details { border: 0; } details > *:not(summary) { display: block; }
  details::details-content { content-visibility: visible; display: block; height: auto; }
  pre { max-height: none; white-space: pre-wrap; font-size: 7.5pt; }
}
)";

}  // namespace

std::string report_style() {
  return std::string(kTextAndTables) + kFiguresAndDetails + kMedia;
}

}  // namespace viscard
