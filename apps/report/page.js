"use strict";
// Shows the record of one evaluation. Everything is in this file: figures in #record, and the maps of each scene,
// which are decoded when the scene is opened, in elements of their own.

const record = JSON.parse(document.getElementById("record").textContent);
const COLORS = ["#2f6fed", "#e4572e", "#17a398", "#a05195", "#e09f1f", "#6a994e", "#d1495b", "#3d9bd1", "#8d6a9f",
                "#b07d2b", "#5b6ee1", "#7d8780", "#f2739b"];
const REGIONS = {all: "all", nocc: "non-occluded"};
const shown = {region: record.region, metric: "bad-1", everyColumn: false, orders: {}};

const byId = (id) => document.getElementById(id);
const columnIndex = (name) => record.columns.findIndex((column) => column.name === name);
const colorOf = (method) => COLORS[record.methods.indexOf(method) % COLORS.length];
const isPeer = (method) => record.peers.includes(method);
const biggerIsBetter = (column) => column.name === "coverage";
const counted = (count, thing) => `${count} ${thing}${count === 1 ? "" : "s"}`;
const text = (value, column) => value == null ? "–" : value.toFixed(column.decimals);

/** An element with attributes (functions become listeners) and children. */
function make(tag, attributes = {}, ...children) {
  const svg = ["svg", "g", "line", "path", "circle", "text", "title"].includes(tag);
  const element = svg ? document.createElementNS("http://www.w3.org/2000/svg", tag) : document.createElement(tag);
  for (const [name, value] of Object.entries(attributes))
    if (typeof value === "function") element.addEventListener(name, value);
    else if (value !== undefined && value !== false) element.setAttribute(name, value);
  element.append(...children.filter((child) => child != null));
  return element;
}

const dot = (method) => make("span", {class: "dot", style: `background:${colorOf(method)}`});

// ---- Tables

/**
 * `columns`: {name, description}; `rows`: {head, label, cells: [{value, text}], last}. Cells sort by value; unknown
 * ones and rows that are `last` stay below. The order is remembered under `key` for the next table of that kind.
 */
function sortableTable(key, first, columns, rows, best) {
  const body = make("tbody"), names = [first, ...columns].map((column) => column.name);
  const heads = [first, ...columns].map((column, i) => make("th", {scope: "col", title: column.description},
      make("button", {click: () => choose(names[i])}, column.name)));
  const order = shown.orders[key] ??= {column: null, sign: 1};
  const keyOf = (row, i) => i === 0 ? row.label : row.cells[i - 1].value;
  function choose(name) {
    order.sign = order.column === name ? -order.sign : 1;
    order.column = name;
    sort();
  }
  function sort() {
    const i = names.indexOf(order.column);
    heads.forEach((head, k) => k === i
        ? head.setAttribute("aria-sort", order.sign > 0 ? "ascending" : "descending") : head.removeAttribute("aria-sort"));
    const compare = (a, b) => typeof a === "string" ? a.localeCompare(b) : a - b;
    if (i >= 0) rows.sort((a, b) => {
      const [p, q] = [keyOf(a, i), keyOf(b, i)];
      if (!!a.last !== !!b.last) return a.last ? 1 : -1;
      if (p == null || q == null) return (p == null) - (q == null);
      return order.sign * compare(p, q);
    });
    fill();
  }
  const fill = () => body.replaceChildren(...rows.map((row) => make("tr", {class: row.last && "mean"},
      make("th", {scope: "row"}, row.head()),
      ...row.cells.map((cell) => make("td", {class: best(row, cell) && "best"}, cell.text)))));
  sort();
  return make("table", {}, make("thead", {}, make("tr", {}, ...heads)), body);
}

/** The best of several values; null if they do not differ. */
function bestOf(values, column) {
  const known = values.filter((value) => value != null), low = Math.min(...known), high = Math.max(...known);
  return low < high ? (biggerIsBetter(column) ? high : low) : null;
}

