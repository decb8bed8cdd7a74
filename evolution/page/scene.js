'use strict';
// Bodies in 3-D on one clock, drawn by three.js. Needs element(), extent() and shown() of chart.js.

const ramp = [[244, 240, 220], [161, 218, 180], [65, 182, 196], [44, 127, 184], [37, 52, 148]];  // light to dark, also for the colour-blind
const plainColours = [[0.80, 0.77, 0.70], [0.56, 0.69, 0.82]];
const unknownColour = [0.62, 0.62, 0.62];

function rampColour(share) {
  const at = Math.min(0.9999, Math.max(0, share)) * (ramp.length - 1);
  const n = Math.floor(at), part = at - n;
  return [0, 1, 2].map((c) => (ramp[n][c] + part * (ramp[n + 1][c] - ramp[n][c])) / 255);
}

function cssColour(name) { return getComputedStyle(document.documentElement).getPropertyValue(name).trim(); }

// The colour of material 1 or 2, as charts and animations have it.
function materialColour(material) { return [1, 3, 5].map((at) => parseInt(cssColour(`--m${material}`).slice(at, at + 2), 16) / 255); }

function aligned(bytes, Type) { return new Type(bytes.buffer, bytes.byteOffset, bytes.byteLength / Type.BYTES_PER_ELEMENT); }

// A length of 1, 2 or 5 times a power of ten, at most `most`.
function niceLength(most) {
  const power = Math.pow(10, Math.floor(Math.log10(most)));
  for (const part of [5, 2, 1]) if (part * power <= most) return part * power;
  return power;
}

function lengthText(metres) {
  if (metres >= 1) return `${shown(metres)} m`;
  return metres >= 0.0999 ? `${shown(100 * metres)} cm` : `${shown(1000 * metres)} mm`;
}

// One body: its corners between frames, and the buffers that three.js draws.
class Body {
  constructor(data, number, travels) {
    this.travels = travels;
    this.name = data.name;
    this.number = number;
    this.times = data.times;
    this.corners = data.corners;
    this.faces = aligned(decoded(data.faces), Uint32Array);
    this.positions = aligned(decoded(data.positions), Int16Array);
    this.materials = data.materials ? decoded(data.materials) : null;
    this.chambers = data.chambers ? decoded(data.chambers) : null;
    this.pressures = data.pressures;
    this.centres = data.centres;
    this.travelled = data.travelled;
    this.origin = data.origin;
    this.scale = data.scale;
    this.now = new Float32Array(3 * this.corners);
    this.rest = new Float32Array(3 * this.corners);
    this.faceCount = this.faces.length / 4;
    this.place(this.times[0], this.rest);
    this.measure();  // which needs the centres
    this.build();
  }

  // The frame before a time and the share of the way to the next one.
  at(time) {
    const last = this.times.length - 1;
    if (last < 1 || time <= this.times[0]) return [0, 0];
    if (time >= this.times[last]) return [last - 1, 1];
    let low = 0, high = last;
    while (high - low > 1) { const middle = (low + high) >> 1; if (this.times[middle] <= time) low = middle; else high = middle; }
    return [low, (time - this.times[low]) / (this.times[low + 1] - this.times[low])];
  }

  between(values, time) {
    const [n, part] = this.at(time);
    return values.length > n + 1 ? values[n] + part * (values[n + 1] - values[n]) : values[n];
  }

  // How far the middle has come since the first frame: a body that travels is coloured by what is left of its displacement.
  shift(time) {
    if (!this.travels) return [0, 0, 0];
    const [n, part] = this.at(time), next = this.centres[Math.min(n + 1, this.centres.length - 1)];
    return this.centres[n].map((c, axis) => c + part * (next[axis] - c) - this.centres[0][axis]);
  }

  // The material of a chamber: that of most faces near it. 0 if this is not known.
  materialOf(chamber) {
    const counts = [0, 0, 0];
    if (this.materials && this.chambers) this.chambers.forEach((near, f) => { if (near === chamber) ++counts[this.materials[f]]; });
    return counts[1] === counts[2] ? 0 : counts[1] > counts[2] ? 1 : 2;
  }

