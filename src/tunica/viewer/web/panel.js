// Controls of the viewer: what is shown, the clock that all curves of the page share, the probe.
'use strict';
(async () => {
  const byId = id => document.getElementById(id);
  if (!byId('viewer')) return;
  // The page is painted first: nothing of it waits for the beat.
  const message = byId('viewer-message');
  message.textContent = 'The beat is being read …';
  await new Promise(go => { requestAnimationFrame(() => setTimeout(go)); setTimeout(go, 500); });
  const began = performance.now();
  const beat = await tunica.readBeat();
  const canvas = byId('view');
  let scene, drawn = 'WebGL';
  try {
    scene = new tunica.Scene(canvas, beat);
  } catch (error) {
    const plain = canvas.cloneNode();
    canvas.replaceWith(plain);
    scene = new tunica.Still(plain, beat);
    drawn = 'canvas';
  }
  const view = byId('view');
  const kinds = new Set(beat.bodies.flatMap(b => b.groups.map(g => g.kind)));
  const state = { quantity: '', opacity: { outer: 1, inner: 1, opening: 1 }, hidden: new Set(), warp: 1, range: [0, 1], plane: null, sections: () => false, families: new Set(), regions: null };
  const clock = { at: 0, playing: false };
  let dirty = true, probed = null, last = 0, moved = 0, fine = false;

  // --- quantities: one entry for those that surface and sections have in common ---
  const quantities = new Map();
  for (const body of beat.bodies)
    for (const q of body.quantities) {
      if (!quantities.has(q.name)) quantities.set(q.name, { ...q.place, bodies: [] });
      const one = quantities.get(q.name);
      one.range = one.range.map((v, k) => k % 2 ? Math.max(v, q.range[k]) : Math.min(v, q.range[k]));
      one.bodies.push(body.name);
    }
  for (const of of ['wall', 'blood']) {
    const list = document.createElement('optgroup');
    list.label = of;
    for (const [name, q] of quantities) if (q.of === of || of === 'blood' && q.of === 'inside') list.append(new Option(q.unit ? `${name} [${q.unit}]` : name, name));
    if (list.children.length) byId('quantity').append(list);
  }

  // Regions of the wall are colours of their own, not values.
  const regions = [...new Set(beat.bodies.flatMap(b => b.groups).filter(g => g.kind === 'outer' || g.kind === 'inner').map(g => g.name))];
  const byRegion = 'regions of the wall', colours = new Map(regions.map((name, k) => [name, tunica.categories[k % tunica.categories.length]]));
  if (drawn === 'WebGL' && regions.length > 1) byId('quantity').append(new Option(byRegion, byRegion));

  const isSigned = q => q.components === 1 && q.range[0] < 0 && q.range[1] > 0 && -q.range[0] > 0.1 * q.range[1];

  function rangeOf(q) {
    let [low, high] = q.range;
    if (isSigned(q)) { high = Math.max(-low, high); low = -high; }
    else if (low > 0 && low < 0.35 * high) low = 0;
    if (q.components === 3) low = 0;
    return high > low ? [low, high] : [low, low + (Math.abs(low) || 1)];
  }

  /** A quantity of the blood alone is seen through the outside of the wall, one of sections through everything. */
  function choose(name) {
    state.quantity = name;
    byId('quantity').value = name;
    state.regions = name === byRegion ? colours : null;
    for (const id of ['low', 'high', 'map']) byId(id).disabled = name === byRegion;
    if (name === byRegion) {
      for (const kind of ['outer', 'inner', 'opening']) setOpacity(kind, 1);
      byId('all-sections').checked = false;
      cut();
      refresh();
      return;
    }
    const q = quantities.get(name);
    state.range = rangeOf(q);
    byId('map').value = isSigned(q) ? 'diverging' : 'viridis';
    byId('low').value = +state.range[0].toPrecision(4);
    byId('high').value = +state.range[1].toPrecision(4);
    for (const id of ['low', 'high']) byId(id).setCustomValidity('');
    const inside = !q.bodies.includes('surface');
    const outer = q.of === 'wall' ? 1 : inside ? 0 : 0.08, inner = inside ? 0.12 : 1;
    setOpacity('outer', kinds.has('outer') ? outer : 1);
    setOpacity('inner', inner);
    setOpacity('opening', inside ? 0.12 : 1);
    byId('all-sections').checked = inside && beat.sections.length > 0;
    scene.setMap(byId('map').value);
    cut();
    refresh();
  }

  function setOpacity(kind, value) {
    state.opacity[kind] = value;
    const slider = byId(`opacity-${kind}`);
    if (slider) slider.value = value;
  }

  function refresh() {
    scene.setTime(clock.at, state.quantity);
    scene.setLook(state);
    const frame = Math.min(beat.frames - 1, clock.at), a = Math.floor(frame), b = Math.min(beat.frames - 1, a + 1);
    const seconds = beat.times[a] + (frame - a) * (beat.times[b] - beat.times[a]);
    const whole = beat.times[beat.frames - 1] - beat.times[0];
    byId('now').textContent = beat.frames > 1 ? `${(1000 * (seconds - beat.times[0])).toFixed(whole < 0.05 ? 1 : 0)} ms` : '';
    byId('of-run').textContent = beat.frames > 1 && beat.times[0] !== 0 ? `${+seconds.toPrecision(4)} s of the run` : '';
    byId('time').value = clock.at;
    byId('time').setAttribute('aria-valuetext', byId('now').textContent);
    document.dispatchEvent(new CustomEvent('tunica-time', { detail: seconds }));
    legend();
    if (probed) tell();
    dirty = true;
  }

  function legendOfRegions() {
    byId('legend-title').textContent = byRegion;
    byId('legend').title = '';
    const ticks = byId('ticks');
    ticks.textContent = '';
    for (const [name, colour] of colours) {
      const entry = document.createElement('p'), swatch = document.createElement('i');
      swatch.style.background = `rgb(${colour})`;
      entry.append(swatch, name.replaceAll('_', ' '));
      ticks.append(entry);
    }
  }

  function legend() {
    byId('legend').classList.toggle('categories', !!state.regions);
    if (state.regions) return legendOfRegions();
    const q = quantities.get(state.quantity), [low, high] = state.range, ramp = byId('ramp'), g = ramp.getContext('2d');
    byId('legend-title').textContent = q.unit ? `${state.quantity} [${q.unit}]` : state.quantity;
    for (let i = 0; i < 256; ++i) { g.fillStyle = `rgb(${tunica.colour(byId('map').value, i / 255)})`; g.fillRect(0, 255 - i, 1, 1); }
    const ticks = byId('ticks');
    ticks.textContent = '';
    const add = (value, text) => {
      const mark = document.createElement('span');
      mark.style.bottom = `${100 * (value - low) / (high - low)}%`;
      mark.textContent = text;
      ticks.append(mark);
    };
    for (const v of tunica.ticks(low, high)) add(v, String(v).replace('-', '−'));
    // The ends of the colours are percentiles: how far values go beyond them is said.
    byId('legend').title = `all values: ${tunica.number(q.range[2])} to ${tunica.number(q.range[3])} ${q.unit}; the colours end at the 0.5 and 99.5 percentiles`;
  }

  // --- cuts ---
  const across = beat.sections.filter(s => s.name !== 'along the aorta');
  if (across.length < beat.sections.length) byId('cut').add(new Option('along the aorta', 'along'), 1);
  if (across.length) byId('cut').add(new Option('across the aorta', 'across'), 1);
  if (!beat.sections.length) byId('all-sections').parentElement.hidden = true;

  function cut() {
    const kind = byId('cut').value, place = +byId('cut-place').value, sign = byId('flip').checked ? -1 : 1;
    let name = '', shown = null;
    state.plane = null;
    byId('cut-place').disabled = kind === 'off' || kind === 'along';
    if (kind === 'along' || kind === 'across') {
      const s = kind === 'along' ? beat.sections.find(one => one.name === 'along the aorta')
        : across[Math.min(across.length - 1, Math.floor(place * across.length))];
      shown = name = s.name;
      const normal = s.normal.map(v => sign * v);
      state.plane = { normal, level: normal.reduce((sum, v, k) => sum + v * s.centre[k], 0) };
    } else if (kind !== 'off') {
      const k = 'xyz'.indexOf(kind), towards = scene.axis(2)[kind] >= 0 ? sign : -sign, level = beat.low[k] + place * (beat.high[k] - beat.low[k]);
      state.plane = { normal: [0, 1, 2].map(c => c === k ? towards : 0), level: towards * level };  // the near side goes
      name = `${kind} = ${tunica.number(Math.round(10 * level) / 10)} mm`;
    }
    const all = byId('all-sections').checked;
    state.sections = group => group.name === shown || all && group.kind === 'section' && group.name !== 'along the aorta';
    byId('cut-name').textContent = name;
    scene.setLook(state);
    dirty = true;
  }

  // --- the probe ---
  function tell() {
    const lines = [];
    for (const q of probed.body.quantities) {
      if (!tunica.isOf(q.of, probed.group.kind) && q !== probed.body.motion) continue;
      const value = q.at(probed.corners, probed.barycentric, clock.at, beat.frames);
      if (value !== null) lines.push([q.name, tunica.number(value), q.unit]);
    }
    const box = byId('probe');
    box.textContent = '';
    const head = document.createElement('p');
    head.textContent = `${probed.group.name.replaceAll('_', ' ')} at (${probed.reference.map(v => v.toFixed(2).replace('-', '−')).join(', ')}) mm`;
    const table = document.createElement('table');
    for (const line of lines) { const row = table.insertRow(); for (const text of line) row.insertCell().textContent = text; }
    box.append(head, table);
    const d = probed.body.displacement, moved = [0, 1, 2].map(k => probed.reference[k] + state.warp * probed.corners.reduce((sum, p, a) => sum + probed.barycentric[a] * d[3 * p + k], 0));
    scene.mark(moved);
    course();
  }

  /** The chosen quantity at the probed place over the beat. */
  function course() {
    const svg = byId('course'), q = probed.body.quantities.find(one => one.name === state.quantity), xml = 'http://www.w3.org/2000/svg';
    svg.textContent = '';
    if (!q || !q.changes) return;
    const values = beat.times.map((_, k) => q.at(probed.corners, probed.barycentric, k, beat.frames));
    if (values.some(v => v === null)) return;
    const low = Math.min(...values), high = Math.max(...values), y = v => 58 - 48 * (v - low) / (high - low || 1), x = k => 4 + 232 * k / Math.max(1, beat.frames - 1);
    const add = (name, attributes, text = '') => { const e = document.createElementNS(xml, name); for (const [k, v] of Object.entries(attributes)) e.setAttribute(k, v); e.textContent = text; svg.append(e); };
    add('polyline', { points: values.map((v, k) => `${x(k).toFixed(1)},${y(v).toFixed(1)}`).join(' '), class: 'curve' });
    add('line', { x1: x(clock.at), x2: x(clock.at), y1: 4, y2: 60, class: 'cursor' });
    add('text', { x: 4, y: 69 }, `${q.name}: ${tunica.number(low, 3)} to ${tunica.number(high, 3)} ${q.unit}`);
  }

  function probe(px, py) {
    probed = scene.pick(px, py);
    if (probed) tell();
    else { scene.mark(null); byId('probe').textContent = 'Nothing is there.'; byId('course').textContent = ''; }
    dirty = true;
  }

  // --- what lies over the picture ---
  const labels = beat.labels.map(l => { const e = document.createElement('span'); e.textContent = l.text; e.className = l.kind; byId('labels').append(e); return e; });

  function overlay() {
    const on = byId('show-labels').checked, taken = [];
    beat.labels.forEach((l, k) => {
      const [x, at] = scene.project(l.place), width = 6.5 * l.text.length + 10;
      const isFree = y => !taken.some(t => Math.abs(t[1] - y) < 16 && x < t[0] + t[2] && t[0] < x + width);
      const y = [0, 16, -16, 32, -32].map(d => at + d).find(isFree), free = y !== undefined;
      const inside = x > 0 && y > 8 && x < view.clientWidth - 20 && y < view.clientHeight - 8;
      labels[k].hidden = !(on && free && inside);
      if (labels[k].hidden) return;
      taken.push([x, y, width]);
      labels[k].style.transform = `translate(${x.toFixed(0)}px, ${y.toFixed(0)}px)`;
    });
    // On paper the picture and what lies over it keep their proportions.
    const stage = view.parentElement.style;
    stage.setProperty('--width', view.clientWidth);
    stage.setProperty('--height', view.clientHeight);
    const target = 110 * scene.perPixel, power = 10 ** Math.floor(Math.log10(target));
    const length = [1, 2, 5, 10].map(f => f * power).filter(v => v <= 1.01 * target).pop();
    byId('scale').style.width = `${length / scene.perPixel}px`;
    byId('scale').textContent = `${+length.toPrecision(3)} mm`;
    triad();
  }

  function triad() {
    const svg = byId('triad'), names = ['x', 'y', 'z'], xml = 'http://www.w3.org/2000/svg';
    svg.textContent = '';
    [0, 1, 2].map(k => [k, ['x', 'y', 'z'][k]]).map(([k, c]) => ({ k, x: 26 * scene.axis(0)[c], y: -26 * scene.axis(1)[c], z: scene.axis(2)[c] }))
      .sort((a, b) => a.z - b.z).forEach(({ k, x, y }) => {
        const line = document.createElementNS(xml, 'line'), text = document.createElementNS(xml, 'text');
        for (const [n, v] of [['x2', x], ['y2', y], ['class', `axis-${k}`]]) line.setAttribute(n, v);
        text.style.opacity = Math.min(1, Math.hypot(x, y) / 10);
        for (const [n, v] of [['x', 1.32 * x], ['y', 1.32 * y + 4], ['text-anchor', 'middle']]) text.setAttribute(n, v);
        text.textContent = names[k];
        svg.append(line, text);
      });
  }

  function loop(now) {
    if (clock.playing) {
      clock.at = (clock.at + (now - last) / 1000 * (beat.frames - 1) / +byId('speed').value) % (beat.frames - 1);
      refresh();
    }
    last = now;
    if (dirty) {
      dirty = fine = false;
      moved = now;
      scene.draw();
      overlay();
    } else if (!fine && now - moved > 250) {
      fine = true;
      scene.draw(true);
    }
    view.dataset.rests = fine;
    requestAnimationFrame(loop);
  }

  // --- controls ---
  const names = { outer: 'outside of the wall', inner: kinds.has('outer') ? 'inside, where blood meets the wall' : 'inside of the vessel', opening: 'openings' };
  for (const [kind, name] of Object.entries(names)) {
    if (!kinds.has(kind)) continue;
    const label = document.createElement('label'), slider = document.createElement('input');
    Object.assign(slider, { type: 'range', min: 0, max: 1, step: 0.02, value: 1, id: `opacity-${kind}`, oninput: () => { state.opacity[kind] = +slider.value; scene.setLook(state); dirty = true; } });
    label.append(name, slider);
    byId('shown').append(label);
  }
  for (const name of scene.families || []) {
    const label = document.createElement('label'), box = document.createElement('input');
    Object.assign(box, { type: 'checkbox', id: `fibres-${name.replace(' ', '-')}`, onchange: () => { state.families[box.checked ? 'add' : 'delete'](name); scene.setLook(state); dirty = true; } });
    label.append(box, ` fibres, ${name}`);
    byId('shown').append(label);
  }
  byId('regions-set').hidden = regions.length < 2;
  for (const name of regions) {
    const label = document.createElement('label'), box = document.createElement('input');
    Object.assign(box, { type: 'checkbox', checked: true, onchange: () => { state.hidden[box.checked ? 'delete' : 'add'](name); scene.setLook(state); dirty = true; } });
    label.append(box, ' ' + name.replaceAll('_', ' '));
    byId('regions').append(label);
  }
  const play = on => { clock.playing = on && beat.frames > 1; byId('play').textContent = clock.playing ? '❚❚' : '▶'; byId('play').setAttribute('aria-label', clock.playing ? 'pause' : 'play'); };
  const to = frame => { clock.at = Math.min(beat.frames - 1, Math.max(0, frame)); refresh(); };
  byId('time').max = beat.frames - 1;
  byId('time').oninput = () => { play(false); to(+byId('time').value); };
  byId('play').onclick = () => play(!clock.playing);
  byId('quantity').onchange = () => choose(byId('quantity').value);
  byId('map').onchange = () => { scene.setMap(byId('map').value); legend(); dirty = true; };
  byId('low').onchange = byId('high').onchange = event => {
    const [low, high] = ['low', 'high'].map(id => parseFloat(byId(id).value));
    for (const id of ['low', 'high']) byId(id).setCustomValidity('');
    if (!(high > low)) {
      event.target.setCustomValidity('The colours need two numbers, the second above the first; the old ones stay.');
      return event.target.reportValidity();
    }
    state.range = [low, high];
    scene.setLook(state);
    legend();
    dirty = true;
  };
  byId('cut').onchange = byId('cut-place').oninput = byId('flip').onchange = byId('all-sections').onchange = cut;
  byId('warp').oninput = () => { state.warp = +byId('warp').value; byId('warp-value').textContent = state.warp; refresh(); };
  byId('show-labels').onchange = () => { dirty = true; };
  byId('reset').onclick = () => { scene.look(beat.view, beat.up); dirty = true; };
  byId('side').onclick = () => { scene.turn(Math.PI / 2, 0); scene.fit(); dirty = true; };
  const save = (blob, name) => { const a = document.createElement('a'); a.href = URL.createObjectURL(blob); a.download = name; a.click(); setTimeout(() => URL.revokeObjectURL(a.href), 1e4); };
  byId('png').onclick = () => { scene.draw(true); view.toBlob(blob => save(blob, `${state.quantity.replaceAll(' ', '_')}.png`)); };
  byId('video').hidden = !(view.captureStream && window.MediaRecorder) || beat.frames < 2;
  byId('video').onclick = () => {
    const seconds = +byId('speed').value, recorder = new MediaRecorder(view.captureStream(25), { mimeType: 'video/webm' }), parts = [];
    recorder.ondataavailable = e => parts.push(e.data);
    recorder.onstop = () => { play(false); byId('video').disabled = false; save(new Blob(parts, { type: 'video/webm' }), `${state.quantity.replaceAll(' ', '_')}.webm`); };
    byId('video').disabled = true;
    clock.at = 0;
    play(true);
    recorder.start();
    setTimeout(() => recorder.stop(), 1000 * seconds);
  };

  // --- pointers and keys ---
  const pointers = new Map();
  let way = 0;
  view.onpointerdown = e => { view.setPointerCapture(e.pointerId); pointers.set(e.pointerId, [e.clientX, e.clientY]); if (pointers.size === 1) way = 0; };
  view.onpointermove = e => {
    const before = pointers.get(e.pointerId);
    if (!before) return;
    const dx = e.clientX - before[0], dy = e.clientY - before[1];
    way += Math.abs(dx) + Math.abs(dy);
    if (pointers.size === 2) {
      const other = [...pointers].find(([id]) => id !== e.pointerId)[1], far = p => Math.hypot(p[0] - other[0], p[1] - other[1]);
      scene.zoom *= far([e.clientX, e.clientY]) / Math.max(1, far(before));
      scene.pan(dx / 2, dy / 2);
    } else if (e.shiftKey || e.buttons === 2 || e.buttons === 4) scene.pan(dx, dy);
    else scene.turn(0.008 * dx, 0.008 * dy);
    pointers.set(e.pointerId, [e.clientX, e.clientY]);
    dirty = true;
  };
  view.onpointerup = view.onpointercancel = e => {
    const single = pointers.size === 1;
    pointers.delete(e.pointerId);
    if (e.type === 'pointerup' && single && way < 5) { const box = view.getBoundingClientRect(); probe(e.clientX - box.left, e.clientY - box.top); }
  };
  view.oncontextmenu = e => e.preventDefault();
  view.addEventListener('wheel', e => { e.preventDefault(); scene.zoom *= Math.exp(-0.0012 * e.deltaY); dirty = true; }, { passive: false });
  const keys = { ArrowLeft: () => scene.turn(-0.1, 0), ArrowRight: () => scene.turn(0.1, 0), ArrowUp: () => scene.turn(0, -0.1), ArrowDown: () => scene.turn(0, 0.1),
    '+': () => { scene.zoom *= 1.1; }, '-': () => { scene.zoom /= 1.1; }, ' ': () => play(!clock.playing), ',': () => to(Math.ceil(clock.at) - 1), '.': () => to(Math.floor(clock.at) + 1), 0: () => scene.look(beat.view, beat.up) };
  view.onkeydown = e => { if (!keys[e.key] || e.ctrlKey || e.metaKey) return; keys[e.key](); e.preventDefault(); dirty = true; };
  document.addEventListener('tunica-seek', e => {  // a click on a curve
    const k = beat.times.findIndex(t => t >= e.detail);
    play(false);
    to(k <= 0 ? 0 : k - 1 + (e.detail - beat.times[k - 1]) / (beat.times[k] - beat.times[k - 1]));
  });
  new ResizeObserver(() => { dirty = true; }).observe(view);

  const preferred = ['von Mises stress', 'wall shear stress', 'pressure'].find(name => quantities.has(name)) || [...quantities.keys()][0];
  clock.at = beat.start || 0;
  choose(preferred);
  scene.draw();
  overlay();
  requestAnimationFrame(loop);
  tunica.measure = count => {  // ms for a change of time with its picture, for tests
    const start = performance.now();
    for (let k = 0; k < count; ++k) { clock.at = k % beat.frames; refresh(); scene.draw(); if (scene.renderer) { const gl = scene.renderer.getContext(); gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4)); } }
    return (performance.now() - start) / count;
  };
  Object.assign(document.body.dataset, { viewer: 'ready', drawn, seconds: ((performance.now() - began) / 1000).toFixed(3), after: (performance.now() / 1000).toFixed(3) });
  message.textContent = drawn === 'WebGL' ? '' : 'There is no WebGL here: a plain drawing, which turns slowly.';
})().catch(error => {
  document.body.dataset.viewer = 'failed';
  document.getElementById('viewer-message').textContent = `The view cannot be shown: ${error.message}`;
});