/** Methods down, figures across; `figuresOf(method)` gives a value per column, `countOf(method)` a number of scenes. */
function methodTable(key, figuresOf, countOf) {
  const used = record.columns.map((column, i) => i).filter((i) =>
      (shown.everyColumn || record.columns[i].main) && record.methods.some((m) => figuresOf(m)?.[i] != null));
  const bests = used.map((i) => bestOf(record.methods.map((m) => figuresOf(m)?.[i]), record.columns[i]));
  const rows = record.methods.filter(figuresOf).map((method) => ({
    label: method,
    head: () => make("span", {}, dot(method), method),
    cells: used.map((i, k) => ({value: figuresOf(method)[i], k, text: text(figuresOf(method)[i], record.columns[i])})),
  }));
  const columns = used.map((i) => record.columns[i]);
  if (countOf) {
    columns.push({name: "scenes", description: "how many are behind the errors' means"});
    for (const row of rows) row.cells.push({value: countOf(row.label), text: countOf(row.label)});
  }
  return sortableTable(key, {name: "method"}, columns, rows,
                       (row, cell) => cell.value != null && cell.value === bests[cell.k]);
}

function sceneTable() {
  const i = columnIndex(shown.metric), column = record.columns[i];
  const cellsOf = (figures) => record.methods.map((method) => {
    const value = figures(method)?.[i];
    return {value, text: text(value, column)};
  });
  const rows = record.scenes.map((scene, k) => ({
    label: scene.name,
    head: () => make("a", {href: `#scene-${k}`}, scene.name),
    cells: cellsOf((method) => scene.methods[method]?.[shown.region]),
  }));
  rows.push({label: "mean", last: true, head: () => "mean", cells: cellsOf((m) => record.means[m][shown.region])});
  for (const row of rows) row.best = bestOf(row.cells.map((cell) => cell.value), column);
  return sortableTable("scenes", {name: "scene"}, record.methods.map((name) => ({name})), rows,
                       (row, cell) => cell.value != null && cell.value === row.best);
}

// ---- Charts

function ticksOf(low, high, count) {
  const raw = (high - low) / count, power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= raw);
  const ticks = [];
  for (let t = Math.ceil(low / step) * step; t <= high + step * 1e-6; t += step) ticks.push(+t.toPrecision(12));
  return ticks;
}

function logTicksOf(low, high) {
  const ticks = [];
  for (let p = Math.floor(low); p <= high; ++p)
    for (const m of high - low > 2 ? [1] : [1, 2, 5]) if (p + Math.log10(m) >= low && p + Math.log10(m) <= high)
      ticks.push(p + Math.log10(m));
  return ticks;
}

/** Axes with grid lines; returns the SVG and the two scales. */
function axes(width, height, x, y) {
  const box = {left: 46, right: width - 12, top: 10, bottom: height - 36};
  const svg = make("svg", {viewBox: `0 0 ${width} ${height}`, height, role: "img"});
  const toX = (v) => box.left + (v - x.low) / (x.high - x.low) * (box.right - box.left);
  const toY = (v) => box.bottom - (v - y.low) / (y.high - y.low) * (box.bottom - box.top);
  for (const tick of y.ticks) svg.append(
      make("line", {class: "grid", x1: box.left, x2: box.right, y1: toY(tick), y2: toY(tick)}),
      make("text", {x: box.left - 6, y: toY(tick) + 4, "text-anchor": "end"}, y.text(tick)));
  for (const tick of x.ticks) svg.append(
      make("line", {class: "grid", x1: toX(tick), x2: toX(tick), y1: box.top, y2: box.bottom}),
      make("text", {x: toX(tick), y: box.bottom + 15, "text-anchor": "middle"}, x.text(tick)));
  svg.append(make("text", {x: box.right, y: height - 5, "text-anchor": "end"}, x.label),
             make("text", {x: box.left + 6, y: box.top + 12}, y.label));
  return {svg, toX, toY, box};
}

/** Of points {x, y}, those that no other equals or beats in both, from left to right. */
function frontOf(points) {
  const sorted = [...points].sort((a, b) => a.x - b.x || a.y - b.y);
  return sorted.filter((p, i) => sorted.slice(0, i).every((q) => q.y > p.y));
}

