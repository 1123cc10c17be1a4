// Stabilisation diagrams: poles over frequency and order (or damping ratio), numbers under the pointer. SVG, so that it prints
// as drawn.
const SVG = 'http://www.w3.org/2000/svg';
const svg = (name, attributes, text) => {
  const node = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
  if (text !== undefined) node.textContent = text;
  return node;
};

const HIGHEST_DAMPING = 8;  // [%] of the diagram over damping ratios

const ticks = (low, high, count) => {
  const raw = (high - low) / count, power = 10 ** Math.floor(Math.log10(raw));
  const step = power * [1, 2, 5, 10].find(m => m * power >= raw);
  const found = [];
  for (let t = Math.ceil(low / step) * step; t <= high + 1e-9 * step; t += step) found.push(Number(t.toPrecision(10)));
  return found;
};

class Stabilisation {
  constructor(root, data) {
    this.root = root;
    this.data = data;
    this.picture = root.querySelector('svg');
    this.label = root.querySelector('.label');
    [this.record, this.axis, this.stable] = ['record', 'axis', 'stable'].map(name => root.querySelector(`[name=${name}]`));
    this.zooms = new Map();  // panel -> [lowest, highest] frequency [Hz] that is looked at
    this.choices = new Choices(root, () => this.draw());
    data.panels.forEach((p, i) => this.record.add(new Option(`${p.setup}, ${p.condition}`, i)));
    for (const control of [this.record, this.axis, this.stable]) control.addEventListener('change', () => this.draw());
    this.picture.addEventListener('pointermove', e => this.held ? this.stretch(e) : this.point(e));
    this.picture.addEventListener('pointerleave', () => this.leave());
    this.picture.addEventListener('pointerdown', e => { this.held = this.frequency(e); this.from = e.clientX; });
    this.picture.addEventListener('pointerup', e => this.release(e));
    this.picture.addEventListener('pointercancel', () => { this.held = null; this.band.setAttribute('visibility', 'hidden'); });
    this.picture.addEventListener('dblclick', () => this.zoom(0));
    for (const button of root.querySelectorAll('[data-band]')) button.addEventListener('click', () => this.zoom(Number(button.dataset.band)));
    new ResizeObserver(() => { if (this.picture.clientWidth !== this.drawn) this.draw(); }).observe(this.picture);
    this.draw();
  }

  get panel() { return this.data.panels[this.record.value]; }

  frequency(e) {
    const at = new DOMPoint(e.clientX, e.clientY).matrixTransform(this.picture.getScreenCTM().inverse());
    return this.at(at.x);
  }

  /// Times `factor` as wide about its middle; 0: the whole band.
  zoom(factor) {
    const [low, high] = this.zooms.get(this.panel) || this.panel.band, middle = 0.5 * (low + high), half = 0.5 * factor * (high - low);
    this.look(factor ? [middle - half, middle + half] : this.panel.band);
  }

  look([low, high]) {
    const [least, most] = this.panel.band, inside = [Math.max(least, low), Math.min(most, high)];
    if (inside[1] - inside[0] < 1e-4 * most) return;
    this.zooms.set(this.panel, inside);
    this.draw();
  }

  stretch(e) {
    this.leave();
    const [a, b] = [this.held, this.frequency(e)].sort((x, y) => x - y).map(f => this.x(f));
    for (const [key, value] of Object.entries({ x: a, width: b - a, visibility: 'visible' })) this.band.setAttribute(key, value);
  }

  release(e) {
    const held = this.held, to = this.frequency(e);
    this.held = null;
    if (held === null || held === undefined) return;
    if (Math.abs(e.clientX - this.from) > 8) return this.look([held, to].sort((x, y) => x - y));
    this.band.setAttribute('visibility', 'hidden');
    const found = this.nearest(e);
    if (found) this.choices.toggle(this.panel, found.p);
  }