  // "pressure 1.20 kPa", or where chambers are of one material each "pressure 1.20 kPa in material 1, 0.00 kPa in material 2".
  pressureText(time) {
    if (!this.chamberMaterials) this.chamberMaterials = this.pressures.map((_, chamber) => this.materialOf(chamber));
    const texts = this.pressures.map((p) => `${(this.between(p, time) / 1000).toFixed(2)} kPa`);
    if (this.chamberMaterials.length < 2 || this.chamberMaterials.includes(0)) return 'pressure ' + texts.slice(0, 4).join(', ');
    const of = (material) => [...new Set(texts.filter((_, chamber) => this.chamberMaterials[chamber] === material))].slice(0, 3);
    return 'pressure ' + [1, 2].filter((m) => of(m).length).map((m) => `${of(m).join(' and ')} in material ${m}`).join(', ');
  }

  // The time of the last full stroke: the last frame at the highest pressure. Undefined where no pressure is known.
  fullStroke() {
    const pressures = this.pressures.length ? this.pressures[0] : [];
    const [low, high] = extent(pressures);
    if (!(high > low)) return undefined;
    return this.times[pressures.map((p) => p >= high - 0.02 * (high - low)).lastIndexOf(true)];
  }

  // That the motion has ended before a time: " (ended at 2 s)". A few steps of time are no difference.
  ended(time, unit) {
    const end = this.times[this.times.length - 1];
    return time - end > 0.01 * time ? ` (ended at ${shown(Number(end.toPrecision(3)))} ${unit})` : '';
  }

  // The horizontal displacement of the centre of mass, or where that is not known of the middle of the surface, in m.
  moved(time) {
    if (this.travelled.length) return this.between(this.travelled, time);
    const [n, part] = this.at(time), next = this.centres[Math.min(n + 1, this.centres.length - 1)];
    return Math.hypot(...[0, 1].map((axis) => this.centres[n][axis] + part * (next[axis] - this.centres[n][axis]) - this.centres[0][axis]));
  }

  place(time, into) {
    const [n, part] = this.at(time);
    const size = 3 * this.corners, a = n * size, b = Math.min(n + 1, this.times.length - 1) * size;
    for (let i = 0; i < size; ++i) {
      const before = this.positions[a + i];
      into[i] = this.origin[i % 3] + this.scale * (32768 + before + part * (this.positions[b + i] - before));
    }
  }

