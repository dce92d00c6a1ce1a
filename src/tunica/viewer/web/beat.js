// The beat that a page holds: reads what pack.cpp wrote, and gives quantities at any time.
'use strict';
const tunica = {};
(() => {
  const byId = id => document.getElementById(id);

  /** Inverse of Store::add in pack.cpp: bytes in planes, differences folded to small numbers. */
  function unpack(bytes, place) {
    const { o, n, w } = place, values = new Int32Array(n), mask = w === 4 ? -1 : (1 << (8 * w)) - 1;
    let before = 0;
    for (let i = 0; i < n; ++i) {
      let folded = 0;
      for (let b = 0; b < w; ++b) folded |= bytes[o + b * n + i] << (8 * b);
      const difference = (folded >>> 1) ^ -(folded & 1);
      before = (before + difference) & mask;
      values[i] = before;
    }
    return values;
  }

  /** The same for numbers with a sign. */
  function unpackSigned(bytes, place) {
    const values = unpack(bytes, place), shift = 32 - 8 * place.w, narrow = new Int16Array(values.length);
    for (let i = 0; i < values.length; ++i) narrow[i] = (values[i] << shift) >> shift;
    return narrow;
  }

  /** Numbers of a quantity lie component after component; asked for when it is first shown. */
  class Quantity {
    constructor(bytes, head) {
      Object.assign(this, head);
      this.place = head;
      this.bytes = bytes;
      this.numbers = null;
    }

    get changes() { return this.modes.length > 0; }

    load() {
      if (!this.numbers)
        this.numbers = [[this.ms, unpackSigned(this.bytes, this.place.mean), null],
          ...this.place.modes.map(m => [m.s, unpackSigned(this.bytes, m.v), m.c])];
      return this.numbers;
    }

    /** Weight of each part between two frames; `at` counts frames. */
    weights(at, frames) {
      const a = Math.min(frames - 1, Math.floor(at)), b = Math.min(frames - 1, a + 1), r = at - a;
      return this.load().map(([step, , c]) => c ? step * ((1 - r) * c[a] + r * c[b]) : step);
    }

    /** All values at a time into `out`: of a vector three for each point, one after the other. */
    evaluate(at, frames, out) {
      const weights = this.weights(at, frames), n = this.count, k = this.components;
      for (let c = 0; c < k; ++c)
        for (let part = 0; part < weights.length; ++part) {
          const w = weights[part], values = this.numbers[part][1];
          if (part === 0) for (let i = 0; i < n; ++i) out[k * i + c] = w * values[c * n + i];
          else if (w !== 0) for (let i = 0; i < n; ++i) out[k * i + c] += w * values[c * n + i];
        }
    }

    has(point) { return point >= this.first && point < this.first + this.count; }

    /** Value (length of a vector) at a place in a triangle; null where the quantity is not there. */
    at(corners, barycentric, time, frames) {
      if (!corners.every(p => this.has(p))) return null;
      const weights = this.weights(time, frames), n = this.count, vector = [];
      for (let c = 0; c < this.components; ++c) {
        let sum = 0;
        corners.forEach((p, a) => weights.forEach((w, part) => {
          sum += barycentric[a] * w * this.numbers[part][1][c * n + p - this.first];
        }));
        vector.push(sum);
      }
      return this.components === 1 ? vector[0] : Math.hypot(...vector);
    }
  }

  class Body {
    constructor(bytes, head, beat) {
      this.name = head.name;
      this.groups = head.groups;
      const whole = unpack(bytes, head.points), n = whole.length / 3;
      this.points = n;
      this.reference = new Float32Array(3 * n);  // mm
      for (let c = 0; c < 3; ++c)
        for (let i = 0; i < n; ++i) this.reference[3 * i + c] = beat.origin[c] + beat.step * whole[c * n + i];
      this.triangles = new Uint32Array(unpack(bytes, head.triangles));
      this.quantities = head.quantities.map(q => new Quantity(bytes, q));
      this.motion = this.quantities.find(q => q.name === 'displacement') || null;
      this.displacement = new Float32Array(3 * n);
      this.values = new Float32Array(n);
    }
  }

  /** Short lines on the first body: middles [mm] and directions, component by component in the file. */
  function readLines(bytes, head, beat) {
    const whole = unpack(bytes, head.places), along = unpackSigned(bytes, head.directions), n = whole.length / 3;
    const lines = { ...head, count: n, points: unpack(bytes, head.points), middles: new Float32Array(3 * n), along: new Float32Array(3 * n) };
    for (let i = 0; i < n; ++i) {
      const d = [0, 1, 2].map(c => along[c * n + i]), size = Math.hypot(...d) || 1;
      for (let c = 0; c < 3; ++c) {
        lines.middles[3 * i + c] = beat.origin[c] + beat.step * whole[c * n + i];
        lines.along[3 * i + c] = d[c] / size;
      }
    }
    return lines;
  }

  /** Throws where the browser cannot inflate or the data are damaged. */
  tunica.readBeat = async () => {
    const head = JSON.parse(byId('beat-head').textContent);
    const text = atob(byId('beat-data').textContent.trim()), packed = new Uint8Array(text.length);
    for (let i = 0; i < text.length; ++i) packed[i] = text.charCodeAt(i);
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
    const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
    const beat = { ...head, frames: head.times.length };
    beat.bodies = head.bodies.map(b => new Body(bytes, b, head));
    beat.lines = (head.lines || []).map(l => readLines(bytes, l, head));
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    for (const body of beat.bodies)
      for (let i = 0; i < body.reference.length; ++i) {
        low[i % 3] = Math.min(low[i % 3], body.reference[i]);
        high[i % 3] = Math.max(high[i % 3], body.reference[i]);
      }
    beat.low = low;
    beat.high = high;
    beat.centre = low.map((v, c) => 0.5 * (v + high[c]));
    beat.size = Math.hypot(...high.map((v, c) => v - low[c]));
    return beat;
  };

  // Colour maps at equal distances: perceptually uniform ones of matplotlib (viridis, inferno), cividis for the colour-blind, and a diverging one
  // (Moreland 2009) for signed quantities.
  tunica.maps = {
    viridis: [[68, 1, 84], [72, 40, 120], [62, 74, 137], [49, 104, 142], [38, 130, 142], [31, 158, 137], [53, 183, 121], [109, 205, 89], [180, 222, 44], [253, 231, 37]],
    inferno: [[0, 0, 4], [31, 12, 72], [85, 15, 109], [136, 34, 106], [186, 54, 85], [227, 89, 51], [249, 140, 10], [249, 201, 50], [252, 255, 164]],
    cividis: [[0, 34, 78], [18, 53, 112], [59, 73, 108], [87, 93, 109], [112, 113, 115], [138, 134, 120], [165, 156, 116], [195, 179, 105], [225, 204, 85], [254, 232, 56]],
    diverging: [[59, 76, 192], [104, 138, 239], [153, 186, 255], [201, 216, 240], [221, 221, 221], [247, 197, 174], [246, 146, 116], [222, 86, 72], [180, 4, 38]],
  };

  /** Of things that have no order, such as regions (Okabe & Ito 2008, without black); after seven they come again. */
  tunica.categories = [[86, 180, 233], [230, 159, 0], [0, 158, 115], [240, 228, 66], [204, 121, 167], [0, 114, 178], [213, 94, 0]];

  /** Colour (0 to 255) of a share of the range. */
  tunica.colour = (map, share) => {
    const table = tunica.maps[map], at = Math.min(1, Math.max(0, share)) * (table.length - 1);
    const k = Math.min(table.length - 2, Math.floor(at)), r = at - k;
    return table[k].map((v, c) => Math.round((1 - r) * v + r * table[k + 1][c]));
  };

  /** Round numbers within an interval: about `count` multiples of 1, 2 or 5 times a power of ten. */
  tunica.ticks = (low, high, count = 5) => {
    if (!(high > low)) return [low];
    const raw = (high - low) / count, power = 10 ** Math.floor(Math.log10(raw));
    const step = [1, 2, 5, 10].map(f => f * power).find(s => s >= 0.999 * raw), ticks = [];
    for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i)
      ticks.push(i === 0 ? 0 : +(i * step).toPrecision(12));
    return ticks;
  };

  /** Four significant digits, no 1.2e+2. */
  tunica.number = (v, digits = 4) => {
    if (!Number.isFinite(v)) return '–';
    if (v === 0) return '0';
    const size = Math.floor(Math.log10(Math.abs(v)));
    if (size < -5 || size > 7) return v.toExponential(digits - 1);
    return v.toFixed(Math.max(0, digits - 1 - size)).replace('-', '−');
  };
})();
