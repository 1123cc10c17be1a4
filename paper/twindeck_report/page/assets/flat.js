// Drawing without WebGL: triangles from back to front on a plain canvas.
const css = (c, shade = 1) => `rgb(${c.map(v => Math.round(255 * shade * v)).join(',')})`;

class FlatCanvas {
  constructor(canvas) {
    this.canvas = canvas;
    this.pen = canvas.getContext('2d');
    this.name = 'canvas';
  }

  show(scene) {
    this.scene = scene;
    this.at = new Float32Array(scene.base.length);
    this.rest = new Float32Array(scene.base.length);
    this.dots = new Float32Array(scene.spots.length);
    this.feet = new Float32Array(scene.spots.length);
    this.order = Array.from({ length: scene.faces.length / 3 }, (_, i) => i);
    this.depth = new Float32Array(this.order.length);
  }

  size(width, height, ratio) {
    this.canvas.width = width * ratio;
    this.canvas.height = height * ratio;
    this.width = width;
    this.height = height;
    this.ratio = ratio;
  }

  draw(orbit, moved, colours, spots, spotColours) {
    const { pen, scene } = this, { faces, lines } = scene;
    pen.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    pen.fillStyle = css(BACKGROUND);
    pen.fillRect(0, 0, this.width, this.height);
    orbit.project(moved, this.width, this.height, this.at);
    if (scene.ghost) {
      orbit.project(scene.base, this.width, this.height, this.rest);
      this.stroke(this.rest, lines, css(GHOST), 1);
    }
    for (let t = 0; t < this.order.length; ++t)
      this.depth[t] = this.at[3 * faces[3 * t] + 2] + this.at[3 * faces[3 * t + 1] + 2] + this.at[3 * faces[3 * t + 2] + 2];
    this.order.sort((a, b) => this.depth[b] - this.depth[a]);
    for (const t of this.order) {
      const [i, j, k] = [3 * faces[3 * t], 3 * faces[3 * t + 1], 3 * faces[3 * t + 2]];
      pen.fillStyle = pen.strokeStyle = css([colours[i], colours[i + 1], colours[i + 2]], 0.95);
      pen.lineWidth = 0.5;
      pen.beginPath();
      pen.moveTo(this.at[i], this.at[i + 1]);
      pen.lineTo(this.at[j], this.at[j + 1]);
      pen.lineTo(this.at[k], this.at[k + 1]);
      pen.closePath();
      pen.fill();
      pen.stroke();
    }
    if (faces.length) this.stroke(this.at, lines, css(LINE), 0.8);
    else this.members(lines, colours);
    orbit.project(spots, this.width, this.height, this.dots);
    orbit.project(scene.spots, this.width, this.height, this.feet);
    for (let s = 0; s < spots.length; s += 3) {
      pen.strokeStyle = pen.fillStyle = css([spotColours[s], spotColours[s + 1], spotColours[s + 2]]);
      pen.lineWidth = 1.4;
      pen.beginPath();
      pen.moveTo(this.feet[s], this.feet[s + 1]);
      pen.lineTo(this.dots[s], this.dots[s + 1]);
      pen.stroke();
      pen.beginPath();
      pen.arc(this.dots[s], this.dots[s + 1], 0.5 * scene.dot, 0, 7);
      pen.fill();
    }
  }

  /// A frame without plates: its members are all there is to see, and carry the colours.
  members(lines, colours) {
    const { pen, at } = this;
    pen.lineWidth = 2.2;
    pen.lineCap = 'round';
    for (let l = 0; l < lines.length; l += 2) {
      const i = 3 * lines[l], j = 3 * lines[l + 1];
      pen.strokeStyle = css([0, 1, 2].map(k => 0.5 * (colours[i + k] + colours[j + k])));
      pen.beginPath();
      pen.moveTo(at[i], at[i + 1]);
      pen.lineTo(at[j], at[j + 1]);
      pen.stroke();
    }
  }

  stroke(at, lines, colour, width) {
    const pen = this.pen;
    pen.strokeStyle = colour;
    pen.lineWidth = width;
    pen.beginPath();
    for (let l = 0; l < lines.length; l += 2) {
      pen.moveTo(at[3 * lines[l]], at[3 * lines[l] + 1]);
      pen.lineTo(at[3 * lines[l + 1]], at[3 * lines[l + 1] + 1]);
    }
    pen.stroke();
  }
}
