// Draws the beat with three.js: motion, colours, cuts, the camera, and which place lies under the pointer.
'use strict';
(() => {
  const vertexShader = `
    attribute vec3 d; attribute float s; uniform float warp;
    varying float v_s; varying vec3 v_n; varying vec3 v_x;
    void main() { v_s = s; v_x = position; v_n = normalMatrix * normal;
      gl_Position = projectionMatrix * modelViewMatrix * vec4(position + warp * d, 1.0); }`;
  // What lies beyond the plane of the cut, in the reference, is left out; colours outside the range are those of its ends.
  const fragmentShader = `
    uniform vec2 range; uniform sampler2D map; uniform vec4 plane; uniform float opacity, coloured, cut; uniform vec3 plain;
    varying float v_s; varying vec3 v_n; varying vec3 v_x;
    void main() {
      if (cut > 0.5 && dot(v_x, plane.xyz) > plane.w) discard;
      vec3 n = normalize(v_n); if (!gl_FrontFacing) n = -n;
      float light = 0.38 + 0.52 * max(0.0, dot(n, normalize(vec3(0.3, 0.4, 1.0)))) + 0.16 * abs(n.z);
      vec3 c = coloured > 0.5 ? texture2D(map, vec2(clamp((v_s - range.x) / (range.y - range.x), 0.0, 1.0), 0.5)).rgb
                              : plain;
      gl_FragColor = vec4(c * (gl_FrontFacing ? min(light, 1.06) : 0.82 * light), opacity); }`;
  const lineVertexShader = `
    attribute vec3 d; uniform float warp; varying vec3 v_x;
    void main() { v_x = position; gl_Position = projectionMatrix * modelViewMatrix * vec4(position + warp * d, 1.0); }`;
  const lineFragmentShader = `
    uniform vec4 plane; uniform vec3 plain; uniform float cut; varying vec3 v_x;
    void main() { if (cut > 0.5 && dot(v_x, plane.xyz) > plane.w) discard; gl_FragColor = vec4(plain, 1.0); }`;
  const grey = [0.74, 0.72, 0.70], lineColours = [[0.05, 0.05, 0.05], [0.70, 0.05, 0.10], [0.0, 0.25, 0.6], [0.45, 0.2, 0.55]];
  const has = (of, kind) => of === 'inside' ? kind === 'inner' : of === 'wall' ? ['outer', 'inner', 'end', 'wall section'].includes(kind)
    : ['inner', 'opening', 'section'].includes(kind);

  /** Is the picture drawn by the processor? Then a quarter of the pixels is drawn while things move, and all of them when they rest. */
  function isSoftware(gl) {
    const names = gl.getExtension('WEBGL_debug_renderer_info');
    return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(gl.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
  }

  /** Samples within a pixel cost a processor three quarters of its time, so it gets a context without: whether there is one is known by asking. */
  function contextOf(canvas) {
    const asked = document.createElement('canvas').getContext('webgl'), antialias = !!asked && !isSoftware(asked);
    asked?.getExtension('WEBGL_lose_context')?.loseContext();
    const context = canvas.getContext('webgl', { antialias, preserveDrawingBuffer: true, alpha: true });
    if (!context) throw new Error('there is no WebGL');
    return context;
  }

  class Scene {
    constructor(canvas, beat) {
      this.canvas = canvas;
      this.beat = beat;
      const context = contextOf(canvas);
      this.slow = isSoftware(context);
      this.renderer = new THREE.WebGLRenderer({ canvas, context });
      this.renderer.setClearColor(0x000000, 0);
      this.scene = new THREE.Scene();
      this.now = { time: 0, name: '' };
      this.camera = new THREE.OrthographicCamera(-1, 1, 1, -1, -1, 1);
      this.map = new THREE.DataTexture(new Uint8Array(4 * 256), 256, 1, THREE.RGBAFormat);
      this.map.minFilter = this.map.magFilter = THREE.LinearFilter;
      this.shared = { warp: { value: 1 }, range: { value: new THREE.Vector2(0, 1) }, map: { value: this.map },
        plane: { value: new THREE.Vector4(0, 0, 1, 0) } };
      this.meshes = beat.bodies.flatMap(body => this.meshesOf(body));
      this.families = [...new Set(beat.lines.map(l => l.name))];
      this.lines = beat.lines.map(l => this.linesOf(l));
      this.marker = new THREE.Mesh(new THREE.SphereBufferGeometry(0.006 * beat.size, 16, 12),
        new THREE.MeshBasicMaterial({ color: 0xd0021b, depthTest: false }));
      this.marker.renderOrder = 10;
      this.marker.visible = false;
      this.scene.add(this.marker);
      this.rotation = new THREE.Quaternion();
      this.look(beat.view, beat.up);
    }

    meshesOf(body) {
      const attribute = (array, k) => new THREE.BufferAttribute(array, k);
      const whole = new THREE.BufferGeometry();
      whole.setAttribute('position', attribute(body.reference, 3));
      whole.setIndex(attribute(body.triangles, 1));
      whole.computeVertexNormals();
      whole.setAttribute('d', attribute(body.displacement, 3));
      whole.setAttribute('s', attribute(body.values, 1));
      body.geometry = whole;
      return body.groups.map(group => {
        const part = new THREE.BufferGeometry();
        for (const name of ['position', 'normal', 'd', 's']) part.setAttribute(name, whole.attributes[name]);
        part.setIndex(whole.index);
        part.setDrawRange(group.first, group.count);
        const uniforms = { ...this.shared, opacity: { value: 1 }, coloured: { value: 0 }, cut: { value: 1 }, plain: { value: new THREE.Vector3(...grey) } };
        const material = new THREE.ShaderMaterial({ uniforms, vertexShader, fragmentShader, side: THREE.DoubleSide });
        const mesh = new THREE.Mesh(part, material);
        mesh.frustumCulled = false;
        mesh.userData = { group, body };
        this.scene.add(mesh);
        return mesh;
      });
    }

    /** Two ends for each line, which move as the point that it lies at. */
    linesOf(lines) {
      const ends = new Float32Array(6 * lines.count), half = 0.5 * lines.length;
      for (let i = 0; i < lines.count; ++i)
        for (let c = 0; c < 3; ++c)
          for (const e of [0, 1]) ends[6 * i + 3 * e + c] = lines.middles[3 * i + c] + (e ? half : -half) * lines.along[3 * i + c];
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute('position', new THREE.BufferAttribute(ends, 3));
      geometry.setAttribute('d', new THREE.BufferAttribute(new Float32Array(6 * lines.count), 3));
      const plain = new THREE.Vector3(...lineColours[this.families.indexOf(lines.name) % lineColours.length]);
      const uniforms = { warp: this.shared.warp, plane: this.shared.plane, plain: { value: plain }, cut: { value: 0 } };
      const material = new THREE.ShaderMaterial({ uniforms, vertexShader: lineVertexShader, fragmentShader: lineFragmentShader });
      const drawn = new THREE.LineSegments(geometry, material);
      drawn.frustumCulled = drawn.visible = false;
      drawn.renderOrder = 3;
      drawn.userData = lines;
      this.scene.add(drawn);
      return drawn;
    }

    moveLines() {
      const d = this.beat.bodies[0].displacement;
      for (const drawn of this.lines) {
        if (!drawn.visible) continue;
        const moved = drawn.geometry.attributes.d, points = drawn.userData.points;
        for (let i = 0; i < points.length; ++i)
          for (let c = 0; c < 3; ++c) moved.array[6 * i + c] = moved.array[6 * i + 3 + c] = d[3 * points[i] + c];
        moved.needsUpdate = true;
      }
    }

    setMap(name) {
      for (let i = 0; i < 256; ++i) this.map.image.data.set([...tunica.colour(name, i / 255), 255], 4 * i);
      this.map.needsUpdate = true;
    }

    /** The instant in frames and the quantity; setLook() brings up what is seen. */
    setTime(time, name) {
      this.now = { time, name };
      for (const body of this.beat.bodies) body.stale = true;
    }

    /** Motion, and values of the quantity that is shown, of the bodies that are seen. */
    bringUp() {
      const { time, name } = this.now;
      for (const body of new Set(this.meshes.filter(m => m.visible && m.userData.body.stale).map(m => m.userData.body))) {
        body.stale = false;
        if (body.motion && body.motion.changes) {
          body.motion.evaluate(time, this.beat.frames, body.displacement);
          body.geometry.attributes.d.needsUpdate = true;
        } else if (body.motion && !body.still) {
          body.motion.evaluate(0, 1, body.displacement);
          body.geometry.attributes.d.needsUpdate = body.still = true;
        }
        for (const q of body.quantities)
          if (q.name === name) {
            tunica.fill(body, q, time, this.beat.frames);
            body.geometry.attributes.s.needsUpdate = true;
          }
      }
    }

    /** `state`: quantity, opacity by kind, hidden regions, section, plane, warp, range, families of lines, colours of regions. */
    setLook(state) {
      this.shared.range.value.set(...state.range);
      this.shared.warp.value = state.warp;
      if (state.plane) this.shared.plane.value.set(...state.plane.normal, state.plane.level);
      for (const mesh of this.meshes) {
        const { group, body } = mesh.userData, u = mesh.material.uniforms;
        const section = group.kind.endsWith('section');
        const q = body.quantities.find(one => one.name === state.quantity && has(one.of, group.kind));
        const opacity = section ? 1 : group.kind === 'end' ? state.opacity.outer : state.opacity[group.kind];
        u.coloured.value = q ? 1 : 0;
        const category = state.regions && ['outer', 'inner'].includes(group.kind) ? state.regions.get(group.name) : null;
        u.plain.value.set(...(category ? category.map(c => c / 255) : grey));
        u.opacity.value = opacity;
        u.cut.value = state.plane && !section ? 1 : 0;
        mesh.visible = section ? state.sections(group) : opacity > 0.01 && !state.hidden.has(group.name);
        mesh.material.transparent = opacity < 1;
        mesh.material.depthWrite = opacity >= 1;
        mesh.renderOrder = opacity < 1 ? 5 : group.kind === 'outer' ? 0 : 1;  // what hides most first
        // Where a coloured and a grey surface coincide the coloured one is seen.
        mesh.material.polygonOffset = !section;
        mesh.material.polygonOffsetFactor = q ? 1 : 2;
        mesh.material.polygonOffsetUnits = 1;
      }
      for (const drawn of this.lines) {
        const { name, kind, region } = drawn.userData;
        drawn.visible = state.families.has(name) && state.opacity[kind] > 0.3 && !state.hidden.has(region);
        drawn.material.uniforms.cut.value = state.plane ? 1 : 0;
      }
      this.bringUp();
      this.moveLines();
    }

    // --- the camera: parallel projection, turned by a quaternion ---

    look(direction, up) {
      const z = new THREE.Vector3(...direction).normalize(), x = new THREE.Vector3(...up).cross(z).normalize();
      this.rotation.setFromRotationMatrix(new THREE.Matrix4().makeBasis(x, z.clone().cross(x), z));
      this.zoom = 1;
      this.shift = [0, 0];
      this.fit();
    }

    fit() {
      const right = this.axis(0), up = this.axis(1), centre = this.beat.centre;
      this.half = [1e-3, 1e-3];
      for (const body of this.beat.bodies)
        for (let i = 0; i < body.reference.length; i += 21) {
          const x = new THREE.Vector3(body.reference[i] - centre[0], body.reference[i + 1] - centre[1], body.reference[i + 2] - centre[2]);
          this.half = [Math.max(this.half[0], Math.abs(x.dot(right))), Math.max(this.half[1], Math.abs(x.dot(up)))];
        }
    }

    axis(k) { return new THREE.Vector3(+(k === 0), +(k === 1), +(k === 2)).applyQuaternion(this.rotation); }

    turn(x, y, z = 0) {
      const q = new THREE.Quaternion().setFromEuler(new THREE.Euler(-y, -x, z));
      this.rotation.multiply(q).normalize();
    }

    /** By so many pixels. */
    pan(x, y) { this.shift[0] -= x * this.perPixel; this.shift[1] += y * this.perPixel; }

    place(fine) {
      const width = this.canvas.clientWidth, height = Math.max(1, this.canvas.clientHeight);
      const whole = Math.min(window.devicePixelRatio || 1, 2), ratio = this.slow ? (fine ? 2 : 1) : whole;
      if (this.width !== width || this.height !== height || this.ratio !== ratio) {
        [this.width, this.height, this.ratio] = [width, height, ratio];
        this.renderer.setPixelRatio(ratio);
        this.renderer.setSize(width, height, false);
      }
      const half = 1.08 * Math.max(this.half[1], this.half[0] * height / width) / this.zoom, depth = 4 * this.beat.size;
      this.perPixel = 2 * half / height;
      Object.assign(this.camera, { left: -half * width / height, right: half * width / height, top: half, bottom: -half, near: -depth, far: depth });
      this.camera.position.set(...this.beat.centre).addScaledVector(this.axis(0), this.shift[0]).addScaledVector(this.axis(1), this.shift[1]);
      this.camera.quaternion.copy(this.rotation);
      this.camera.updateProjectionMatrix();
      this.camera.updateMatrixWorld();
    }

    /** `fine`: with all pixels, for pictures that rest. */
    draw(fine = false) {
      this.place(fine);
      this.renderer.render(this.scene, this.camera);
    }

    /** Pixels of a place [mm]. */
    project(x) {
      const v = new THREE.Vector3(...x).project(this.camera);
      return [0.5 * (v.x + 1) * this.width, 0.5 * (1 - v.y) * this.height];
    }

    mark(x) {
      this.marker.visible = !!x;
      if (x) this.marker.position.set(...x);
    }

    /** The nearest visible place under a pixel: {body, group, corners, barycentric, reference, place}, or null. */
    pick(px, py) {
      const origin = new THREE.Vector3(2 * px / this.width - 1, 1 - 2 * py / this.height, 0).unproject(this.camera);
      const right = this.axis(0), up = this.axis(1), towards = this.axis(2), plane = this.shared.plane.value;
      let best = null;
      for (const mesh of this.meshes) {
        if (!mesh.visible || mesh.material.uniforms.opacity.value < 0.3) continue;
        const { group, body } = mesh.userData, d = body.displacement, x = body.reference, w = this.shared.warp.value;
        const flat = new Float32Array(3 * body.points);
        for (let i = 0; i < body.points; ++i) {
          const px_ = x[3 * i] + w * d[3 * i] - origin.x, py_ = x[3 * i + 1] + w * d[3 * i + 1] - origin.y, pz_ = x[3 * i + 2] + w * d[3 * i + 2] - origin.z;
          flat[3 * i] = px_ * right.x + py_ * right.y + pz_ * right.z;
          flat[3 * i + 1] = px_ * up.x + py_ * up.y + pz_ * up.z;
          flat[3 * i + 2] = px_ * towards.x + py_ * towards.y + pz_ * towards.z;
        }
        for (let t = group.first; t < group.first + group.count; t += 3) {
          const [a, b, c] = body.triangles.subarray(t, t + 3);
          const ax = flat[3 * a], ay = flat[3 * a + 1], bx = flat[3 * b], by = flat[3 * b + 1], cx = flat[3 * c], cy = flat[3 * c + 1];
          const area = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay);
          if (area === 0) continue;
          const l0 = (bx * cy - cx * by) / area, l1 = (cx * ay - ax * cy) / area, l2 = 1 - l0 - l1;
          if (l0 < 0 || l1 < 0 || l2 < 0) continue;
          const depth = l0 * flat[3 * a + 2] + l1 * flat[3 * b + 2] + l2 * flat[3 * c + 2];
          if (best && depth <= best.depth) continue;
          const at = array => [0, 1, 2].map(k => l0 * array[3 * a + k] + l1 * array[3 * b + k] + l2 * array[3 * c + k]);
          const reference = at(x);
          if (mesh.material.uniforms.cut.value > 0.5 && reference[0] * plane.x + reference[1] * plane.y + reference[2] * plane.z > plane.w) continue;
          const moved = at(d);
          best = { depth, body, group, corners: [a, b, c], barycentric: [l0, l1, l2], reference, place: reference.map((v, k) => v + w * moved[k]) };
        }
      }
      return best;
    }
  }

  /** Values of a quantity (lengths of vectors) into body.values. */
  tunica.fill = (body, q, time, frames) => {
    if (q.components === 1) return q.evaluate(time, frames, body.values.subarray(q.first, q.first + q.count));
    const all = new Float32Array(3 * q.count);
    q.evaluate(time, frames, all);
    for (let i = 0; i < q.count; ++i) body.values[q.first + i] = Math.hypot(all[3 * i], all[3 * i + 1], all[3 * i + 2]);
  };
  tunica.isOf = has;
  tunica.Scene = Scene;
})();
