'use strict';
// Charts as SVG, drawn at the width that they have, so that their text is readable on every screen.

const svgNames = 'http://www.w3.org/2000/svg';

function svg(name, attributes, parent) {
  const made = document.createElementNS(svgNames, name);
  for (const key of Object.keys(attributes)) made.setAttribute(key, attributes[key]);
  if (parent) parent.appendChild(made);
  return made;
}

function element(name, attributes, text, parent) {
  const made = document.createElement(name);
  for (const key of Object.keys(attributes || {})) made.setAttribute(key, attributes[key]);
  if (text !== undefined && text !== null) made.textContent = text;
  if (parent) parent.appendChild(made);
  return made;
}

// A number in few digits: 0.0123, 1.2e-5, 1200.
function shown(value) {
  if (value === 0) return '0';
  const size = Math.abs(value);
  if (size >= 1e5 || size < 1e-3) return value.toExponential(2).replace(/\.?0+e/, 'e').replace('e+', 'e');
  return String(Number(value.toPrecision(4)));
}

// The lowest and the highest of some numbers. They may be too many to be arguments of Math.min.
function extent(values) {
  let low = Infinity, high = -Infinity;
  for (const value of values) {
    if (value < low) low = value;
    if (value > high) high = value;
  }
  return [low, high];
}

const seriesColour = (n, s) => (s.material ? `var(--m${s.material})` : `var(--c${n % 8})`);
const seriesShape = (n) => ['circle', 'square', 'triangle', 'diamond'][(Math.floor(n / 2) + Math.floor(n / 8)) % 4];  // with the colour, 32 that differ

function niceStep(span, count) {
  const raw = span / Math.max(1, count);
  const power = Math.pow(10, Math.floor(Math.log10(raw)));
  for (const step of [1, 2, 5, 10]) if (step * power >= raw * 0.999) return step * power;
  return 10 * power;
}

// An axis that maps values to pixels: {low, high, ticks, at(value)}.
function scaleOf(values, logarithmic, pixels, count, tight) {
  let [low, high] = extent(values);
  if (!values.length) { low = logarithmic ? 1 : 0; high = logarithmic ? 10 : 1; }
  if (logarithmic) {
    if (low === high) { low /= 2; high *= 2; }
    const from = Math.log10(low), to = Math.log10(high);
    const margin = 0.04 * (to - from);
    const scale = {low: Math.pow(10, from - margin), high: Math.pow(10, to + margin), ticks: []};
    const parts = to - from > 3 ? [1] : to - from > 1 ? [1, 3] : [1, 2, 5];
    for (let power = Math.floor(from) - 1; power <= Math.ceil(to); ++power)
      for (const part of parts) {
        const tick = part * Math.pow(10, power);
        if (tick >= scale.low && tick <= scale.high) scale.ticks.push(tick);
      }
    const begin = Math.log10(scale.low), end = Math.log10(scale.high);
    scale.at = (value) => pixels[0] + (Math.log10(value) - begin) / (end - begin) * (pixels[1] - pixels[0]);
    return scale;
  }
  if (low === high) { const half = Math.abs(low) * 0.1 || 0.5; low -= half; high += half; }
  let step = niceStep(high - low, count);
  if (values.every(Number.isInteger)) step = Math.max(1, step);  // there is no generation 0.5
  const scale = {low: Math.floor(low / step + 1e-9) * step, high: Math.ceil(high / step - 1e-9) * step, ticks: []};
  for (let n = Math.round(scale.low / step); n * step <= scale.high + step * 1e-6; ++n) scale.ticks.push(Number((n * step).toPrecision(12)));
  if (tight) { scale.low = low; scale.high = high; scale.ticks = scale.ticks.filter((t) => t >= low - 1e-9 * step && t <= high + 1e-9 * step); }
  scale.at = (value) => pixels[0] + (value - scale.low) / (scale.high - scale.low) * (pixels[1] - pixels[0]);
  return scale;
}

function drawMark(shape, x, y, colour, parent) {
  const r = 3.5;
  if (shape === 'circle') return svg('circle', {cx: x, cy: y, r, fill: colour}, parent);
  if (shape === 'square') return svg('rect', {x: x - r, y: y - r, width: 2 * r, height: 2 * r, fill: colour}, parent);
  const points = shape === 'triangle' ? [[0, -r - 1], [r + 1, r], [-r - 1, r]] : [[0, -r - 1], [r + 1, 0], [0, r + 1], [-r - 1, 0]];
  return svg('polygon', {points: points.map((p) => `${x + p[0]},${y + p[1]}`).join(' '), fill: colour}, parent);
}