/** Height of the line through the points of a front: straight between them, level after the last; NaN before. */
function heightAt(front, x) {
  const next = front.findIndex((p) => p.x >= x);
  if (next < 0) return front.length ? front[front.length - 1].y : NaN;
  const [p, q] = [front[next - 1], front[next]];
  if (!p) return q.x === x ? q.y : NaN;
  return p.y + (q.y - p.y) * (x - p.x) / (q.x - p.x);
}

/** What the line of our presets leaves to say about the others. */
function standing(front, others) {
  const names = (points) => points.map((p) => p.method).join(", ") || "none";
  return make("p", {class: "aside"}, `Below our line: ${names(others.filter((p) => p.y < heightAt(front, p.x)))}. ` +
              `Faster than all of it: ${names(others.filter((p) => p.x < front[0].x))}.`);
}

function scatter(width) {
  const time = columnIndex("s/MP"), error = columnIndex(shown.metric), column = record.columns[error];
  const points = record.methods.map((method) => ({method, figures: record.means[method][shown.region]}))
      .filter((p) => p.figures[time] > 0 && p.figures[error] != null)
      .map((p) => ({method: p.method, x: Math.log10(p.figures[time]), y: p.figures[error]}));
  if (!points.length) return make("p", {}, "nothing to show");
  const xs = points.map((p) => p.x), top = Math.max(1e-3, reachOf(points.map((p) => [[p.x, p.y]])));
  const low = Math.min(...xs) - 0.25, high = Math.max(...xs) + 0.45;
  const {svg, toX, toY, box} = axes(width, 320,
      {low, high, ticks: logTicksOf(low, high), text: (t) => `${+(10 ** t).toPrecision(2)}`, label: "s/MP, log scale"},
      {low: 0, high: top, ticks: ticksOf(0, top, 5), text: (t) => t, label: `${column.name}, mean`});
  const ours = (p) => record.presets.includes(p.method);
  const front = biggerIsBetter(column) ? [] : frontOf(points.filter(ours));
  if (front.length) svg.append(make("path", {
    d: `M${toX(front[0].x)} ${box.top}` + front.map((p) => `L${toX(p.x)} ${toY(p.y)}`).join("") + `H${box.right}`,
    fill: "none", class: "front"}));
  const shownY = (p) => toY(Math.min(p.y, top));  // what is far above the others, at the upper edge with its value
  const nameOf = (p) => p.y > top ? `${p.method} ↑ ${text(p.y, column)}` : p.method;
  const taken = points.map((p) => ({x: toX(p.x) - 6, y: shownY(p) - 6, w: 12, h: 12}));
  const shared = (p, q, x, w) => Math.max(0, Math.min(p[x] + p[w], q[x] + q[w]) - Math.max(p[x], q[x]));
  const covered = (p) => taken.reduce((sum, q) => sum + shared(p, q, "x", "w") * shared(p, q, "y", "h"), 0);
  for (const point of points) {
    const px = toX(point.x), py = shownY(point), w = nameOf(point).length * 7.4, h = 13;
    const spots = [[9, -6], [-9 - w, -6], [-w / 2, -21], [-w / 2, 8], [9, 6], [9, -20], [-9 - w, 8], [-9 - w, -20],
                   [-w / 2, 22], [-w / 2, -36]];
    const places = spots.map(([dx, dy]) => ({x: px + dx, y: py + dy, w, h}));
    const outside = (p) => p.x <= box.left || p.x + w >= width || p.y <= 0 || p.y + h >= box.bottom;
    const cost = (p) => covered(p) + (outside(p) ? 1e6 : 0);
    const place = places.reduce((best, p) => cost(p) < cost(best) ? p : best);  // the first, if several are free
    taken.push(place);
    svg.append(make("circle", {cx: px, cy: py, r: 5, fill: colorOf(point.method)},
                    make("title", {}, `${point.method}: ${text(point.y, column)}, ${(10 ** point.x).toPrecision(3)} s/MP`)),
               make("text", {class: "name", x: place.x, y: place.y + 11}, nameOf(point)));
  }
  return front.length ? make("div", {}, svg, standing(front, points.filter((p) => !ours(p)))) : svg;
}

