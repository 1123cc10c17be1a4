// Mode shapes of the models and of the measurement, moving.
const SWAY = 0.07;  // largest displacement as a share of the structure's size, at the middle of the slider
const LEAST_CHANGE = 0.01;  // of the largest displacement: what the reddest colour stands for at least, so that rounding is not coloured

const MARKS = { support: [GREEN, GREEN], cause: [RED, RED] };

const fewMembers = mesh => mesh.faces.length === 0 && mesh.lines.length < 4000;

class ModeShapes {
  constructor(root, data) {
    this.root = root;
    this.data = data;
    this.meshes = data.meshes.map(m => ({
      points: unpack(m.points, Float32Array), framed: framed(unpack(m.points, Float32Array), m), lines: unpack(m.lines, Uint32Array), faces: unpack(m.faces, Uint32Array),
      marks: m.marks || [], held: Float32Array.from((m.marks || []).flatMap(k => k.at)) }));
    this.shapes = new Map();
    this.phase = Math.PI / 2;
    this.playing = !window.matchMedia('(prefers-reduced-motion: reduce)').matches;
    const find = name => root.querySelector(`[name=${name}]`);
    [this.sets, this.list, this.size] = ['set', 'mode', 'sway'].map(find);
    [this.play, this.over, this.rest, this.change] = ['play', 'over', 'rest', 'change'].map(find);
    this.text = root.querySelector('.caption');
    data.sets.forEach((s, i) => this.sets.add(new Option(s.title, i)));
    const model = data.sets.findIndex(s => s.kind === 'model');
    this.sets.value = Math.max(0, model);
    this.sets.addEventListener('change', () => this.choose(this.partner()));
    this.list.addEventListener('change', () => this.take());
    for (const box of [this.over, this.rest, this.change]) box.addEventListener('change', () => this.take());
    this.size.addEventListener('input', () => this.viewer.paint());
    this.play.addEventListener('click', () => this.run(!this.playing));
    window.addEventListener('beforeprint', () => { this.phase = Math.PI / 2; });  // print shows the largest displacement
    this.viewer = new Viewer(root, v => this.move(v), this.meshes.every(fewMembers));
    this.choose(0);
    this.run(this.playing);
    let last = performance.now();
    const step = now => {
      if (this.playing && this.viewer.visible) {
        this.phase += 0.0042 * Math.min(100, now - last);
        this.viewer.paint();
      }
      last = now;
      requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }

  run(on) {
    this.playing = on;
    this.play.textContent = on ? 'Pause' : 'Play';
    this.play.setAttribute('aria-pressed', on);
  }

  /// The mode of the newly chosen set that belongs to the one shown before, where the pairing is known.
  partner() {
    const next = this.data.sets[this.sets.value], shown = this.mode, model = this.data.sets.find(s => s.kind === 'model');
    if (!this.set || !shown || next === this.set) return 0;
    if (shown.partner !== undefined && next === model) return shown.partner;
    const same = this.set.kind === 'model' ? this.set.modes.indexOf(shown) : shown.partner;
    if (next.kind === 'points' && same !== undefined) return Math.max(0, next.modes.findIndex(m => m.partner === same));
    return Math.min(this.set.modes.indexOf(shown), next.modes.length - 1);
  }

  choose(index) {
    this.set = this.data.sets[this.sets.value];
    this.list.replaceChildren(...this.set.modes.map((m, i) => new Option(`${m.label}: ${m.frequency.toFixed(3)} Hz`, i)));
    this.list.value = index;
    this.root.querySelector('.for-points').hidden = this.set.kind !== 'points' || this.set.mesh === null;
    this.root.querySelector('.for-models').hidden = !this.earlier();
    this.take();
  }

  take() {
    const set = this.set, mode = this.mode = set.modes[this.list.value], first = this.data.sets.find(s => s.kind === 'model');
    const mesh = set.mesh === null ? null : this.meshes[set.kind === 'model' ? set.mesh : first.mesh];
    const none = new Uint32Array(0), nowhere = new Float32Array(0);
    const scene = { base: nowhere, faces: none, lines: none, spots: nowhere, names: [], dot: 9, ghost: this.rest.checked, spotsOnTop: true };
    this.along = null;
    this.apart = this.change.checked ? this.difference() : null;
    if (set.kind === 'model') {
      Object.assign(scene, { base: mesh.points, framed: mesh.framed, faces: mesh.faces, lines: mesh.lines, spots: mesh.held, names: mesh.marks.map(k => k.words), dot: 7 });
      this.real = this.imaginary = null;
      this.along = { shape: this.shape(mode, 'shape', Int16Array), scale: 1 / 32767 };
    } else {
      Object.assign(scene, { spots: unpack(set.points, Float32Array), names: set.names });
      this.real = this.shape(mode, 'real', Float32Array);
      this.imaginary = this.shape(mode, 'imag', Float32Array);
      if (mesh && this.over.checked && mode.partner !== undefined) {
        Object.assign(scene, { base: mesh.points, framed: mesh.framed, faces: mesh.faces, lines: mesh.lines });
        const partner = first.modes[mode.partner];
        this.along = { shape: this.shape(partner, 'shape', Int16Array), scale: mode.factor / 32767 };
      } else if (mesh) {
        Object.assign(scene, { base: mesh.points, framed: mesh.framed, lines: mesh.lines, ghost: false });
      } else {  // no model: the sensors are joined as the campaign says
        Object.assign(scene, { base: scene.spots, lines: unpack(set.lines, Uint32Array) });
      }
    }
    this.joined = set.kind === 'points' && !mesh;
    const keep = this.shown !== undefined && this.shown === (mesh || set);
    this.shown = mesh || set;
    this.viewer.show(scene, keep);
    this.describe();
  }

  /// The model that the chosen one came from, on the same nodes: the next such one of the list.
  earlier() {
    if (this.set.kind !== 'model') return null;
    const here = this.meshes[this.set.mesh].points;
    const same = there => here.length === there.length && here.every((x, i) => x === there[i]);
    return this.data.sets.slice(this.data.sets.indexOf(this.set) + 1).find(s => s.kind === 'model' && same(this.meshes[s.mesh].points)) || null;
  }

  /// The mode of the earlier model that is closest in shape, with the length of the difference at each node as a share of the largest displacement.
  difference() {
    const other = this.earlier();
    if (!other) return null;
    const own = this.shape(this.mode, 'shape', Int16Array), dot = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0);
    const macs = other.modes.map(m => { const its = this.shape(m, 'shape', Int16Array); return dot(own, its) ** 2 / (dot(own, own) * dot(its, its)); });
    const mode = other.modes[macs.indexOf(Math.max(...macs))], its = this.shape(mode, 'shape', Int16Array), factor = dot(own, its) / dot(its, its);
    const length = new Float32Array(own.length / 3);
    for (let n = 0; n < length.length; ++n) length[n] = Math.hypot(...[0, 1, 2].map(k => own[3 * n + k] - factor * its[3 * n + k])) / 32767;
    return { length, most: length.reduce((a, b) => Math.max(a, b), LEAST_CHANGE), mode, mac: Math.max(...macs), title: other.title };
  }

