const NS = "http://www.w3.org/2000/svg";
const byId = (id) => document.getElementById(id);
const colour = (index) => `var(--c${index % 7})`;
const still = matchMedia("(prefers-reduced-motion: reduce)").matches;

function make(tag, attributes, parent, text) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes || {})) element.setAttribute(name, value);
  if (text !== undefined) element.textContent = text;
  if (parent) parent.append(element);
  return element;
}
function draw(tag, attributes, parent, text) {
  const element = document.createElementNS(NS, tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  if (text !== undefined) element.textContent = text;
  parent.append(element);
  return element;
}
const short = (value) => String(Number(value.toPrecision(4)));
function ticks(low, high, count) {
  const rough = (high - low) / count, power = 10 ** Math.floor(Math.log10(rough));
  const step = power * [1, 2, 5, 10].find((each) => each * power >= rough);
  const found = [];
  for (let n = Math.ceil(low / step - 1e-9); n <= high / step + 1e-9; n++) found.push(n * step);
  return found;
}
const points = (xs, ys, x, y) => xs.map((each, i) => `${x(each).toFixed(1)},${y(ys[i]).toFixed(1)}`).join(" ");

function legend(parent, names, first = 0) {
  names.forEach((name, index) => make("span", { style: `--key:${colour(first + index)}` }, parent, name));
}

/* One chart: series are {name, xs, ys, colour}; drawn again as the width changes, so that text keeps its size. */
function chart(parent, title, xLabel, yLabel, series, caption) {
  const figure = make("figure", {}, parent);
  make("h3", {}, figure, title);
  const svg = draw("svg", { role: "img", "aria-label": title }, figure);
  if (series.length > 1 || caption) {
    const box = make("div", { class: "legend" }, figure);
    if (series.length > 1) {
      series.filter((each) => each.name).forEach((each) => make("span",
        { style: `--key:${colour(each.colour)}` }, box, each.name));
    }
  }
  if (caption) make("figcaption", {}, figure, caption);
  const all = (pick) => series.flatMap(pick);
  const span = (values) => [Math.min(...values), Math.max(...values)];
  const [left, right] = span(all((each) => each.xs));
  let [low, high] = span(all((each) => each.ys).concat(0));
  const margin = 0.06 * (high - low || 1);
  if (low < 0) low -= margin;
  high += margin;
  function render() {
    const width = Math.max(figure.clientWidth - 24, 240), height = 220;
    const x = (value) => 52 + (value - left) / (right - left) * (width - 62);
    const y = (value) => height - 38 - (value - low) / (high - low) * (height - 50);
    svg.replaceChildren();
    svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    for (const value of ticks(low, high, 5)) {
      const ink = Math.abs(value) < 1e-12 ? "var(--soft)" : "var(--line)";
      draw("line", { x1: 52, x2: width - 10, y1: y(value), y2: y(value), stroke: ink, "stroke-width": 1 }, svg);
      draw("text", { x: 46, y: y(value) + 4, "text-anchor": "end" }, svg, short(value));
    }
    for (const value of ticks(left, right, width / 80)) {
      draw("text", { x: x(value), y: height - 22, "text-anchor": "middle" }, svg, short(value));
    }
    draw("text", { x: width - 10, y: height - 5, "text-anchor": "end" }, svg, xLabel);
    draw("text", { x: 4, y: 10 }, svg, yLabel);
    for (const each of series) {
      draw("polyline", { points: points(each.xs, each.ys, x, y), fill: "none", stroke: colour(each.colour),
        "stroke-width": 1.8, "stroke-linejoin": "round", "stroke-dasharray": each.dash || "none" }, svg);
    }
  }
  new ResizeObserver(render).observe(figure);
  render();
  return figure;
}

/* A table of text, the first column left and the others right; it scrolls where the page is narrow. */
function plainTable(parent, { title, columns, rows, note }) {
  make("h3", {}, parent, title);
  const table = make("table", { class: "plain" }, make("div", { class: "scroll" }, parent));
  const head = make("tr", {}, make("thead", {}, table)), body = make("tbody", {}, table);
  columns.forEach((column, index) => make("th", index ? { class: "number" } : {}, head, column));
  for (const row of rows) {
    const line = make("tr", {}, body);
    row.forEach((cell, index) => make("td", index ? { class: "number" } : {}, line, cell));
  }
  if (note) make("p", { class: "soft" }, parent, note);
}

/* A vehicle from the side, to scale. */
function sideView(parent, vehicle) {
  const figure = make("figure", {}, parent);
  make("h3", {}, figure, vehicle.name);
  const left = Math.min(...vehicle.units.map((unit) => unit.rear)) - 0.5;
  const right = Math.max(...vehicle.units.map((unit) => unit.front)) + 0.5;
  const top = Math.max(...vehicle.units.map((unit) => unit.height)) + 0.9;
  const svg = draw("svg", { viewBox: `${-right} ${-top} ${right - left} ${top + 1.3}`, role: "img",
    "aria-label": `${vehicle.name} from the side` }, figure);
  const text = { "text-anchor": "middle", style: `font-size:${Math.max((right - left) / 55, 0.28)}px` };
  draw("line", { x1: -right, x2: -left, y1: 0, y2: 0, stroke: "var(--line)", "stroke-width": 0.06 }, svg);
  vehicle.units.forEach((unit, index) => {
    draw("rect", { x: -unit.front, y: -unit.height, width: unit.front - unit.rear, height: unit.height - unit.floor,
      fill: colour(index), "fill-opacity": 0.2, stroke: colour(index), "stroke-width": 0.06 }, svg);
    draw("text", { ...text, x: -(unit.front + unit.rear) / 2, y: -unit.height - 0.25 }, svg,
      `${unit.name}, ${unit.mass}`);
    for (const [x, load] of unit.axles) {
      draw("circle", { cx: -x, cy: -0.5, r: 0.48, fill: "var(--ink)" }, svg);
      draw("text", { ...text, x: -x, y: 0.7 }, svg, load);
    }
    draw("circle", { cx: -unit.cg[0], cy: -unit.cg[1], r: 0.17, fill: unit.assumed ? "var(--sheet)" : "var(--ink)",
      stroke: "var(--ink)", "stroke-width": 0.06 }, svg);
    if (unit.hitch) {
      const [x, y] = unit.hitch;
      draw("path", { d: `M${-x} ${-y} l-0.2 -0.35 h0.4 z`, fill: "var(--ink)" }, svg);
    }
  });
  make("figcaption", {}, figure, "Axle loads in t. Circles: centres of gravity, hollow where the height is assumed; "
    + "triangles: hitches.");
}
