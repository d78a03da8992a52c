// The style sheet of a report, for light and dark screens and for paper.
#pragma once

#include <cstddef>
#include <string_view>

namespace hyperlattice::report {

/// Classes c0.. and d0.. of the style.
inline constexpr std::size_t curve_colours = 8, curve_dashes = 3;

inline constexpr std::string_view style = R"css(
:root { color-scheme: light dark; --page: #fff; --ink: #1d2329; --soft: #5a646e; --line: #dde2e7; --shade: #f4f6f8; --ok: #1e7d4f; --warn: #9a6200;
  --bad: #b3261e; --c0: #1b6ca8; --c1: #d1600a; --c2: #27825a; --c3: #8e44ad; --c4: #b03a2e; --c5: #7f6000; --c6: #c2185b; --c7: #5d6d7e; }
@media (prefers-color-scheme: dark) { :root { --page: #15191d; --ink: #e4e8ec; --soft: #9aa5b0; --line: #333b43; --shade: #1e242a; --ok: #5ccb93;
  --warn: #e8b04a; --bad: #ff8a80; --c0: #5fb0ea; --c1: #f59b52; --c2: #5ccb93; --c3: #c58fe0; --c4: #f0857a; --c5: #d8b94a; --c6: #f178a6;
  --c7: #a9b7c4; } }
body { margin: 0 auto; padding: 1.5rem; max-width: 76rem; background: var(--page); color: var(--ink); font: 16px/1.5 system-ui, sans-serif; }
h1 { font-size: 1.7rem; line-height: 1.2; margin: 0 0 .3rem; } h2 { font-size: 1.3rem; margin: 2.2rem 0 .5rem; } h3 { font-size: 1.05rem; margin: 1.4rem 0 .4rem; }
section + section { border-top: 2px solid var(--line); margin-top: 2.5rem; }
p { margin: .3rem 0; } .soft { color: var(--soft); overflow-wrap: anywhere; }
.ok b { color: var(--ok); } .warn b { color: var(--warn); } .bad b { color: var(--bad); } .note b { color: var(--soft); }
ul.verdict { list-style: none; padding: 0; margin: .6rem 0; max-width: 56rem; } .verdict li { padding-left: 1.7rem; margin: .35rem 0; }
.verdict b { display: inline-block; width: 1.7rem; margin-left: -1.7rem; }
.wide { overflow-x: auto; } table { border-collapse: collapse; font-size: .9rem; font-variant-numeric: tabular-nums; }
th, td { text-align: left; vertical-align: top; padding: .2rem .9rem .2rem 0; border-bottom: 1px solid var(--line); } th { font-weight: 600; }
td { overflow-wrap: anywhere; } .columns { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(26rem, 100%), 1fr)); gap: 1rem 2rem; }
figure { margin: 0; } figcaption { font-weight: 600; margin-bottom: .2rem; } img { max-width: 100%; height: auto; background: #fff; }
.pictures figcaption { font-weight: 400; font-size: .85rem; color: var(--soft); } .pictures { grid-template-columns: repeat(auto-fill, minmax(min(18rem, 100%), 1fr)); }
svg { width: 100%; height: auto; display: block; } svg text { font: 12px system-ui, sans-serif; fill: var(--ink); } svg .axis { fill: var(--soft); }
svg .end { text-anchor: end; } svg .middle { text-anchor: middle; } svg path { fill: none; } svg .grid { stroke: var(--line); stroke-width: 1; }
svg .zero { stroke: var(--soft); stroke-width: 1; } svg .frame { stroke: var(--soft); stroke-width: 1; }
svg .curve { stroke-width: 1.8; stroke-linejoin: round; } svg .dots { stroke-width: 5; stroke-linecap: round; }
.c0 { stroke: var(--c0); } .c1 { stroke: var(--c1); } .c2 { stroke: var(--c2); } .c3 { stroke: var(--c3); } .c4 { stroke: var(--c4); }
.c5 { stroke: var(--c5); } .c6 { stroke: var(--c6); } .c7 { stroke: var(--c7); } .curve.d1 { stroke-dasharray: 7 4; } .curve.d2 { stroke-dasharray: 2 3; }
pre { background: var(--shade); padding: .8rem; overflow-x: auto; font-size: .8rem; } summary { cursor: pointer; margin: .8rem 0; }
@media print { :root { color-scheme: light; --page: #fff; --ink: #000; --soft: #444; --line: #ccc; --shade: #f4f4f4; --ok: #1e7d4f; --warn: #9a6200;
  --bad: #b3261e; --c0: #1b6ca8; --c1: #d1600a; --c2: #27825a; --c3: #8e44ad; --c4: #b03a2e; --c5: #7f6000; --c6: #c2185b; --c7: #5d6d7e; }
  figure, tr, li { break-inside: avoid; } h2, h3 { break-after: avoid; } body { font-size: 10pt; max-width: none; padding: 0; }
  .wide { overflow: visible; } table { font-size: 8pt; } th, td { overflow-wrap: anywhere; } pre { white-space: pre-wrap; } }
)css";

}  // namespace hyperlattice::report