/** Value `k` of a curve's points at `coverage`, between them; below the first, its. */
function curveAt(curve, coverage, k) {
  const i = curve.findIndex((point) => point[0] >= coverage);
  if (i <= 0) return curve[0][k];
  const [a, b] = [curve[i - 1], curve[i]];
  return a[k] + (b[k] - a[k]) * (coverage - a[0]) / (b[0] - a[0]);
}

const meanOf = (values) => values.reduce((a, b) => a + b) / values.length;

/** Mean curve and mean oracle at each percent of coverage that every scene reaches: the same scenes all along. */
function meanCurve(method, scenes) {
  const curves = scenes.map((scene) => scene.methods[method]?.curves[shown.region]).filter((curve) => curve?.length);
  const reached = Math.min(...curves.map((curve) => curve.at(-1)[0]));
  const stops = curves.length ? [...Array(50).keys()].map((k) => 2 * k + 2).filter((stop) => stop < reached) : [];
  if (curves.length) stops.push(reached);
  return [1, 2].map((k) => stops.map((stop) => [stop, meanOf(curves.map((curve) => curveAt(curve, stop, k)))]));
}

/** Mean bias and root mean square of each bin, over the scenes that have inliers there. */
function meanSubpixel(method, scenes) {
  const all = scenes.map((scene) => scene.methods[method]?.subpixel[shown.region]).filter((bins) => bins?.length);
  const count = all[0]?.length ?? 0;
  return [0, 1].map((k) => [...Array(count).keys()]
      .map((bin) => [(bin + 0.5) / count, all.map((bins) => bins[bin][k]).filter((value) => value != null)])
      .filter(([, values]) => values.length).map(([x, values]) => [x, meanOf(values)]));
}

/** Twice the median of what the lines reach, or the most if that is less: one bad line does not flatten the others. */
function reachOf(lines) {
  const most = lines.map((points) => Math.max(...points.map((p) => Math.abs(p[1])))).sort((a, b) => a - b);
  return Math.min(most.at(-1), 2 * most[most.length >> 1]) * 1.08 || 1;
}

/** `linesOf(method)`: [solid, dotted], each a list of points, empty if there are none. `x`, `y`: see axes(). */
function lineChart(linesOf, nothing, x, yOf) {
  return (width) => {
    const series = record.methods.map((method) => ({method, lines: linesOf(method)})).filter((s) => s.lines[0].length);
    if (!series.length) return make("p", {}, nothing);
    const {svg, toX, toY, box} = axes(width, 320 - 24, x, yOf(series));
    const [w, h] = [box.right - box.left, box.bottom - box.top];
    const inside = make("svg", {x: box.left, y: box.top, width: w, height: h,  // cuts off what leads out
                                viewBox: `${box.left} ${box.top} ${w} ${h}`});
    for (const {method, lines} of series)
      lines.forEach((points, k) => inside.append(make("path", {
        d: points.map((p, i) => `${i ? "L" : "M"}${toX(p[0]).toFixed(1)} ${toY(p[1]).toFixed(1)}`).join(""),
        fill: "none", stroke: colorOf(method), "stroke-width": k ? 1.3 : 2, class: k ? "dotted" : undefined,
        "stroke-dasharray": k ? "1.5 3" : isPeer(method) ? "5 4" : undefined,
      }, make("title", {}, method))));
    svg.append(inside);
    const legend = make("div", {class: "legend"}, ...series.map((s) => make("span", {}, dot(s.method), s.method)));
    return make("div", {}, svg, legend);
  };
}

function coverageChart(scenes) {
  const x = {low: 0, high: 100, ticks: [0, 20, 40, 60, 80, 100], text: (t) => t, label: "pixels kept, %"};
  return lineChart((method) => meanCurve(method, scenes), "no method gave a confidence", x, (series) => {
    const high = reachOf(series.map((s) => s.lines[0]));
    return {low: 0, high, ticks: ticksOf(0, high, 5), text: (t) => t, label: "wrong-1, %"};
  });
}

