// The same scene without WebGL: flat triangles from back to front on a plain canvas. Turns and plays too, slowly.
'use strict';
(() => {
  class Still {
    constructor(canvas, beat) {
      Object.assign(this, { canvas, beat, zoom: 1, shift: [0, 0], map: 'viridis', state: null });
      this.context = canvas.getContext('2d');
      this.look(beat.view, beat.up);
    }

    look(direction, up) {
      const unit = v => { const n = Math.hypot(...v) || 1; return v.map(c => c / n); };
      const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
      const z = unit(direction), x = unit(cross(up, z));
      this.axes = [x, cross(z, x), z];
      this.zoom = 1;
      this.shift = [0, 0];
      this.fit();
    }

    fit() {
      this.half = [1e-3, 1e-3];
      for (const body of this.beat.bodies)
        for (let i = 0; i < body.points; i += 7)
          for (const k of [0, 1]) this.half[k] = Math.max(this.half[k], Math.abs(this.along(k, body.reference, i)));
    }

    along(k, array, i) {
      return [0, 1, 2].reduce((sum, c) => sum + this.axes[k][c] * (array[3 * i + c] - this.beat.centre[c]), 0);
    }

    axis(k) { const [x, y, z] = this.axes[k]; return { x, y, z }; }

    turn(x, y) {
      const rotate = (a, b, angle) => {
        const c = Math.cos(angle), s = Math.sin(angle), A = this.axes[a], B = this.axes[b];
        this.axes[a] = A.map((v, k) => c * v + s * B[k]);
        this.axes[b] = B.map((v, k) => c * v - s * A[k]);
      };
      rotate(0, 2, x);
      rotate(1, 2, -y);
    }

    pan(x, y) { this.shift[0] -= x * this.perPixel; this.shift[1] += y * this.perPixel; }
    setMap(name) { this.map = name; }
    setLook(state) { this.state = state; }
    mark(x) { this.marked = x; }

    setTime(time, name) {
      for (const body of this.beat.bodies) {
        if (body.motion) body.motion.evaluate(body.motion.changes ? time : 0, this.beat.frames, body.displacement);
        for (const q of body.quantities) if (q.name === name) tunica.fill(body, q, time, this.beat.frames);
      }
    }

    shown(group) {
      const s = this.state;
      if (group.kind.endsWith('section')) return s.sections(group);
      return s.opacity[group.kind === 'end' ? 'outer' : group.kind] > 0.3 && !s.hidden.has(group.name);
    }

    draw() {
      const ratio = Math.min(window.devicePixelRatio || 1, 2), s = this.state, g = this.context;
      [this.width, this.height] = [this.canvas.clientWidth, Math.max(1, this.canvas.clientHeight)];
      [this.canvas.width, this.canvas.height] = [this.width * ratio, this.height * ratio];
      this.perPixel = 2.16 * Math.max(this.half[1], this.half[0] * this.height / this.width) / this.zoom / this.height;
      g.scale(ratio, ratio);
      this.faces = [];
      for (const body of this.beat.bodies) {
        const flat = new Float32Array(3 * body.points), moved = body.reference.map((v, i) => v + s.warp * body.displacement[i]);
        for (let i = 0; i < body.points; ++i) {
          flat[3 * i] = 0.5 * this.width + (this.along(0, moved, i) - this.shift[0]) / this.perPixel;
          flat[3 * i + 1] = 0.5 * this.height - (this.along(1, moved, i) - this.shift[1]) / this.perPixel;
          flat[3 * i + 2] = this.along(2, moved, i);
        }
        for (const group of body.groups) if (this.shown(group)) this.collect(body, group, flat, moved);
      }
      this.faces.sort((a, b) => a.depth - b.depth);
      for (const f of this.faces) {
        g.fillStyle = g.strokeStyle = f.colour;
        g.beginPath();
        f.x.forEach((x, k) => g[k ? 'lineTo' : 'moveTo'](x, f.y[k]));
        g.closePath();
        g.fill();
        g.stroke();
      }
    }

    collect(body, group, flat, moved) {
      const s = this.state, q = body.quantities.find(one => one.name === s.quantity && tunica.isOf(one.of, group.kind));
      for (let t = group.first; t < group.first + group.count; t += 3) {
        const corners = [...body.triangles.subarray(t, t + 3)], x = corners.map(c => flat[3 * c]), y = corners.map(c => flat[3 * c + 1]);
        const reference = [0, 1, 2].map(k => corners.reduce((sum, c) => sum + body.reference[3 * c + k] / 3, 0));
        if (s.plane && !group.kind.endsWith('section') && reference.reduce((sum, v, k) => sum + v * s.plane.normal[k], 0) > s.plane.level) continue;
        const [u, v] = [1, 2].map(e => [0, 1, 2].map(k => moved[3 * corners[e] + k] - moved[3 * corners[0] + k]));
        const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        const light = 0.45 + 0.55 * Math.abs(n.reduce((sum, c, k) => sum + c * this.axes[2][k], 0)) / (Math.hypot(...n) || 1);
        const value = corners.reduce((sum, c) => sum + body.values[c] / 3, 0);
        const rgb = q ? tunica.colour(this.map, (value - s.range[0]) / (s.range[1] - s.range[0])) : [189, 184, 179];
        this.faces.push({ x, y, depth: corners.reduce((sum, c) => sum + flat[3 * c + 2], 0), body, group, corners, reference,
          colour: `rgb(${rgb.map(c => Math.round(light * c)).join()})` });
      }
    }

    project(x) {
      return [0.5 * this.width + (this.along(0, x, 0) - this.shift[0]) / this.perPixel, 0.5 * this.height - (this.along(1, x, 0) - this.shift[1]) / this.perPixel];
    }

    pick(px, py) {
      for (const f of [...this.faces].reverse()) {
        const [ax, bx, cx] = f.x.map(v => v - px), [ay, by, cy] = f.y.map(v => v - py), area = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay);
        const l = [(bx * cy - cx * by) / area, (cx * ay - ax * cy) / area];
        l.push(1 - l[0] - l[1]);
        if (!(area !== 0) || l.some(v => v < 0)) continue;
        const at = array => [0, 1, 2].map(k => l.reduce((sum, w, a) => sum + w * array[3 * f.corners[a] + k], 0));
        const reference = at(f.body.reference), moved = at(f.body.displacement);
        return { ...f, barycentric: l, reference, place: reference.map((v, k) => v + this.state.warp * moved[k]) };
      }
      return null;
    }
  }
  tunica.Still = Still;
})();