  shape(mode, part, type) {
    if (!this.shapes.has(mode)) this.shapes.set(mode, {});
    const kept = this.shapes.get(mode);
    return kept[part] ??= unpack(mode[part], type);
  }

  describe() {
    const { set, mode } = this, first = this.data.sets.find(s => s.kind === 'model');
    let text = `${set.title}, mode ${mode.label}: ${mode.frequency.toFixed(4)} Hz`;
    if (mode.damping !== null) text += `, damping ratio ${mode.damping.toFixed(2)} %`;
    if (mode.partner !== undefined) {
      const partner = first.modes[mode.partner];
      text += `. Closest in shape: mode ${partner.label} of the ${first.title.toLowerCase()}, `
        + `${partner.frequency.toFixed(4)} Hz, MAC ${mode.mac.toFixed(2)}`;
    }
    if (this.apart)
      text += `. Colour: difference to mode ${this.apart.mode.label} of the ${this.apart.title.toLowerCase()}, ${this.apart.mode.frequency.toFixed(4)} Hz, `
        + `MAC ${this.apart.mac.toFixed(3)}; red is ${(100 * this.apart.most).toPrecision(2)} % of the largest displacement`;
    this.text.textContent = `${text}.`;
  }

  move(v) {
    const sway = SWAY * v.orbit.size * this.size.value, c = Math.sin(this.phase), s = -Math.cos(this.phase);
    const { base } = v.scene;
    if (this.along) {
      const { shape, scale } = this.along, part = sway * c * scale;
      for (let i = 0; i < base.length; i += 3) {
        for (let k = 0; k < 3; ++k) v.moved[i + k] = base[i + k] + part * shape[i + k];
        if (this.apart) blend([PALE, AMBER, RED], this.apart.length[i / 3] / this.apart.most, v.colours, i);
        else blend([PALE, BLUE, NAVY], Math.abs(scale) * Math.hypot(shape[i], shape[i + 1], shape[i + 2]), v.colours, i);
      }
    } else {
      v.moved.set(base);
      for (let i = 0; i < base.length; i += 3) blend([GHOST, GHOST], 0, v.colours, i);
    }
    if (!this.real) {  // supports and springs: where they are held, nothing moves
      v.spots.set(v.scene.spots);
      this.shown.marks.forEach((k, i) => blend(MARKS[k.kind] || [VIOLET, VIOLET], 0, v.spotColours, 3 * i));
      return;
    }
    for (let i = 0; i < v.spots.length; ++i) v.spots[i] = v.scene.spots[i] + sway * (this.real[i] * c - this.imaginary[i] * s);
    for (let i = 0; i < v.spots.length; i += 3) blend([ORANGE, ORANGE], 0, v.spotColours, i);
    if (this.joined) {
      v.moved.set(v.spots);
      const { real } = this;
      for (let i = 0; i < base.length; i += 3) blend([PALE, BLUE, NAVY], Math.hypot(real[i], real[i + 1], real[i + 2]), v.colours, i);
    }
  }
}