function subpixelChart(scenes) {
  const x = {low: 0, high: 1, ticks: [0, 0.25, 0.5, 0.75, 1], text: (t) => t, label: "fraction of the true disparity"};
  return lineChart((method) => meanSubpixel(method, scenes), "there are no inliers", x, (series) => {
    const high = reachOf(series.map((s) => s.lines[1])), low = -reachOf(series.map((s) => s.lines[0]));
    return {low, high, ticks: ticksOf(low, high, 6), text: (t) => t, label: "px"};
  });
}

/** Keeps `draw(width)` as wide as its holder. */
function keepDrawn(holder, draw) {
  const redraw = () => holder.clientWidth && holder.replaceChildren(draw(holder.clientWidth));
  holder.watcher?.disconnect();
  holder.watcher = new ResizeObserver(redraw);
  holder.watcher.observe(holder);
  redraw();
}

// ---- Maps

const bytesOf = (base64) => Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));

async function pixelsOf(bytes, type) {
  const bitmap = await createImageBitmap(new Blob([bytes], {type}),
                                         {colorSpaceConversion: "none", premultiplyAlpha: "none"});
  const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
  const context = canvas.getContext("2d", {willReadFrequently: true});
  context.drawImage(bitmap, 0, 0);
  return context.getImageData(0, 0, bitmap.width, bitmap.height);
}

/** Disparities in pixels, NaN unknown: the upper half of the gray picture has the high bytes, the lower the low. */
async function disparitiesOf(scene, base64) {
  const {data, width, height} = await pixelsOf(bytesOf(base64), "image/png");
  const count = width * height / 2, values = new Float32Array(count);
  for (let i = 0; i < count; ++i) {
    const code = data[4 * i] * 256 + data[4 * (i + count)];
    values[i] = code ? scene.low + (code - 1) * scene.step : NaN;
  }
  return {values, width, height: height / 2};
}

const rgb = (hex) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16));
const PALETTES = {disparity: record.palettes.disparity.map(rgb), error: record.palettes.error.map(rgb)};
const gradient = (kind) => `background:linear-gradient(90deg,${record.palettes[kind].filter((_, i) => i % 15 === 0)})`;

/** A canvas painted by `colorAt(i)`, which answers with [r, g, b]. */
function paint(width, height, colorAt) {
  const canvas = make("canvas", {width, height, tabindex: 0});
  const image = new ImageData(width, height);
  for (let i = 0; i < width * height; ++i) {
    const [r, g, b] = colorAt(i);
    image.data.set([r, g, b, 255], 4 * i);
  }
  canvas.getContext("2d").putImageData(image, 0, 0);
  return canvas;
}

const inPalette = (palette, share) => palette[Math.round(255 * Math.min(1, Math.max(0, share)))];

function paintDisparity(scene, map) {
  const {low, high} = scene.range;
  return paint(map.width, map.height, (i) => Number.isNaN(map.values[i]) ? [0, 0, 0]
      : inPalette(PALETTES.disparity, (map.values[i] - low) / (high - low)));
}

function paintError(map, truth) {
  return paint(map.width, map.height, (i) => {
    const error = Math.abs(map.values[i] - truth.values[i]);
    if (Number.isNaN(truth.values[i])) return [0, 0, 0];
    return Number.isNaN(error) ? [255, 255, 255] : inPalette(PALETTES.error, error / record.errorLimit);
  });
}

/** What the pixel under the pointer says, beside the pointer. */
function readAt(event, canvas, view) {
  const box = canvas.getBoundingClientRect(), scale = Math.min(box.width / canvas.width, box.height / canvas.height);
  const x = Math.floor((event.clientX - box.left - (box.width - canvas.width * scale) / 2) / scale);
  const y = Math.floor((event.clientY - box.top - (box.height - canvas.height * scale) / 2) / scale);
  const reading = byId("reading");
  reading.hidden = x < 0 || y < 0 || x >= canvas.width || y >= canvas.height;
  if (reading.hidden) return;
  reading.textContent = view.read(x, y);
  const holder = byId("viewer").open ? byId("viewer") : document.body;
  if (reading.parentNode !== holder) holder.append(reading);
  const right = event.clientX + 16 + reading.offsetWidth > innerWidth;
  reading.style.left = `${right ? Math.max(4, event.clientX - 12 - reading.offsetWidth) : event.clientX + 14}px`;
  reading.style.top = `${Math.max(4, event.clientY - 34)}px`;
}

