#pragma once

namespace aeolian {

/// The look of the report: sand and ink, readable on a screen and on paper.
inline const char* const report_style = R"css(
:root { --ink: #2e2723; --soft: #6b6058; --line: #e3dacf; --paper: #fbf8f3; --accent: #c2571a; }
* { box-sizing: border-box; }
body { margin: 0; background: var(--paper); color: var(--ink);
       font: 16px/1.55 "Helvetica Neue", Helvetica, Arial, "Liberation Sans", sans-serif; }
main { max-width: 1120px; margin: 0 auto; padding: 48px 32px 64px; }
header { border-bottom: 2px solid var(--ink); padding-bottom: 22px; }
h1 { margin: 0; font: 600 38px/1.15 Georgia, "Liberation Serif", serif; }
h2 { margin: 52px 0 6px; font: 600 25px/1.2 Georgia, "Liberation Serif", serif; }
h3 { margin: 0 0 6px; font-size: 16px; }
p { margin: 0 0 10px; max-width: 78ch; }
a { color: var(--accent); }
.source { margin: 8px 0 0; color: var(--soft); font-size: 14px; }
.verdict { margin: 26px 0 0; font: 21px/1.45 Georgia, "Liberation Serif", serif; max-width: none; }
.cards { display: grid; grid-template-columns: repeat(auto-fit, minmax(190px, 1fr)); gap: 14px; margin: 26px 0 0; }
.card { background: #fff; border: 1px solid var(--line); border-top: 3px solid var(--accent); padding: 12px 16px; }
.card b { display: block; font-size: 25px; line-height: 1.3; white-space: nowrap; }
.card b.text { font-size: 18px; line-height: 1.8; }
.card span { color: var(--soft); font-size: 13.5px; line-height: 1.4; display: block; }
.maps { display: grid; grid-template-columns: 1fr 1fr; gap: 22px; margin-top: 16px; }
figure { margin: 0; background: #fff; border: 1px solid var(--line); padding: 16px; }
figure.wide { margin-top: 16px; }
figure img { display: block; width: 100%; height: auto; }
figcaption { color: var(--soft); font-size: 14px; margin-top: 10px; }
.table { overflow-x: auto; margin-top: 16px; background: #fff; border: 1px solid var(--line); }
.table.beside { margin-top: 0; align-self: start; }
table { border-collapse: collapse; width: 100%; font-size: 14.5px; font-variant-numeric: tabular-nums; }
th, td { padding: 7px 16px; text-align: right; border-bottom: 1px solid var(--line); white-space: nowrap; }
th:first-child, td:first-child { text-align: left; white-space: normal; }
thead th { border-bottom: 2px solid var(--ink); }
tr.group th { text-align: left; color: var(--accent); font-size: 13px; letter-spacing: .03em; padding-top: 16px; }
tr:last-child td { border-bottom: 0; }
td small { color: var(--soft); display: block; font-size: 12.5px; }
.none { background: #fff; border-left: 4px solid var(--accent); padding: 14px 18px; margin-top: 16px; }
footer { margin-top: 52px; border-top: 1px solid var(--line); padding-top: 14px; color: var(--soft); font-size: 14px; }
@media (max-width: 760px) { .maps { grid-template-columns: 1fr; } main { padding: 24px 16px; } }
@media print { body { background: #fff; } figure, .card, .table { break-inside: avoid; } }
)css";

}  // namespace aeolian
