// Curves of the page: drawn from the numbers beneath the picture, with zoom, values under the pointer, the instant that the viewer shows, CSV and SVG.
'use strict';
(() => {
  const source = document.getElementById('plots');
  if (!source) return;
  const plots = JSON.parse(source.textContent), xml = 'http://www.w3.org/2000/svg';
  const colours = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#b8860b', '#56b4e9', '#7a5195'], dashes = ['', '8 3', '2 3', '9 3 2 3'];
  const box = { width: 560, height: 310, left: 62, right: 14, top: 12, bottom: 46 };
  const ticks = (low, high, count) => {
    const raw = (high - low) / count, power = 10 ** Math.floor(Math.log10(raw)), step = [1, 2, 5, 10].map(f => f * power).find(s => s >= 0.999 * raw), list = [];
    for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i) list.push(i === 0 ? 0 : +(i * step).toPrecision(12));
    return { list, step };
  };
  const text = v => String(v).replace('-', '−');
  const save = (content, name, type) => { const a = document.createElement('a'); a.href = URL.createObjectURL(new Blob([content], { type })); a.download = name; a.click(); setTimeout(() => URL.revokeObjectURL(a.href), 1e4); };

  class Plot {
    constructor(figure, data) {
      Object.assign(this, { figure, data, hidden: new Set(), instant: null });
      const svg = document.createElementNS(xml, 'svg');
      for (const [k, v] of [['viewBox', `0 0 ${box.width} ${box.height}`], ['role', 'img'], ['aria-label', this.summary()], ['class', 'curves'], ['xmlns', xml]]) svg.setAttribute(k, v);
      figure.querySelector('svg, img')?.remove();
      figure.prepend(svg);
      this.svg = svg;
      this.value = document.createElement('div');
      this.value.className = 'value';
      this.value.hidden = true;
      figure.append(this.value);
      this.tools();
      this.legend();
      this.listen();
      this.whole();
    }

    summary() {
      const all = this.data.curves.filter(c => c.y.length);
      return `${this.data.title}. ` + all.map(c => `${c.name || 'curve'}: ${Math.min(...c.y).toPrecision(3)} to ${Math.max(...c.y).toPrecision(3)}`).join('; ');
    }

    name() { return this.data.title.toLowerCase().replace(/[^a-z0-9]+/g, '_'); }

    tools() {
      const bar = document.createElement('div');
      bar.className = 'tools';
      for (const [label, action] of [['whole', () => this.whole()], ['CSV', () => save(this.csv(), this.name() + '.csv', 'text/csv')], ['SVG', () => save(new XMLSerializer().serializeToString(this.svg), this.name() + '.svg', 'image/svg+xml')]]) {
        const button = document.createElement('button');
        Object.assign(button, { type: 'button', textContent: label, onclick: action });
        button.setAttribute('aria-label', `${label}: ${this.data.title}`);
        bar.append(button);
      }
      this.figure.append(bar);
    }

    csv() {
      const rows = [];
      this.data.curves.forEach(c => c.x.forEach((x, k) => rows.push([`"${c.name.replaceAll('"', '""')}"`, x, c.y[k]].join())));
      return `curve,${this.data.x_label},${this.data.y_label}\n${rows.join('\n')}\n`;
    }

    legend() {
      const list = document.createElement('div');
      list.className = 'keys';
      this.data.curves.forEach((c, k) => {
        if (!c.name) return;
        const button = document.createElement('button'), line = document.createElementNS(xml, 'svg');
        line.setAttribute('viewBox', '0 0 30 8');
        line.setAttribute('aria-hidden', 'true');
        this.stroke(this.add('line', { x1: 1, x2: 29, y1: 4, y2: 4 }, '', line), c);
        Object.assign(button, { type: 'button', onclick: () => { this.hidden[this.hidden.has(k) ? 'delete' : 'add'](k); button.setAttribute('aria-pressed', !this.hidden.has(k)); this.draw(); } });
        button.setAttribute('aria-pressed', 'true');
        button.append(line, c.name.replaceAll('_', ' '));
        list.append(button);
      });
      this.figure.insertBefore(list, this.figure.querySelector('figcaption'));
    }

    add(name, attributes, content = '', parent = this.svg) {
      const e = document.createElementNS(xml, name);
      for (const [k, v] of Object.entries(attributes)) e.setAttribute(k, v);
      if (content !== '') e.textContent = content;
      parent.append(e);
      return e;
    }

    stroke(element, curve) {
      const dash = dashes[Math.floor(curve.style / colours.length) % dashes.length];
      for (const [k, v] of [['stroke', colours[curve.style % colours.length]], ['stroke-width', curve.role ? 1.2 : 1.8], ['fill', 'none'], ['stroke-dasharray', curve.role === 'target' ? '2 4' : dash]]) if (v !== '') element.setAttribute(k, v);
      return element;
    }

    whole() {
      const shown = this.data.curves.filter((_, k) => !this.hidden.has(k)), xs = shown.flatMap(c => c.x), ys = shown.flatMap(c => c.y).filter(Number.isFinite);
      if (!xs.length || !ys.length) return;
      let [x0, x1, y0, y1] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
      if (x1 <= x0) x1 = x0 + 1;
      if (y1 - y0 <= 1e-9 * Math.max(Math.abs(y0), Math.abs(y1), 1e-12)) { const room = 0.1 * Math.abs(y0) || 1; y0 -= room; y1 += room; }
      const step = ticks(y0, y1, 5).step;
      this.window = [x0, x1, step * Math.floor(y0 / step + 1e-9), step * Math.ceil(y1 / step - 1e-9)];
      this.draw();
    }

    px(x) { return box.left + (x - this.window[0]) / (this.window[1] - this.window[0]) * (box.width - box.left - box.right); }
    py(y) { return box.height - box.bottom - (y - this.window[2]) / (this.window[3] - this.window[2]) * (box.height - box.top - box.bottom); }

    draw() {
      const [x0, x1, y0, y1] = this.window, right = box.width - box.right, bottom = box.height - box.bottom, grey = { stroke: 'currentColor', 'stroke-opacity': 0.15 };
      this.svg.textContent = '';
      const font = { fill: 'currentColor', 'font-size': 12, 'font-family': 'system-ui, sans-serif' };
      for (const v of ticks(x0, x1, 8).list) { this.add('line', { x1: this.px(v), x2: this.px(v), y1: box.top, y2: bottom, ...grey }); this.add('text', { x: this.px(v), y: bottom + 17, 'text-anchor': 'middle', ...font }, text(v)); }
      for (const v of ticks(y0, y1, 5).list) { this.add('line', { x1: box.left, x2: right, y1: this.py(v), y2: this.py(v), ...grey }); this.add('text', { x: box.left - 7, y: this.py(v) + 4, 'text-anchor': 'end', ...font }, text(v)); }
      this.add('text', { x: 0.5 * (box.left + right), y: box.height - 8, 'text-anchor': 'middle', ...font }, this.data.x_label);
      this.add('text', { x: 14, y: 0.5 * (box.top + bottom), 'text-anchor': 'middle', transform: `rotate(-90 14 ${0.5 * (box.top + bottom)})`, ...font }, this.data.y_label);
      const id = `clip-${this.figure.dataset.plot}`, clip = this.add('clipPath', { id });
      this.add('rect', { x: box.left, y: box.top, width: right - box.left, height: bottom - box.top }, '', clip);
      const area = this.add('g', { 'clip-path': `url(#${id})` });
      if (y0 < 0 && y1 > 0) this.add('line', { x1: box.left, x2: right, y1: this.py(0), y2: this.py(0), stroke: 'currentColor', 'stroke-opacity': 0.5 }, '', area);
      this.data.curves.forEach((c, k) => {
        if (this.hidden.has(k)) return;
        let d = '', pen = 'M';
        c.x.forEach((x, i) => { if (Number.isFinite(c.y[i])) { d += `${pen}${this.px(x).toFixed(1)} ${this.py(c.y[i]).toFixed(1)}`; pen = 'L'; } else pen = 'M'; });
        this.stroke(this.add('path', { d, 'stroke-linejoin': 'round' }, '', area), c);
      });
      this.line = this.add('line', { y1: box.top, y2: bottom, stroke: '#d0021b', 'stroke-width': 1.2, visibility: 'hidden' }, '', area);
      this.add('rect', { x: box.left, y: box.top, width: right - box.left, height: bottom - box.top, fill: 'none', stroke: 'currentColor', 'stroke-opacity': 0.4 });
      this.showInstant(this.instant);
    }

    showInstant(seconds) {
      this.instant = seconds;
      if (!this.data.in_time || seconds === null) return;
      const x = this.px(seconds);
      for (const k of ['x1', 'x2']) this.line.setAttribute(k, x);
      this.line.setAttribute('visibility', 'visible');
    }

    /** Place of a pointer in the units of the axes. */
    at(e) {
      const b = this.svg.getBoundingClientRect(), u = (e.clientX - b.left) / b.width * box.width, v = (e.clientY - b.top) / b.height * box.height, [x0, x1, y0, y1] = this.window;
      return [x0 + (u - box.left) / (box.width - box.left - box.right) * (x1 - x0), y0 + (box.height - box.bottom - v) / (box.height - box.top - box.bottom) * (y1 - y0)];
    }

    listen() {
      let start = null;
      this.svg.addEventListener('pointerdown', e => { start = this.at(e); });
      this.svg.addEventListener('pointerup', e => {
        if (!start) return;
        const end = this.at(e), [x0, x1] = [start[0], end[0]].sort((a, b) => a - b);
        if (x1 - x0 > 0.03 * (this.window[1] - this.window[0])) { this.window = [x0, x1, this.window[2], this.window[3]]; this.draw(); }
        else if (this.data.in_time) document.dispatchEvent(new CustomEvent('tunica-seek', { detail: end[0] }));
        start = null;
      });
      this.svg.addEventListener('dblclick', () => this.whole());
      this.svg.addEventListener('pointermove', e => this.tell(this.at(e)[0], e));
      this.svg.addEventListener('pointerleave', () => { this.value.hidden = true; });
    }

    tell(x, e) {
      if (x < this.window[0] || x > this.window[1]) { this.value.hidden = true; return; }
      const lines = [`${this.data.x_label.replace(/ \[.*/, '')} ${+x.toPrecision(4)}`];
      this.data.curves.forEach((c, k) => {
        if (this.hidden.has(k) || !c.name || !c.x.length || x < c.x[0] || x > c.x[c.x.length - 1]) return;
        let i = c.x.findIndex(v => v >= x);
        if (i > 0 && x - c.x[i - 1] < c.x[i] - x) --i;
        lines.push(`${c.name.replaceAll('_', ' ')}: ${text(+c.y[i].toPrecision(4))}`);
      });
      this.value.textContent = lines.join('\n');
      this.value.hidden = false;
      const b = this.figure.getBoundingClientRect();
      this.value.style.left = `${Math.min(e.clientX - b.left + 14, b.width - 190)}px`;
      this.value.style.top = `${e.clientY - b.top + 14}px`;
    }
  }

  box.width = Math.max(300, Math.min(box.width, document.querySelector('main').clientWidth));  // letters of one size on a phone too
  const drawn = [...document.querySelectorAll('figure[data-plot]')].map(f => new Plot(f, plots[+f.dataset.plot]));
  document.addEventListener('tunica-time', e => drawn.forEach(p => p.showInstant(e.detail)));

  // On paper everything is open.
  let opened = [];
  window.addEventListener('beforeprint', () => { opened = [...document.querySelectorAll('details:not([open], .help)')]; opened.forEach(d => { d.open = true; }); });
  window.addEventListener('afterprint', () => { opened.forEach(d => { d.open = false; }); });

  // Tables that sort: a click on a heading.
  for (const table of document.querySelectorAll('table.sorts'))
    table.querySelectorAll('thead th').forEach((head, column) => {
      if (!head.textContent.trim()) return;
      const button = document.createElement('button');
      if (head.querySelector('.aside')) head.style.textAlign = 'left';  // as the cells below
      Object.assign(button, { type: 'button', textContent: head.textContent });
      head.textContent = '';
      head.append(button);
      button.onclick = () => {
        const body = table.tBodies[0], up = head.getAttribute('aria-sort') !== 'ascending', number = t => parseFloat(t.replace('−', '-'));
        table.querySelectorAll('th[aria-sort]').forEach(h => h.removeAttribute('aria-sort'));
        head.setAttribute('aria-sort', up ? 'ascending' : 'descending');
        const key = row => row.cells[column].textContent;
        body.append(...[...body.rows].sort((a, b) => {
          const [x, y] = [number(key(a)), number(key(b))];
          return (up ? 1 : -1) * (Number.isNaN(x) || Number.isNaN(y) ? key(a).localeCompare(key(b)) : x - y);
        }));
      };
    });
})();