  draw() {
    const W = Math.max(280, this.picture.clientWidth || 960), H = 430, L = 46, R = 10, T = 26, B = 42;  // a pixel of the page each, so that letters keep their size
    const panel = this.panel, [low, high] = this.zooms.get(panel) || panel.band, damping = this.axis.value === 'damping';
    const all = panel.poles.filter(([, f, zeta, met]) => f >= low && f <= high && (met === 7 || !this.stable.checked)
      && (!damping || (zeta >= 0 && zeta <= HIGHEST_DAMPING)));
    const top = damping ? Math.min(HIGHEST_DAMPING, 1.08 * Math.max(1, ...all.map(p => p[2])))
      : 2 + Math.max(1, ...panel.poles.map(p => p[0]));
    const x = f => L + (W - L - R) * (f - low) / (high - low), y = v => H - B - (H - B - T) * v / top;
    this.x = x;
    this.at = pixels => low + (high - low) * (pixels - L) / (W - L - R);
    const g = svg('g', {});
    const line = (x1, y1, x2, y2, kind) => g.append(svg('line', { x1, y1, x2, y2, class: kind }));
    const write = (text, at, anchor = 'middle', kind = 'tick') => g.append(svg('text', { ...at, class: kind, 'text-anchor': anchor }, text));
    for (const t of ticks(low, high, Math.max(3, Math.min(9, Math.floor(W / 90))))) {
      line(x(t), T, x(t), H - B, 'grid');
      write(String(t), { x: x(t), y: H - B + 16 });
    }
    for (const t of ticks(0, top, 6)) {
      line(L, y(t), W - R, y(t), 'grid');
      write(String(t), { x: L - 8, y: y(t) + 4 }, 'end');
    }
    if (panel.spectrum.length) {
      const logs = panel.spectrum.map(s => Math.log10(s[1])), floor = Math.min(...logs), span = Math.max(...logs) - floor || 1;
      const at = (s, i) => s[0] < low || s[0] > high ? [] : [`${x(s[0]).toFixed(1)} ${(H - B - (H - B - T) * 0.96 * (logs[i] - floor) / span).toFixed(1)}`];
      g.append(svg('path', { d: 'M' + (panel.spectrum.flatMap(at).join('L') || '0 0'), class: 'spectrum' }));
    }
    let last = -99;
    for (const [mode, f] of this.data.modes[panel.condition] || []) {
      if (f < low || f > high) continue;
      line(x(f), T - 4, x(f), H - B, this.choices.deleted(panel, mode) ? 'mode gone' : 'mode');
      const close = x(f) - last < 16;
      write(String(mode), { x: x(f), y: close ? T - 17 : T - 7 }, 'middle', 'tick strong');
      last = close ? -99 : x(f);
    }
    this.seen = all.map(p => ({ p, x: x(p[1]), y: y(damping ? p[2] : p[0]) }));
    const rank = p => p[3] === 7 ? 2 : p[3] & 1 ? 1 : 0;
    for (const s of [...this.seen].sort((a, b) => rank(a.p) - rank(b.p)))
      g.append(svg('circle', {
        cx: s.x.toFixed(1), cy: s.y.toFixed(1), r: [1.7, 2.6, 3][rank(s.p)], class: ['new', 'part', 'whole'][rank(s.p)] }));
    for (const s of this.seen) {
      const choice = this.choices.of(panel, s.p);
      if (choice) g.append(svg('circle', { cx: s.x.toFixed(1), cy: s.y.toFixed(1), r: 6, class: `choice ${choice.action}` }));
    }
    this.band = svg('rect', { y: T, height: H - B - T, class: 'band', visibility: 'hidden' });
    g.append(this.band);
    g.append(svg('path', { d: `M${L} ${T}V${H - B}H${W - R}`, class: 'axes' }));
    write('frequency (Hz)', { x: (L + W - R) / 2, y: H - 6 });
    write(damping ? 'damping ratio (%)' : 'model order', { transform: `translate(13 ${(T + H - B) / 2}) rotate(-90)` });
    this.ring = svg('circle', { r: 7, class: 'ring', visibility: 'hidden' });
    g.append(this.ring);
    this.drawn = this.picture.clientWidth;
    this.picture.setAttribute('viewBox', `0 0 ${W} ${H}`);
    this.picture.replaceChildren(g);
  }

  nearest(e) {
    const to = this.picture.getScreenCTM().inverse(), at = new DOMPoint(e.clientX, e.clientY).matrixTransform(to);
    let best = 14, found = null;
    for (const s of this.seen) {
      const d = Math.hypot(s.x - at.x, s.y - at.y) - (s.p[3] === 7 ? 1 : 0);
      if (d < best) { best = d; found = s; }
    }
    return found;
  }

  point(e) {
    const found = this.nearest(e);
    if (!found) return this.leave();
    const [order, f, zeta, met, mode] = found.p, box = this.picture.parentElement.getBoundingClientRect();
    const criteria = ['frequency', 'damping', 'shape'].filter((_, i) => met >> i & 1);
    this.label.innerHTML = `<b>${f.toFixed(4)} Hz</b>, ${zeta.toFixed(2)} %<br>order ${order}${mode ? `, mode ${mode}` : ''}<br>`
      + (criteria.length ? `stable: ${criteria.join(', ')}` : 'not stable') + `<br><i>${this.choices.offer(this.panel, found.p)}</i>`;
    this.label.hidden = false;
    const left = e.clientX - box.left;
    this.label.style.left = `${left > box.width - 190 ? left - 175 : left + 14}px`;
    this.label.style.top = `${e.clientY - box.top + 12}px`;
    this.ring.setAttribute('cx', found.x);
    this.ring.setAttribute('cy', found.y);
    this.ring.setAttribute('visibility', 'visible');
  }

  leave() {
    this.label.hidden = true;
    this.ring.setAttribute('visibility', 'hidden');
  }
}