function usable(chart, x, y) {
  return x !== null && y !== null && (!chart.x.log || x > 0) && (!chart.y.log || y > 0);
}

function drawLegend(chart, parent) {
  const named = chart.series.filter((s) => s.name);
  if (named.length + chart.markers.length + (chart.diagonal ? 1 : 0) === 0) return;
  const list = element('ul', {class: 'legend'}, null, parent);
  const entry = (name, draw) => {
    const item = element('li', {}, null, list);
    draw(svg('svg', {viewBox: '0 0 28 12', 'aria-hidden': 'true'}, item));
    element('span', {}, name, item);
  };
  chart.series.forEach((s, n) => {
    if (s.name) entry(s.name, (picture) => {
      if (s.marks !== 'points') svg('line', {x1: 0, y1: 6, x2: 28, y2: 6, stroke: seriesColour(n, s), 'stroke-width': 2, ...(s.dashed ? {'stroke-dasharray': '6 4'} : {})}, picture);
      if (s.marks !== 'line') drawMark(seriesShape(n), 14, 6, seriesColour(n, s), picture);
    });
  });
  for (const marker of chart.markers) entry(marker.label, (picture) => svg('line', {x1: 0, y1: 6, x2: 28, y2: 6, class: 'marker'}, picture));
  if (chart.diagonal) entry('equal in both', (picture) => svg('line', {x1: 0, y1: 6, x2: 28, y2: 6, class: 'diagonal'}, picture));
}