function readable(canvas, view) {
  canvas.addEventListener("pointermove", (event) => readAt(event, canvas, view));
  canvas.addEventListener("pointerdown", (event) => readAt(event, canvas, view));
  canvas.addEventListener("pointerleave", () => { byId("reading").hidden = true; });
  return canvas;
}

/** What can be looked at in a scene: {title, canvas, read(x, y)}, in the order of the page. */
async function viewsOf(scene, data) {
  const px = (value) => Number.isNaN(value) ? "unknown" : `${value.toFixed(2)} px`;
  const place = (x, y) => `x ${x * scene.stride}, y ${y * scene.stride}: `;
  const left = await pixelsOf(bytesOf(data.left), "image/jpeg");
  const views = [{title: "left image", canvas: paint(left.width, left.height, (i) => left.data.subarray(4 * i, 4 * i + 3)),
                  read: (x, y) => place(x, y) + [...left.data.subarray(4 * (y * left.width + x)).slice(0, 3)].join(" ")}];
  const truth = data.truth && await disparitiesOf(scene, data.truth);
  const at = (map, x, y) => map.values[y * map.width + x];
  if (truth) views.push({title: "ground truth", canvas: paintDisparity(scene, truth),
                         read: (x, y) => place(x, y) + px(at(truth, x, y))});
  for (const method of record.methods) {
    if (!data.maps[method]) continue;
    const map = await disparitiesOf(scene, data.maps[method]);
    const read = (x, y) => place(x, y) + px(at(map, x, y)) + (truth
        ? ` (truth ${px(at(truth, x, y))}, error ${px(Math.abs(at(map, x, y) - at(truth, x, y)))})` : "");
    views.push({method, title: `${method}: disparity`, canvas: paintDisparity(scene, map), read});
    if (truth) views.push({method, title: `${method}: error`, canvas: paintError(map, truth), read});
  }
  return views;
}

// ---- The viewer: one map as large as the window

const viewer = {views: [], index: 0};

function enlarge(views, index) {
  viewer.views = views;
  viewer.index = (index + views.length) % views.length;
  const view = views[viewer.index], copy = make("canvas", {width: view.canvas.width, height: view.canvas.height});
  copy.getContext("2d").drawImage(view.canvas, 0, 0);
  byId("caption").textContent = view.title;
  byId("viewer").querySelector(".stage").replaceChildren(readable(copy, view));
  byId("reading").hidden = true;
  if (!byId("viewer").open) byId("viewer").showModal();
}

byId("viewer").addEventListener("click", (event) => {
  if (event.target.dataset.step) enlarge(viewer.views, viewer.index + Number(event.target.dataset.step));
  if ("close" in event.target.dataset) byId("viewer").close();
});
byId("viewer").addEventListener("keydown", (event) => {
  const step = {ArrowLeft: -1, ArrowRight: 1}[event.key];
  if (step) enlarge(viewer.views, viewer.index + step);
});
byId("viewer").addEventListener("close", () => { byId("reading").hidden = true; });

// ---- Pages

function figureOf(views, chosen, caption) {
  const pair = make("div", {class: "pair"});
  for (const view of chosen) {
    const open = () => enlarge(views, views.indexOf(view));
    view.canvas.addEventListener("click", open);
    view.canvas.addEventListener("keydown", (event) => event.key === "Enter" && open());
    view.canvas.setAttribute("aria-label", view.title);
    pair.append(readable(view.canvas, view));
  }
  return make("figure", {}, pair, make("figcaption", {}, ...caption));
}

function captionOf(scene, method) {
  const figures = scene.methods[method][shown.region];
  const parts = ["bad-1", "bad-2", "avg", "ms"].map((name) => {
    const i = columnIndex(name);
    return figures?.[i] == null ? null : make("span", {}, `${name} ${text(figures[i], record.columns[i])}`);
  });
  return [make("strong", {}, dot(method), method), ...parts];
}