  // The box around all frames, and the largest displacement of a corner.
  measure() {
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity], size = 3 * this.corners;
    let largest = 0;
    for (let i = 0; i < this.positions.length; ++i) {
      const axis = i % 3, value = this.positions[i];
      if (value < low[axis]) low[axis] = value;
      if (value > high[axis]) high[axis] = value;
    }
    for (let frame = 0; frame < this.times.length; ++frame) {
      const shift = this.shift(this.times[frame]).map((s) => s / this.scale), begin = frame * size;
      for (let c = 0; c < size; c += 3) {
        let d = 0;
        for (let axis = 0; axis < 3; ++axis) d += (this.positions[begin + c + axis] - this.positions[c + axis] - shift[axis]) ** 2;
        if (d > largest) largest = d;
      }
    }
    const inMetres = (values) => values.map((v, axis) => this.origin[axis] + this.scale * (32768 + v));
    this.low = inMetres(low);
    this.high = inMetres(high);
    this.largest = this.scale * Math.sqrt(largest);
  }

  build() {
    const vertices = 6 * this.faceCount;
    this.geometry = new THREE.BufferGeometry();
    this.geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(3 * vertices), 3).setUsage(THREE.DynamicDrawUsage));
    this.geometry.setAttribute('color', new THREE.BufferAttribute(new Float32Array(3 * vertices), 3).setUsage(THREE.DynamicDrawUsage));
    this.mesh = new THREE.Mesh(this.geometry, new THREE.MeshPhongMaterial({vertexColors: THREE.VertexColors, side: THREE.DoubleSide, flatShading: true, shininess: 12, specular: 0x222222, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1}));
    this.mesh.frustumCulled = false;
    const known = new Set(), edges = [];
    for (let f = 0; f < this.faceCount; ++f)
      for (let n = 0; n < 4; ++n) {
        const a = this.faces[4 * f + n], b = this.faces[4 * f + (n + 1) % 4];
        const key = a < b ? a * this.corners + b : b * this.corners + a;
        if (a !== b && !known.has(key)) { known.add(key); edges.push(a, b); }
      }
    this.edges = Uint32Array.from(edges);
    this.edgeGeometry = new THREE.BufferGeometry();
    this.edgeGeometry.setAttribute('position', new THREE.BufferAttribute(this.now, 3).setUsage(THREE.DynamicDrawUsage));
    this.edgeGeometry.setIndex(new THREE.BufferAttribute(this.edges, 1));
    this.lines = new THREE.LineSegments(this.edgeGeometry, new THREE.LineBasicMaterial({color: 0x000000, transparent: true, opacity: 0.28}));
    this.lines.frustumCulled = false;
  }

  update(time, colouring) {
    this.place(time, this.now);
    const position = this.geometry.attributes.position.array, colour = this.geometry.attributes.color.array;
    const order = [0, 1, 2, 0, 2, 3];
    const corner = colouring.ofCorner ? colouring.ofCorner(this, time) : null;
    let v = 0;
    for (let f = 0; f < this.faceCount; ++f) {
      const rgb = corner ? null : colouring.ofFace(this, f, time);
      for (const n of order) {
        const c = this.faces[4 * f + n];
        for (let axis = 0; axis < 3; ++axis) {
          position[3 * v + axis] = this.now[3 * c + axis];
          colour[3 * v + axis] = corner ? corner[3 * c + axis] : rgb[axis];
        }
        ++v;
      }
    }
    this.geometry.attributes.position.needsUpdate = true;
    this.geometry.attributes.color.needsUpdate = true;
    this.edgeGeometry.attributes.position.needsUpdate = true;
  }

  dispose() {
    for (const made of [this.geometry, this.edgeGeometry, this.mesh.material, this.lines.material]) made.dispose();
  }
}

// The ways to colour the bodies of a scene, each with its legend.
function colourings(bodies) {
  const ways = [];
  const plain = (body) => plainColours[body.number % plainColours.length];
  if (bodies.some((b) => b.materials)) {
    const phaseColours = [unknownColour, materialColour(1), materialColour(2)];
    ways.push({
      name: 'phase',
      ofFace: (body, f) => (body.materials ? phaseColours[body.materials[f]] || phaseColours[0] : plain(body)),
      legend: [['cells of material 1', phaseColours[1]], ['cells of material 2', phaseColours[2]]],
      note: 'Both materials are driven apart in time (phase), as the study says.'
    });
  }
  const [, largest] = extent(bodies.map((b) => b.largest));
  ways.push({
    name: 'displacement',
    ofCorner: (body, time) => {
      const colours = new Float32Array(3 * body.corners), shift = body.shift(time);
      for (let c = 0; c < body.corners; ++c) {
        const i = 3 * c;
        const d = Math.hypot(body.now[i] - body.rest[i] - shift[0], body.now[i + 1] - body.rest[i + 1] - shift[1], body.now[i + 2] - body.rest[i + 2] - shift[2]);
        const rgb = rampColour(largest > 0 ? d / largest : 0);
        for (let axis = 0; axis < 3; ++axis) colours[i + axis] = rgb[axis];
      }
      return colours;
    },
    range: ['0 mm', `${shown(Number((1000 * largest).toPrecision(3)))} mm`],
    note: (bodies.some((b) => b.travels) ? 'Displacement of each point since the first frame, without the way of the middle of its body.' : 'Displacement of each point since the first frame.') + ' The range covers all frames and bodies.'
  });
  const withPressure = bodies.filter((b) => b.pressures.length);
  if (withPressure.length) {
    const [low, high] = extent([0].concat(withPressure.flatMap((b) => b.pressures.flat())));
    if (high > low) ways.push({
      name: 'pressure',
      ofFace: (body, f, time) => {
        if (!body.pressures.length) return unknownColour;
        const chamber = body.chambers ? body.chambers[f] : 0;
        return rampColour((body.between(body.pressures[Math.min(chamber, body.pressures.length - 1)], time) - low) / (high - low));
      },
      range: [`${shown(low / 1000)} kPa`, `${shown(high / 1000)} kPa`],
      note: 'Gauge pressure of the nearest chamber.' + (withPressure.length < bodies.length ? ' Grey: the files of this model hold no pressure.' : '')
    });
  }
  ways.push({name: 'plain', ofFace: plain, legend: bodies.map((b) => [b.name, plain(b)]), note: ''});
  return ways;
}

