"use strict";
// Tables that sort and copy, pictures in four views, colours of the plots by theme.
function cells(row) { return [...row.cells].map(cell => cell.textContent.trim()); }

function sortBy(table, column, header) {
  const down = header.getAttribute("aria-sort") === "ascending";
  for (const other of table.tHead.rows[0].cells) other.removeAttribute("aria-sort");
  header.setAttribute("aria-sort", down ? "descending" : "ascending");
  const value = row => { const text = row.cells[column].textContent.trim(), number = parseFloat(text.replaceAll(",", "")); return Number.isNaN(number) ? text : number; };
  const rows = [...table.tBodies[0].rows].sort((a, b) => {
    const [x, y] = [value(a), value(b)];
    if (x === "" || y === "") return (x === "") - (y === "");
    return (typeof x === typeof y ? (x < y ? -1 : x > y ? 1 : 0) : typeof x === "number" ? -1 : 1) * (down ? -1 : 1);
  });
  table.tBodies[0].append(...rows);
}

function csv(table) {
  const quoted = text => /[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
  return [...table.rows].map(row => cells(row).map(quoted).join(",")).join("\n") + "\n";
}

function latex(table) {
  const escaped = text => text.replace(/[\\{}$&#_%^~]/g, mark => ({ "\\": "\\textbackslash{}", "^": "\\^{}", "~": "\\~{}" })[mark] || "\\" + mark);
  const lines = [...table.rows].map(row => cells(row).map(escaped).join(" & ") + " \\\\");
  const kinds = [...table.rows[0].cells].map((_, k) => table.tBodies[0].rows[0]?.cells[k]?.classList.contains("number") ? "r" : "l").join("");
  return `\\begin{tabular}{${kinds}}\n\\hline\n${lines[0]}\n\\hline\n${lines.slice(1).join("\n")}\n\\hline\n\\end{tabular}\n`;
}

async function copy(button, text) {
  const said = button.textContent;
  try { await navigator.clipboard.writeText(text); }
  catch { const area = document.createElement("textarea"); area.value = text; document.body.append(area); area.select(); document.execCommand("copy"); area.remove(); }
  button.dataset.copied = text;
  button.textContent = "copied";
  setTimeout(() => { button.textContent = said; }, 1200);
}

for (const table of document.querySelectorAll("table.sorts"))
  [...table.tHead.rows[0].cells].forEach((header, column) => header.querySelector("button").addEventListener("click", () => sortBy(table, column, header)));
for (const button of document.querySelectorAll("button[data-copy]"))
  button.addEventListener("click", () => { const table = document.getElementById(button.dataset.table); copy(button, button.dataset.copy === "csv" ? csv(table) : latex(table)); });

for (const choice of document.querySelectorAll(".views input"))
  choice.addEventListener("change", () => {
    for (const part of choice.closest(".views").querySelectorAll("[data-view]")) part.hidden = part.dataset.view !== choice.value;
  });
for (const blink of document.querySelectorAll("button.blink"))
  blink.addEventListener("click", () => { const [a, b] = blink.querySelectorAll("img"); a.hidden = !a.hidden; b.hidden = !b.hidden; });

function ink() { return getComputedStyle(document.documentElement).getPropertyValue("--ink").trim(); }

// Curves and their names on dark paper: the same hues, lighter.
const LIGHTER = { "#1f5fa8": "#7fb0e6", "#2f8f4e": "#6fcf8f", "#a8324a": "#ea8aa0", "#6b4fa0": "#b9a5dd", "#8a6d3b": "#cdb58a", "#3378bf": "#7db4ee", "#bf3845": "#ee8089", "#599e5c": "#8fd0a4" };
function isDark() { return getComputedStyle(document.documentElement).getPropertyValue("--dark").trim() === "1"; }
function figureOf(plot) {
  const text = plot.figureText ??= plot.querySelector("script").textContent;
  const figure = JSON.parse(isDark() ? text.replace(/#[0-9a-f]{6}/g, color => LIGHTER[color] || color) : text);
  figure.layout.font = { ...figure.layout.font, color: ink() };
  return figure;
}

// What the first screen shows is drawn at once; the other plots, of which a page has dozens, when they come near the window.
function drawAnew(plot) {
  const figure = figureOf(plot);
  Plotly.newPlot(plot, figure.data, figure.layout, { responsive: true, displaylogo: false, displayModeBar: "hover" });
}
function draw(plot) {
  if (plot.dataset.drawn) return;
  plot.dataset.drawn = "1";
  drawAnew(plot);
}
function drawAll() { for (const plot of document.querySelectorAll(".plot")) draw(plot); }
const near = new IntersectionObserver(seen => { for (const each of seen) if (each.isIntersecting) { near.unobserve(each.target); draw(each.target); } }, { rootMargin: "600px" });
function onFirstScreen(plot) { const box = plot.getBoundingClientRect(); return box.width > 0 && box.top < window.innerHeight; }
for (const plot of document.querySelectorAll(".plot")) onFirstScreen(plot) ? draw(plot) : near.observe(plot);

function colours() { for (const plot of document.querySelectorAll(".js-plotly-plot")) drawAnew(plot); }
const theme = document.getElementById("theme");
theme?.addEventListener("click", () => {
  document.documentElement.dataset.theme = isDark() ? "light" : "dark";
  colours();
});
// Paper is white, whatever the screen is.
let screenTheme;
window.addEventListener("beforeprint", () => { screenTheme = document.documentElement.dataset.theme; document.documentElement.dataset.theme = "light"; drawAll(); colours(); });
window.addEventListener("afterprint", () => { if (screenTheme) document.documentElement.dataset.theme = screenTheme; else delete document.documentElement.dataset.theme; colours(); });
for (const more of document.querySelectorAll("details")) more.addEventListener("toggle", () => { for (const plot of more.querySelectorAll(".js-plotly-plot")) Plotly.Plots.resize(plot); });