async function showScene(index) {
  const page = byId("scene"), scene = record.scenes[index];
  const step = (by) => { location.hash = `#scene-${(index + by + record.scenes.length) % record.scenes.length}`; };
  const maps = make("div", {class: "maps"}), curves = make("div"), subpixel = make("div");
  const range = scene.range;
  page.replaceChildren(
      make("nav", {}, make("a", {href: "#"}, "← all scenes"), make("h2", {}, scene.name),
           make("span", {class: "aside"}, `${scene.width} × ${scene.height}, ${scene.disparities} disparities searched`),
           make("button", {click: () => step(-1)}, "previous"), make("button", {click: () => step(1)}, "next")),
      make("div", {class: "wide scene-table"}, methodTable("scene", (method) => scene.methods[method]?.[shown.region])),
      make("div", {class: "scale"},
           make("span", {}, `far, ${range.low.toFixed(1)} px`, make("i", {style: gradient("disparity")}),
                `${range.high.toFixed(1)} px, near`),
           make("span", {}, "error 0", make("i", {style: gradient("error")}), `${record.errorLimit} px and more`),
           make("span", {}, make("b", {style: "background:#fff"}), "no disparity"),
           make("span", {}, make("b", {style: "background:#000"}), "unknown")),
      maps, make("section", {class: "charts"},
                 make("figure", {}, make("figcaption", {}, "Wrong by more than 1 px among the pixels kept"), curves),
                 make("figure", {}, make("figcaption", {}, "Inliers' bias; dotted: root mean square"), subpixel)));
  byId("overview").hidden = true;
  page.hidden = false;
  scrollTo(0, 0);
  keepDrawn(curves, coverageChart([scene]));
  keepDrawn(subpixel, subpixelChart([scene]));
  const views = await viewsOf(scene, JSON.parse(byId(`data-${index}`).textContent));
  if (page.hidden || !maps.isConnected) return;  // another page was opened meanwhile
  maps.append(figureOf(views, views.filter((view) => !view.method),
                       [make("strong", {}, "left image, and ground truth")]));
  for (const method of record.methods) {
    const chosen = views.filter((view) => view.method === method);
    if (chosen.length) maps.append(figureOf(views, chosen, captionOf(scene, method)));
  }
  page.dataset.scene = scene.name;
}

function showOverview() {
  byId("scene").hidden = true;
  byId("overview").hidden = false;
  byId("means").replaceChildren(methodTable("means", (method) => record.means[method][shown.region],
                                             (method) => record.means[method].scenes[shown.region]));
  byId("scenes").replaceChildren(sceneTable());
  keepDrawn(byId("scatter"), scatter);
  keepDrawn(byId("curves"), coverageChart(record.scenes));
  keepDrawn(byId("subpixel"), subpixelChart(record.scenes));
}

function show() {
  const scene = /^#scene-(\d+)$/.exec(location.hash);
  byId("viewer").close();
  byId("reading").hidden = true;
  for (const button of byId("region").querySelectorAll("button"))
    button.setAttribute("aria-pressed", button.dataset.region === shown.region);
  if (scene && record.scenes[scene[1]]) return showScene(Number(scene[1]));
  showOverview();
}

function setUp() {
  byId("summary").textContent = `${counted(record.scenes.length, "scene")}, ${counted(record.methods.length, "method")}`;
  for (const [region, label] of Object.entries(REGIONS))
    byId("region").append(make("button", {"data-region": region, click: () => { shown.region = region; show(); }}, label));
  for (const column of record.columns)
    byId("metric").append(make("option", {value: column.name, selected: column.name === shown.metric}, column.name));
  byId("metric").addEventListener("change", (event) => { shown.metric = event.target.value; showOverview(); });
  byId("every-column").addEventListener("change", (event) => { shown.everyColumn = event.target.checked; showOverview(); });
  const remarks = [...record.problems, ...record.remarks];
  byId("problems").querySelector("ul").append(...remarks.map((remark) => make("li", {}, remark)));
  byId("problems").hidden = !remarks.length;
  for (const {name, value} of record.facts) byId("facts").append(make("dt", {}, name), make("dd", {}, value));
  for (const column of record.columns) byId("columns").append(make("dt", {}, column.name), make("dd", {}, column.description));
  addEventListener("hashchange", show);
  show();
  document.body.dataset.ready = "yes";
}

setUp();