// Draws the axes and curves into an emptied SVG. Returns the points with their pixels, to find the one that is pointed at.
function drawPlot(chart, picture, width) {
  while (picture.firstChild) picture.firstChild.remove();
  const xs = [], ys = [];
  for (const s of chart.series) s.x.forEach((x, n) => { if (usable(chart, x, s.y[n])) { xs.push(x); ys.push(s.y[n]); } });
  for (const marker of chart.markers) (marker.vertical ? xs : ys).push(marker.at);
  if (chart.diagonal && chart.equal && xs.length) for (const end of extent(xs.concat(ys))) { xs.push(end); ys.push(end); }
  const [lowest, highest] = extent(ys);
  if (!chart.y.log && lowest > 0 && lowest < 0.35 * highest) ys.push(0);
  const left = 58, right = 14, top = 24, bottom = 42;
  const height = chart.equal ? Math.max(260, Math.min(430, width * 0.75)) : Math.max(230, Math.min(340, width * 0.62));
  if (chart.equal && xs.length) {
    // One unit has the same length on both axes: the shorter one is widened.
    const span = (values) => { const [low, high] = extent(values); return high - low; };
    const inner = [width - left - right, height - top - bottom];
    const unit = 1.06 * Math.max(span(xs) / inner[0], span(ys) / inner[1]) || 1;  // nothing lies on the border
    const widen = (values, pixels) => { const [low, high] = extent(values), half = 0.5 * unit * pixels; values.push(0.5 * (low + high) - half, 0.5 * (low + high) + half); };
    widen(xs, inner[0]); widen(ys, inner[1]);
  }
  picture.setAttribute('viewBox', `0 0 ${width} ${height}`);
  picture.setAttribute('height', height);
  const tight = chart.series.every((s) => s.marks !== 'points');  // points on the border would be cut
  const x = scaleOf(xs, chart.x.log, [left, width - right], width / 80, tight);
  const y = scaleOf(ys, chart.y.log, [height - bottom, top], height / 55);
  if (chart.equal) {  // exactly: no rounding of the ends
    const exact = (scale, values, pixels) => {
      const [low, high] = extent(values);
      scale.ticks = scale.ticks.filter((t) => t >= low && t <= high);
      scale.at = (value) => pixels[0] + (value - low) / (high - low || 1) * (pixels[1] - pixels[0]);
      scale.low = low; scale.high = high;
    };
    if (xs.length) { exact(x, xs, [left, width - right]); exact(y, ys, [height - bottom, top]); }
  }
  for (const tick of x.ticks) {
    svg('line', {x1: x.at(tick), x2: x.at(tick), y1: top, y2: height - bottom, class: tick === 0 ? 'zero' : 'grid'}, picture);
    svg('text', {x: x.at(tick), y: height - bottom + 16, 'text-anchor': 'middle'}, picture).textContent = shown(tick);
  }
  for (const tick of y.ticks) {
    svg('line', {x1: left, x2: width - right, y1: y.at(tick), y2: y.at(tick), class: tick === 0 ? 'zero' : 'grid'}, picture);
    svg('text', {x: left - 6, y: y.at(tick) + 4, 'text-anchor': 'end'}, picture).textContent = shown(tick);
  }
  svg('text', {x: (left + width - right) / 2, y: height - 8, 'text-anchor': 'middle'}, picture).textContent = chart.x.title;
  svg('text', {x: 0, y: 12}, picture).textContent = chart.y.title;
  svg('rect', {x: left, y: top, width: width - left - right, height: height - top - bottom, class: 'axis'}, picture);
  if (chart.diagonal) {
    const low = Math.max(x.low, y.low), high = Math.min(x.high, y.high);
    if (high > low) svg('line', {x1: x.at(low), y1: y.at(low), x2: x.at(high), y2: y.at(high), class: 'diagonal'}, picture);
  }
  for (const marker of chart.markers) {
    const at = marker.vertical ? x.at(marker.at) : y.at(marker.at);
    svg('line', marker.vertical ? {x1: at, x2: at, y1: top, y2: height - bottom, class: 'marker'} : {x1: left, x2: width - right, y1: at, y2: at, class: 'marker'}, picture);
  }
  const points = [];
  chart.series.forEach((s, n) => {
    let path = '', open = false;
    s.x.forEach((value, i) => {
      if (!usable(chart, value, s.y[i])) { open = false; return; }
      const px = x.at(value), py = y.at(s.y[i]);
      path += `${open ? 'L' : 'M'}${px.toFixed(1)} ${py.toFixed(1)}`;
      open = true;
      points.push({px, py, series: n, index: i});
    });
    if (s.marks !== 'points' && path) svg('path', {d: path, fill: 'none', stroke: seriesColour(n, s), 'stroke-width': 2, 'stroke-linejoin': 'round', ...(s.dashed ? {'stroke-dasharray': '6 4'} : {})}, picture);
  });
  for (const point of points) {
    const s = chart.series[point.series];
    if (s.marks !== 'line') drawMark(seriesShape(point.series), point.px, point.py, seriesColour(point.series, s), picture);
  }
  return points;
}

function drawChart(chart, parent) {
  const figure = element('figure', {}, null, parent);
  const caption = element('figcaption', {}, null, figure);
  element('h3', {}, chart.title, caption);
  drawLegend(chart, figure);
  const picture = svg('svg', {role: 'img', 'aria-label': `${chart.title}: ${chart.y.title} over ${chart.x.title}`}, figure);
  const pointed = element('p', {class: 'pointed'}, '', figure);
  if (chart.note) element('p', {class: 'note'}, chart.note, figure);
  let points = [], drawn = 0;
  const draw = () => {
    const width = Math.round(picture.getBoundingClientRect().width);
    if (width < 50 || width === drawn) return;
    drawn = width;
    try {
      points = drawPlot(chart, picture, width);
    } catch (error) {  // a chart that fails leaves the others as they are
      points = [];
      pointed.textContent = `This chart could not be drawn: ${error.message}`;
    }
  };
  new ResizeObserver(draw).observe(figure);
  draw();
  picture.addEventListener('pointermove', (event) => {
    const box = picture.getBoundingClientRect();
    let best = null, distance = 40 * 40;
    for (const point of points) {
      const d = (point.px - event.clientX + box.left) ** 2 + (point.py - event.clientY + box.top) ** 2;
      if (d < distance) { distance = d; best = point; }
    }
    if (!best) { pointed.textContent = ''; return; }
    const s = chart.series[best.series];
    const label = s.labels[best.index] ? `, ${s.labels[best.index]}` : '';
    pointed.textContent = `${s.name}${label}: ${shown(s.x[best.index])}, ${shown(s.y[best.index])}`;
  });
  picture.addEventListener('pointerleave', () => { pointed.textContent = ''; });
}
