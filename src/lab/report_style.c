/* report_style.c: the CSS of the report (report.h). */
#include "lab/report.h"

static const char *const STYLE[] = {
    ":root{color-scheme:light dark;--ink:#1b1f24;--soft:#57606a;--page:#fff;--panel:#f5f7f9;--line:#d0d7de;--accent:#0b62a8}",
    "@media (prefers-color-scheme:dark){",
    ":root{--ink:#e6e9ed;--soft:#a3adb8;--page:#0f1317;--panel:#15191f;--line:#39424d;--accent:#79bfff}}",
    "*{box-sizing:border-box}",
    "body{margin:0 auto;max-width:72rem;padding:1rem;background:var(--page);color:var(--ink);",
    "font:1rem/1.5 system-ui,sans-serif;overflow-wrap:break-word}",
    "h1{font-size:1.7rem;line-height:1.2}h2{margin-top:3rem;border-bottom:1px solid var(--line)}h3{margin:2rem 0 .5rem}",
    "a{color:var(--accent)}nav ul{display:flex;flex-wrap:wrap;gap:.3rem 1.2rem;padding:0;list-style:none}",
    ".lead,.note{color:var(--soft)}code,pre{font:.85rem/1.4 ui-monospace,monospace}",
    "pre{background:var(--panel);padding:.7rem;overflow-x:auto;border:1px solid var(--line);border-radius:6px}",
    "li{margin:.25rem 0}",
    /* Tables scroll sideways on narrow screens. */
    ".scroll{overflow-x:auto}figure.table{margin:1.2rem 0}table{border-collapse:collapse;font-variant-numeric:tabular-nums;font-size:.9rem}",
    "th,td{padding:.25rem .6rem;border-bottom:1px solid var(--line);text-align:right;white-space:nowrap}",
    "thead th{background:var(--panel);vertical-align:bottom}tbody th{font-weight:600}",
    "th:first-child{text-align:left;position:sticky;left:0;background:var(--page)}thead th:first-child{background:var(--panel)}",
    "th button{all:unset;cursor:pointer;white-space:normal}th button:focus-visible{outline:2px solid var(--accent)}",
    "th[aria-sort=ascending] button::after{content:' \\25B2'}th[aria-sort=descending] button::after{content:' \\25BC'}",
    /* Pictures. */
    ".grid{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(100%,12rem),1fr));gap:.8rem;margin:1rem 0}",
    ".grid figure,.plots figure{margin:0}.grid img{width:100%;height:auto;image-rendering:pixelated;display:block}",
    "figcaption{font-size:.85rem;color:var(--soft)}",
    ".plots{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,26rem),1fr));gap:1rem}",
    ".plots .plot{width:100%;border:1px solid var(--line);border-radius:6px}",
    ".scale{display:flex;gap:.6rem;align-items:center;font-size:.85rem;color:var(--soft)}",
    ".scale i{flex:0 1 14rem;height:.8rem;background:linear-gradient(90deg,#00f,#0f0);print-color-adjust:exact}",
    /* The viewer. */
    ".viewer{background:var(--panel);border:1px solid var(--line);border-radius:6px;padding:.7rem;margin:1rem 0}",
    ".viewer fieldset{border:0;margin:0;padding:0;display:inline-flex;flex-wrap:wrap;gap:.2rem 1rem}",
    ".viewer .bar{display:flex;flex-wrap:wrap;gap:.5rem 1rem;align-items:center;margin-bottom:.6rem}",
    ".viewer select,.viewer .bar button{font:inherit;color:inherit;background:var(--page);border:1px solid var(--line);",
    "border-radius:4px;min-height:2.2rem;padding:.1rem .6rem}.viewer .bar button{min-width:2.4rem;cursor:pointer}",
    ".viewer label{display:inline-flex;gap:.3rem;align-items:center;min-height:2.2rem}",
    ".viewer .views{display:grid;gap:.5rem;grid-template-columns:1fr}",
    ".viewer .views.side{grid-template-columns:repeat(auto-fit,minmax(min(100%,18rem),1fr))}",
    ".viewer .views div{min-width:0}.viewer .views b{font-size:.85rem;font-weight:600}",
    ".viewer canvas{width:100%;display:block;touch-action:pan-y;cursor:crosshair;background:#000}",
    ".viewer canvas:focus-visible,.viewer :focus-visible{outline:2px solid var(--accent);outline-offset:1px}",
    ".viewer input[type=range]{width:100%;accent-color:var(--accent)}",
    ".viewer output{display:block;white-space:pre-wrap;font:.85rem/1.4 ui-monospace,monospace;min-height:5.6em;margin-top:.4rem}",
    "[hidden]{display:none!important}",
    "@media print{body{max-width:none;padding:0;font-size:10pt;color:#000;background:#fff}.viewer,nav{display:none!important}",
    ":root{--ink:#000;--soft:#444;--page:#fff;--panel:#f5f7f9;--line:#bbb;--accent:#000}",
    "figure,table,li,pre{break-inside:avoid}h2,h3{break-after:avoid}.scroll{overflow:visible}",
    "table{font-size:7.5pt}th,td{padding:.1rem .3rem;white-space:normal}",
    ".grid{grid-template-columns:repeat(5,1fr)}.plots{grid-template-columns:1fr 1fr}}",
};

void report_style(FILE *f)
{
    for (size_t i = 0; i < sizeof STYLE / sizeof STYLE[0]; i++)
        fprintf(f, "%s\n", STYLE[i]);
}
