// What both pictures in three dimensions share: size, camera, print, names under the pointer.
const BACKGROUND = [0.973, 0.98, 0.988], GHOST = [0.8, 0.835, 0.87], LINE = [0.2, 0.27, 0.35];
const PALE = [0.8, 0.85, 0.9], BLUE = [0.1, 0.45, 0.75], NAVY = [0.03, 0.18, 0.38];
const AMBER = [0.95, 0.66, 0.24], RED = [0.72, 0.15, 0.1], ORANGE = [0.84, 0.33, 0.07], GREEN = [0.18, 0.49, 0.31], VIOLET = [0.36, 0.23, 0.55];

const blend = (stops, t, out, at) => {
  const x = Math.max(0, Math.min(1, t)) * (stops.length - 1), i = Math.min(stops.length - 2, Math.floor(x)), f = x - i;
  for (let k = 0; k < 3; ++k) out[at + k] = (1 - f) * stops[i][k] + f * stops[i + 1][k];
};

const unpack = (text, type) => {
  const raw = atob(text), bytes = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; ++i) bytes[i] = raw.charCodeAt(i);
  return new type(bytes.buffer);
};

/// Points of a structure without those of its approaches, which would make it small in the picture.
const framed = (points, mesh) => {
  const away = new Set(mesh.approach ? unpack(mesh.approach, Uint32Array) : []);
  return points.filter((_, i) => !away.has(Math.floor(i / 3)));
};

class Viewer {
  /// `root` holds the canvas; `draw(viewer)` sets positions and colours. WebGL draws lines one pixel thin: a frame of few members and no
  /// plates (`membersOnly`) is easier to see on a plain canvas.
  constructor(root, draw, membersOnly) {
    this.root = root;
    this.canvas = root.querySelector('canvas');
    this.label = root.querySelector('.label');
    this.renderer = !membersOnly && webgl() ? new SolidCanvas(this.canvas) : new FlatCanvas(this.canvas);
    root.dataset.renderer = this.renderer.name;
    this.draw = draw;
    this.frames = 0;
    this.visible = true;
    new ResizeObserver(() => this.resize()).observe(this.canvas.parentElement);
    new IntersectionObserver(entries => { this.visible = entries[entries.length - 1].isIntersecting; }).observe(this.canvas);
    this.canvas.addEventListener('pointermove', e => this.point(e));
    this.canvas.addEventListener('pointerleave', () => { this.label.hidden = true; });
    window.addEventListener('beforeprint', () => this.still());
    for (const button of root.querySelectorAll('[data-view]'))
      button.addEventListener('click', () => { this.orbit.home(button.dataset.view); this.paint(); });
    for (const button of root.querySelectorAll('[data-zoom]'))
      button.addEventListener('click', () => { this.orbit.zoom(Number(button.dataset.zoom)); this.paint(); });
  }

  /// scene: base (3 n), framed (what the picture is fitted to at first; base by default), faces, lines (positions), spots (3 p), names (p), dot [px], ghost, spotsOnTop.
  show(scene, keepCamera) {
    this.scene = scene;
    if (!this.orbit || !keepCamera) {
      const all = scene.base.length ? scene.base : scene.spots, orbit = new Orbit(scene.framed || all, all);
      if (this.orbit) Object.assign(this.orbit, orbit);
      else (this.orbit = orbit).listen(this.canvas, () => this.paint());
    }
    this.moved = new Float32Array(scene.base);
    this.colours = new Float32Array(scene.base.length);
    this.spots = new Float32Array(scene.spots);
    this.spotColours = new Float32Array(scene.spots.length);
    this.seen = new Float32Array(scene.spots.length);
    this.renderer.show(scene);
    this.resize();
  }

  resize() {
    const box = this.canvas.parentElement, width = Math.max(200, box.clientWidth), height = Math.max(150, box.clientHeight);
    if (!this.scene) return;
    this.renderer.size(width, height, Math.min(2, window.devicePixelRatio || 1));
    this.orbit.aspect = width / height;
    if (!this.orbit.moved) this.orbit.fit();
    this.paint();
  }

  paint() {
    this.draw(this);
    this.renderer.draw(this.orbit, this.moved, this.colours, this.spots, this.spotColours);
    this.frames += 1;
  }

  point(e) {
    const box = this.canvas.getBoundingClientRect(), x = e.clientX - box.left, y = e.clientY - box.top;
    this.orbit.project(this.spots, box.width, box.height, this.seen);
    let best = 14, found = -1;
    for (let s = 0; s < this.seen.length; s += 3) {
      const d = Math.hypot(this.seen[s] - x, this.seen[s + 1] - y);
      if (d < best) { best = d; found = s / 3; }
    }
    this.label.hidden = found < 0;
    if (found >= 0) {
      this.label.textContent = this.scene.names[found];
      this.label.style.left = `${x + 14}px`;
      this.label.style.top = `${y - 8}px`;
    }
  }

  /// A picture of now, because not every printer driver prints a canvas.
  still() {
    this.paint();
    const picture = this.root.querySelector('img.now');
    picture.src = this.canvas.toDataURL('image/png');
    this.root.classList.add('has-still');
  }
}