// Draws the motions of the report. Returns whether they can be shown.
function drawMotion(data, parent) {
  if (!data.scenes.length) return false;
  parent.hidden = false;
  element('h2', {id: 'motion-title'}, 'The robot in motion', parent);
  if (typeof THREE === 'undefined') {
    element('p', {class: 'warning'}, data.without3d || 'This page was made without three.js, so nothing moves. Pictures stand below.', parent);
    return false;
  }
  const choose = element('p', {class: 'choose'}, null, parent);
  const chooseLabel = element('label', {for: 'scene-choice'}, 'Shown: ', choose);
  const choice = element('select', {id: 'scene-choice'}, null, choose);
  data.scenes.forEach((scene, n) => element('option', {value: n}, scene.title, choice));
  if (data.scenes.length === 1) { chooseLabel.hidden = true; choice.hidden = true; element('strong', {}, data.scenes[0].title, choose); }
  const viewer = element('div', {class: 'viewer'}, null, parent);
  const stage = element('div', {class: 'stage'}, null, viewer);
  const canvas = element('canvas', {tabindex: '0', id: 'scene', role: 'img', 'aria-label': 'The bodies in 3-D. Arrow keys turn the view, plus and minus zoom, shift with arrow keys moves it, 0 resets it.'}, null, stage);
  const scalebar = element('div', {class: 'scalebar'}, null, stage);
  const readout = element('div', {class: 'readout'}, null, viewer);
  const readoutTime = element('p', {id: 'scene-time'}, '', readout), readoutMoved = element('p', {}, '', readout);
  const legend = element('div', {class: 'colours'}, null, viewer);
  const controls = element('div', {class: 'controls'}, null, viewer);
  const play = element('button', {type: 'button', class: 'play', id: 'play'}, 'Play', controls);
  const timeLabel = element('label', {class: 'time'}, null, controls);
  const timeName = element('span', {}, 'Time', timeLabel);
  const slider = element('input', {type: 'range', min: '0', max: '1000', step: '1', value: '0', id: 'time'}, null, timeLabel);
  const speed = element('select', {}, null, element('label', {}, 'Speed', controls));
  for (const [value, text] of [['0.1', '1/10'], ['0.25', '1/4'], ['1', 'real time'], ['4', '4 times']]) element('option', {value}, text, speed);
  speed.value = '0.25';
  const colourChoice = element('select', {}, null, element('label', {}, 'Colour', controls));
  const meshLabel = element('label', {}, null, controls);
  const mesh = element('input', {type: 'checkbox', checked: ''}, null, meshLabel);
  element('span', {}, 'Mesh', meshLabel);
  const reset = element('button', {type: 'button'}, 'Reset view', controls);
  const source = element('p', {class: 'source'}, '', parent);
  element('p', {class: 'note'}, 'Drag to turn, two fingers or shift and drag to move. Pinch, or turn the wheel after a click, to zoom. Keys: arrows, + and \u2212, 0.', parent);

  let renderer;
  try {
    renderer = new THREE.WebGLRenderer({canvas, antialias: true});
  } catch (error) {
    viewer.remove();
    choose.remove();
    element('p', {class: 'warning'}, 'This browser has no WebGL, so nothing moves. Pictures stand below.', parent);
    return false;
  }
  renderer.setPixelRatio(Math.min(2, window.devicePixelRatio || 1));
  const world = new THREE.Scene();
  const camera = new THREE.OrthographicCamera(-1, 1, 1, -1, -100, 100);
  camera.up.set(0, 0, 1);
  world.add(new THREE.HemisphereLight(0xffffff, 0xb8b8b8, 0.85));
  const sun = new THREE.DirectionalLight(0xffffff, 0.38);
  world.add(sun);

  const state = {scene: null, bodies: [], ways: [], way: null, from: 0, to: 1, time: 0, playing: false, last: 0, view: null, fit: null, extras: [], trails: [], labels: [], dirty: false};

  const boundsOf = () => {
    const low = [0, 1, 2].map((axis) => extent(state.bodies.map((b) => b.low[axis]))[0]);
    const high = [0, 1, 2].map((axis) => extent(state.bodies.map((b) => b.high[axis]))[1]);
    return [low, high];
  };

  const frameAll = () => {
    const [low, high] = boundsOf();
    const middle = low.map((value, axis) => 0.5 * (value + high[axis]));
    // Seen from the side on which the second body stands, a little from above.
    state.fit = {target: middle, turn: -0.62, tilt: 0.5, half: 1};
    const eye = eyeOf(state.fit), right = [Math.cos(state.fit.turn), Math.sin(state.fit.turn), 0];
    const up = [eye[1] * right[2] - eye[2] * right[1], eye[2] * right[0] - eye[0] * right[2], eye[0] * right[1] - eye[1] * right[0]];
    let across = 0, along = 0;
    for (const x of [low[0], high[0]]) for (const y of [low[1], high[1]]) for (const z of [low[2], high[2]]) {
      const d = [x - middle[0], y - middle[1], z - middle[2]];
      across = Math.max(across, Math.abs(d[0] * right[0] + d[1] * right[1]));
      along = Math.max(along, Math.abs(d[0] * up[0] + d[1] * up[1] + d[2] * up[2]));
    }
    const aspect = stage.clientWidth / Math.max(1, stage.clientHeight);
    state.fit.half = 1.18 * Math.max(along, across / aspect, 1e-6);
    state.view = {...state.fit, target: state.fit.target.slice()};
  };

  // The unit vector to the eye; `turn` about z, `tilt` above the horizon.
  function eyeOf(view) { return [Math.sin(view.turn) * Math.cos(view.tilt), -Math.cos(view.turn) * Math.cos(view.tilt), Math.sin(view.tilt)]; }

  function aim() {
    const width = stage.clientWidth, height = stage.clientHeight;
    renderer.setSize(width, height, false);
    const aspect = width / Math.max(1, height), view = state.view, eye = eyeOf(view);
    const far = 50 * Math.max(view.half, state.fit.half);
    Object.assign(camera, {left: -view.half * aspect, right: view.half * aspect, top: view.half, bottom: -view.half, near: 0, far: 2 * far});
    camera.position.set(...view.target.map((t, axis) => t + far * eye[axis]));
    camera.lookAt(...view.target);
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
    sun.position.set(eye[0] - 0.6 * Math.cos(view.turn), eye[1] - 0.6 * Math.sin(view.turn), eye[2] + 0.9);
  }

  function drawOverlays() {
    const width = stage.clientWidth, height = stage.clientHeight;
    const metresPerPixel = 2 * state.view.half / height;
    const length = niceLength(Math.min(0.3 * width, 220) * metresPerPixel);
    scalebar.textContent = lengthText(length);
    element('span', {style: `width:${(length / metresPerPixel).toFixed(1)}px`}, null, scalebar);
    state.bodies.forEach((body, n) => {
      const label = state.labels[n];
      if (!label) return;
      const box = [Infinity, -Infinity, -Infinity, Infinity];  // left, right, lowest and highest on the screen
      const corner = new THREE.Vector3();
      for (let c = 0; c < body.corners; c += Math.max(1, Math.floor(body.corners / 400))) {
        corner.set(body.now[3 * c], body.now[3 * c + 1], body.now[3 * c + 2]).project(camera);
        const x = (corner.x + 1) / 2 * width, y = (1 - corner.y) / 2 * height;
        box[0] = Math.min(box[0], x); box[1] = Math.max(box[1], x); box[2] = Math.max(box[2], y); box[3] = Math.min(box[3], y);
      }
      const half = label.offsetWidth / 2;
      label.style.left = `${Math.min(width - half - 4, Math.max(half + 4, (box[0] + box[1]) / 2))}px`;
      // Above the body behind and below the one in front, so that neither label lies on the other body.
      const above = n + 1 < state.bodies.length && box[3] > label.offsetHeight + 8;
      label.style.top = `${above ? box[3] - label.offsetHeight - 6 : Math.min(height - 24, box[2] + 6)}px`;
    });
  }

  function drawReadout() {
    const scene = state.scene, parts = [];
    parts.push(scene.unit ? `${scene.clock} ${state.time.toFixed(3)} ${scene.unit}` : `${scene.clock} ${shown(Number(state.time.toFixed(3)))}`);
    const pressed = state.bodies.find((b) => b.pressures.length);
    if (pressed) parts.push(pressed.pressureText(state.time));
    readoutTime.textContent = parts.join(' \u00b7 ');
    readoutMoved.textContent = scene.ground === null ? '' : state.bodies.map((b) => `${b.name}: ${b.travelled.length ? 'centre of mass' : 'middle'} moved ${(1000 * b.moved(state.time)).toFixed(1)} mm${b.ended(state.time, scene.unit)}`).join(' \u00b7 ');
    slider.setAttribute('aria-valuetext', readoutTime.textContent);
  }

  function render() {
    state.dirty = false;
    for (const body of state.bodies) {
      body.update(state.time, state.way);
      body.lines.visible = mesh.checked;
    }
    for (const trail of state.trails) trail.line.geometry.setDrawRange(0, trail.body.at(state.time)[0] + 2);
    renderer.setClearColor(cssColour('--scene'));
    for (const extra of state.extras) if (extra.cssName) extra.material.color.set(cssColour(extra.cssName));
    aim();
    renderer.render(world, camera);
    drawOverlays();
    drawReadout();
  }

  function ask() {
    if (state.dirty) return;
    state.dirty = true;
    requestAnimationFrame(render);
  }

  function addGround() {
    if (state.scene.ground === null) return;
    const [low, high] = boundsOf();
    const size = 1.5 * Math.max(high[0] - low[0], high[1] - low[1]) + 2 * (high[2] - low[2]);
    const step = niceLength(size / 12);
    const count = Math.ceil(size / step / 2);
    const centre = [0, 1].map((axis) => step * Math.round(0.5 * (low[axis] + high[axis]) / step));
    const points = [];
    for (let n = -count; n <= count; ++n) {
      points.push(centre[0] - count * step, centre[1] + n * step, 0, centre[0] + count * step, centre[1] + n * step, 0);
      points.push(centre[0] + n * step, centre[1] - count * step, 0, centre[0] + n * step, centre[1] + count * step, 0);
    }
    const height = state.scene.ground - 0.002 * size;
    const plane = new THREE.Mesh(new THREE.PlaneBufferGeometry(2 * count * step, 2 * count * step), new THREE.MeshBasicMaterial({side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: 2, polygonOffsetUnits: 2}));
    plane.position.set(centre[0], centre[1], height);
    plane.cssName = '--ground';
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(Float32Array.from(points), 3));
    const grid = new THREE.LineSegments(geometry, new THREE.LineBasicMaterial());
    grid.position.z = height;
    grid.cssName = '--grid';
    state.extras.push(plane, grid);
    state.grid = step;
    for (const body of state.bodies) {
      const path = new THREE.BufferGeometry();
      path.setAttribute('position', new THREE.BufferAttribute(Float32Array.from(body.centres.flatMap((c) => [c[0], c[1], height + 0.001 * size])), 3));
      const line = new THREE.Line(path, new THREE.LineBasicMaterial());
      line.cssName = '--ink';
      line.frustumCulled = false;
      state.extras.push(line);
      state.trails.push({line, body});
    }
  }

  function drawColours() {
    while (legend.firstChild) legend.firstChild.remove();
    const way = state.way, css = (rgb) => `rgb(${rgb.map((c) => Math.round(255 * c)).join(',')})`;
    if (way.range) {
      const bar = element('span', {class: 'bar'}, null, legend);  // stays on one line
      element('span', {}, `${way.name}: ${way.range[0]}`, bar);
      element('span', {class: 'ramp', style: `background:linear-gradient(to right,${ramp.map((c) => `rgb(${c.join(',')})`).join(',')})`}, null, bar);
      element('span', {}, way.range[1], bar);
    }
    for (const [name, rgb] of way.legend || []) {
      const entry = element('span', {}, null, legend);
      element('span', {class: 'swatch', style: `background:${css(rgb)}`}, null, entry);
      element('span', {}, name, entry);
    }
    const notes = [way.note];
    if (state.scene.ground !== null) notes.push(`Grid on the ground: ${lengthText(state.grid)}. Line: path of the middle of the body.`);
    element('span', {class: 'note'}, notes.filter((n) => n).join(' '), legend);
  }

  const cache = new Map();  // bodies by scene: their texts are decoded once
  function show(number) {
    stop();
    for (const body of state.bodies) { world.remove(body.mesh); world.remove(body.lines); }
    for (const extra of state.extras) { world.remove(extra); extra.geometry.dispose(); extra.material.dispose(); }
    for (const label of state.labels) if (label) label.remove();
    const scene = data.scenes[number];
    if (!cache.has(number)) cache.set(number, scene.bodies.map((body, n) => new Body(body, n, scene.ground !== null)));
    Object.assign(state, {scene, bodies: cache.get(number), extras: [], trails: []});
    [state.from, state.to] = extent(state.bodies.flatMap((b) => [b.times[0], b.times[b.times.length - 1]]));
    // An inflated body says more than one at rest.
    const strokes = state.bodies.map((b) => b.fullStroke()).filter((t) => t !== undefined);
    state.time = scene.ground === null ? state.to : strokes.length ? strokes[0] : state.from;
    state.ways = colourings(state.bodies);
    while (colourChoice.firstChild) colourChoice.firstChild.remove();
    for (const way of state.ways) element('option', {value: way.name}, way.name, colourChoice);
    state.way = state.ways[0];
    addGround();
    for (const body of state.bodies) { world.add(body.mesh); world.add(body.lines); }
    for (const extra of state.extras) world.add(extra);
    state.labels = state.bodies.map((b) => (state.bodies.length > 1 ? element('div', {class: 'label'}, b.name, stage) : null));
    timeName.textContent = scene.clock.charAt(0).toUpperCase() + scene.clock.slice(1);
    source.textContent = `From ${scene.source}.` + (scene.note ? ` ${scene.note}` : '');
    if (scene.animation) {
      source.append(' As an animation: ');
      element('a', {href: encodeURIComponent(scene.animation)}, scene.animation, source);
      source.append('.');
    }
    frameAll();
    drawColours();
    moveSlider();
    ask();
  }

  function moveSlider() { slider.value = String(Math.round(1000 * (state.time - state.from) / (state.to - state.from || 1))); }

  function step(now) {
    if (!state.playing) return;
    const elapsed = Math.min(0.1, (now - state.last) / 1000);
    state.last = now;
    const span = state.to - state.from;
    const rate = state.scene.unit === 's' ? 1 : span;  // without seconds, the whole takes one second at real time
    state.time += elapsed * Number(speed.value) * rate;
    if (state.time > state.to) state.time = state.from;
    moveSlider();
    render();
    requestAnimationFrame(step);
  }
  function stop() { state.playing = false; play.textContent = 'Play'; play.setAttribute('aria-pressed', 'false'); }
  function toggle() {
    if (state.playing) { stop(); return; }
    if (state.time >= state.to) state.time = state.from;
    Object.assign(state, {playing: true, last: performance.now()});
    play.textContent = 'Pause';
    play.setAttribute('aria-pressed', 'true');
    requestAnimationFrame(step);
  }

  play.addEventListener('click', toggle);
  slider.addEventListener('input', () => { stop(); state.time = state.from + (state.to - state.from) * Number(slider.value) / 1000; ask(); });
  choice.addEventListener('change', () => show(Number(choice.value)));
  colourChoice.addEventListener('change', () => { state.way = state.ways.find((way) => way.name === colourChoice.value); drawColours(); ask(); });
  mesh.addEventListener('change', ask);
  reset.addEventListener('click', () => { frameAll(); ask(); });
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', ask);
  new ResizeObserver(() => { if (state.view) ask(); }).observe(stage);

  const turn = (dx, dy) => { state.view.turn -= dx; state.view.tilt = Math.min(1.55, Math.max(-0.3, state.view.tilt + dy)); ask(); };
  const move = (dx, dy) => {  // pixels
    const scale = 2 * state.view.half / stage.clientHeight, view = state.view;
    const right = [Math.cos(view.turn), Math.sin(view.turn), 0];
    const up = [-Math.sin(view.turn) * Math.sin(view.tilt), Math.cos(view.turn) * Math.sin(view.tilt), Math.cos(view.tilt)];
    for (let axis = 0; axis < 3; ++axis) view.target[axis] -= scale * (dx * right[axis] - dy * up[axis]);
    ask();
  };
  const zoom = (factor) => { state.view.half = Math.min(20 * state.fit.half, Math.max(0.02 * state.fit.half, state.view.half * factor)); ask(); };

  const pointers = new Map();
  canvas.addEventListener('pointerdown', (event) => { canvas.setPointerCapture(event.pointerId); pointers.set(event.pointerId, [event.clientX, event.clientY]); });
  const lost = (event) => pointers.delete(event.pointerId);
  canvas.addEventListener('pointerup', lost);
  canvas.addEventListener('pointercancel', lost);
  canvas.addEventListener('pointermove', (event) => {
    const before = pointers.get(event.pointerId);
    if (!before) return;
    const dx = event.clientX - before[0], dy = event.clientY - before[1];
    if (pointers.size === 2) {
      const other = [...pointers].find(([id]) => id !== event.pointerId)[1];
      const was = Math.hypot(before[0] - other[0], before[1] - other[1]), is = Math.hypot(event.clientX - other[0], event.clientY - other[1]);
      if (was > 0 && is > 0) zoom(was / is);
      move(dx / 2, dy / 2);
    } else if (event.shiftKey || event.buttons === 2) {
      move(dx, dy);
    } else {
      turn(0.008 * dx, 0.008 * dy);
    }
    pointers.set(event.pointerId, [event.clientX, event.clientY]);
  });
  canvas.addEventListener('contextmenu', (event) => event.preventDefault());
  canvas.addEventListener('wheel', (event) => {
    if (document.activeElement !== canvas && !event.ctrlKey) return;  // the page goes on scrolling
    event.preventDefault();
    zoom(Math.exp(0.0015 * event.deltaY));
  }, {passive: false});
  canvas.addEventListener('keydown', (event) => {
    const arrows = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]};
    if (event.key in arrows) {
      const [dx, dy] = arrows[event.key];
      if (event.shiftKey) move(24 * dx, 24 * dy); else turn(0.12 * dx, 0.12 * dy);
    } else if (event.key === '+' || event.key === '=') zoom(0.85);
    else if (event.key === '-') zoom(1 / 0.85);
    else if (event.key === '0') { frameAll(); ask(); }
    else if (event.key === ' ') toggle();
    else return;
    event.preventDefault();
  });

  show(0);
  return true;
}
