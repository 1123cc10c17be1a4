// Camera on a sphere around the middle of the structure: turned by dragging, moved with Shift, brought nearer with + and - or
// the wheel.
const FIELD = 28 * Math.PI / 180;

class Orbit {
  /// `points` fill the picture at first; `all` can be looked at.
  constructor(points, all = points) {
    this.points = points;
    // size of the box that holds nearly all points: a long thin approach ramp should not make the mode sway more
    const low = [], high = [];
    for (let k = 0; k < 3; ++k) {
      const along = points.filter((_, i) => i % 3 === k).sort(), n = along.length, cut = n > 200 ? Math.floor(0.012 * n) : 0;
      low[k] = along[cut];
      high[k] = along[n - 1 - cut];
    }
    this.middle = low.map((l, k) => 0.5 * (l + high[k]));
    this.size = Math.max(1e-9, Math.hypot(...low.map((l, k) => high[k] - l)));
    this.reach = this.size;  // of the point that is furthest from the middle, for the planes between which the camera sees
    for (let i = 0; i < all.length; i += 3)
      this.reach = Math.max(this.reach, Math.hypot(all[i] - this.middle[0], all[i + 1] - this.middle[1], all[i + 2] - this.middle[2]));
    // the longest direction in plan runs across the screen
    let xx = 0, xy = 0, yy = 0;
    for (let i = 0; i < points.length; i += 3) {
      const x = points[i] - this.middle[0], y = points[i + 1] - this.middle[1];
      xx += x * x; xy += x * y; yy += y * y;
    }
    this.along = 0.5 * Math.atan2(2 * xy, xx - yy);
    this.aspect = 16 / 9;
    this.moved = false;  // by hand: then a picture of another shape keeps what the reader chose
    this.home('space');
  }

  home(view) {
    this.moved = false;
    this.target = [...this.middle];
    this.azimuth = this.along - Math.PI / 2 + { space: -0.55, plan: 0, side: 0, end: Math.PI / 2 }[view];
    this.elevation = { space: 0.42, plan: Math.PI / 2 - 1e-4, side: 0, end: 0 }[view];
    this.fit();
  }

  /// Target in the middle of what is seen, and the distance at which every one of the points is inside the picture.
  fit() {
    this.distance = 1;
    const [right, up, back] = this.axes(), tan = Math.tan(FIELD / 2);
    const { points, middle } = this;
    const along = (axis, i) => (points[i] - middle[0]) * axis[0] + (points[i + 1] - middle[1]) * axis[1] + (points[i + 2] - middle[2]) * axis[2];
    const centre = axis => {
      let low = Infinity, high = -Infinity;
      for (let i = 0; i < points.length; i += 3) {
        const at = along(axis, i);
        low = Math.min(low, at);
        high = Math.max(high, at);
      }
      return points.length ? 0.5 * (low + high) : 0;
    };
    const across = centre(right), above = centre(up);
    this.target = middle.map((m, k) => m + across * right[k] + above * up[k]);
    let distance = 0;
    for (let i = 0; i < points.length; i += 3) {
      const needed = Math.max(Math.abs(along(up, i) - above), Math.abs(along(right, i) - across) / this.aspect) / tan;
      distance = Math.max(distance, along(back, i) + 1.12 * needed);  // room for the sway
    }
    this.distance = Math.max(distance, 0.05 * this.size);
  }

  axes() {
    const ca = Math.cos(this.azimuth), sa = Math.sin(this.azimuth);
    const ce = Math.cos(this.elevation), se = Math.sin(this.elevation);
    return [[-sa, ca, 0], [-ca * se, -sa * se, ce], [ca * ce, sa * ce, se]];  // right, up, from the target to the eye
  }

  eye() {
    const back = this.axes()[2];
    return this.target.map((t, k) => t + this.distance * back[k]);
  }

  /// Screen positions and depths of the points: out[3 i] = x, y [px], distance from the eye.
  project(points, width, height, out) {
    const [right, up, back] = this.axes(), scale = 0.5 * height / Math.tan(FIELD / 2);
    for (let i = 0; i < points.length; i += 3) {
      const x = points[i] - this.target[0], y = points[i + 1] - this.target[1], z = points[i + 2] - this.target[2];
      const depth = Math.max(1e-6, this.distance - (x * back[0] + y * back[1] + z * back[2]));
      out[i] = 0.5 * width + scale * (x * right[0] + y * right[1] + z * right[2]) / depth;
      out[i + 1] = 0.5 * height - scale * (x * up[0] + y * up[1] + z * up[2]) / depth;
      out[i + 2] = depth;
    }
    return out;
  }

  listen(canvas, changed) {
    const held = new Map();
    let gap = 0;
    canvas.addEventListener('pointerdown', e => {
      held.set(e.pointerId, [e.clientX, e.clientY]);
      canvas.setPointerCapture(e.pointerId);
      gap = 0;
    });
    const release = e => held.delete(e.pointerId);
    canvas.addEventListener('pointerup', release);
    canvas.addEventListener('pointercancel', release);
    canvas.addEventListener('pointermove', e => {
      const last = held.get(e.pointerId);
      if (!last) return;
      const dx = e.clientX - last[0], dy = e.clientY - last[1];
      this.moved = true;
      held.set(e.pointerId, [e.clientX, e.clientY]);
      if (held.size === 2) {  // two fingers: nearer or further
        const [a, b] = [...held.values()], now = Math.hypot(a[0] - b[0], a[1] - b[1]);
        if (gap > 0) this.zoom(gap / now);
        gap = now;
      } else if (e.shiftKey || e.buttons === 2) {
        const [right, up] = this.axes(), metres = 2 * this.distance * Math.tan(FIELD / 2) / canvas.clientHeight;
        this.target = this.target.map((t, k) => t + metres * (dy * up[k] - dx * right[k]));
      } else {
        this.azimuth -= 0.008 * dx;
        this.elevation = Math.max(-1.5, Math.min(Math.PI / 2 - 1e-4, this.elevation + 0.008 * dy));
      }
      changed();
    });
    canvas.addEventListener('contextmenu', e => e.preventDefault());
    canvas.addEventListener('wheel', e => {  // only once the picture has been clicked: scrolling the page stays scrolling
      if (document.activeElement !== canvas && !e.ctrlKey) return;
      e.preventDefault();
      this.zoom(Math.exp(0.0012 * e.deltaY));
      changed();
    }, { passive: false });
    canvas.addEventListener('keydown', e => {
      const turn = { ArrowLeft: [0.1, 0], ArrowRight: [-0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1] }[e.key];
      if (turn) {
        this.moved = true;
        this.azimuth += turn[0];
        this.elevation = Math.max(-1.5, Math.min(Math.PI / 2 - 1e-4, this.elevation + turn[1]));
      } else if (e.key === '+' || e.key === '-') {
        this.zoom(e.key === '+' ? 0.85 : 1 / 0.85);
      } else {
        return;
      }
      e.preventDefault();
      changed();
    });
  }

  zoom(factor) {
    this.moved = true;
    this.distance = Math.max(0.02 * this.size, Math.min(20 * this.size, this.distance * factor));
  }
}
