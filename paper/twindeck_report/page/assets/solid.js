// Drawing with WebGL through three.js.
class SolidCanvas {
  constructor(canvas) {
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });  // kept for print
    this.renderer.setClearColor(new THREE.Color(...BACKGROUND));
    this.name = 'webgl';
    this.camera = new THREE.PerspectiveCamera(FIELD * 180 / Math.PI, 1, 0.1, 1000);
    this.camera.up.set(0, 0, 1);
    const disc = document.createElement('canvas');
    disc.width = disc.height = 64;
    const pen = disc.getContext('2d');
    pen.fillStyle = '#fff';
    pen.arc(32, 32, 30, 0, 7);
    pen.fill();
    this.disc = new THREE.CanvasTexture(disc);
  }

  show(scene) {
    this.world = new THREE.Scene();
    this.world.add(new THREE.AmbientLight(0xffffff, 0.82));
    this.lamp = new THREE.DirectionalLight(0xffffff, 0.3);
    this.world.add(this.lamp);
    const coloured = { vertexColors: THREE.VertexColors };
    const attribute = array => new THREE.BufferAttribute(array, 3);
    const index = array => new THREE.BufferAttribute(scene.base.length / 3 < 65536 ? Uint16Array.from(array) : array, 1);
    this.position = attribute(new Float32Array(scene.base));
    this.colour = attribute(new Float32Array(scene.base.length));
    const body = (positions, indices, colours) => {
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute('position', positions);
      if (colours) geometry.setAttribute('color', colours);
      if (indices) geometry.setIndex(index(indices));
      return geometry;
    };
    const add = object => {
      object.frustumCulled = false;  // the bounds move with the shape
      this.world.add(object);
    };
    if (scene.faces.length)
      add(new THREE.Mesh(body(this.position, scene.faces, this.colour), new THREE.MeshLambertMaterial({
        ...coloured, side: THREE.DoubleSide, flatShading: true, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 })));
    add(new THREE.LineSegments(body(this.position, scene.lines, this.colour), new THREE.LineBasicMaterial(
        scene.faces.length ? { color: new THREE.Color(...LINE) } : coloured)));
    if (scene.ghost) {  // drawn first and without depth: whatever moves lies over it
      const ghost = new THREE.LineSegments(body(attribute(scene.base), scene.lines),
        new THREE.LineBasicMaterial({ color: new THREE.Color(...GHOST), depthWrite: false }));
      ghost.renderOrder = -1;
      add(ghost);
    }
    const count = scene.spots.length / 3;
    this.spot = attribute(new Float32Array(scene.spots));
    this.spotColour = attribute(new Float32Array(scene.spots.length));
    this.stick = attribute(new Float32Array(2 * scene.spots.length));
    this.stickColour = attribute(new Float32Array(2 * scene.spots.length));
    if (count) {
      const over = scene.spotsOnTop ? { depthTest: false } : {};
      add(new THREE.LineSegments(body(this.stick, null, this.stickColour), new THREE.LineBasicMaterial({ ...coloured, ...over })));
      this.dotMaterial = new THREE.PointsMaterial({
        ...coloured, size: scene.dot, sizeAttenuation: false, map: this.disc, alphaTest: 0.5, ...over });
      add(new THREE.Points(body(this.spot, null, this.spotColour), this.dotMaterial));
    }
    this.scene = scene;
  }

  size(width, height, ratio) {
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
  }

  draw(orbit, moved, colours, spots, spotColours) {
    this.position.array.set(moved);
    this.colour.array.set(colours);
    this.position.needsUpdate = this.colour.needsUpdate = true;
    if (spots.length) {
      this.spot.array.set(spots);
      this.spotColour.array.set(spotColours);
      for (let s = 0; s < spots.length; ++s) {
        const at = 6 * Math.floor(s / 3) + s % 3;
        this.stick.array[at] = this.scene.spots[s];
        this.stick.array[at + 3] = spots[s];
        this.stickColour.array[at] = this.stickColour.array[at + 3] = spotColours[s];
      }
      for (const part of [this.spot, this.spotColour, this.stick, this.stickColour]) part.needsUpdate = true;
    }
    const eye = orbit.eye();
    this.camera.position.set(...eye);
    this.camera.near = Math.max(0.005 * orbit.size, orbit.distance - 2 * orbit.reach);
    this.camera.far = orbit.distance + 2 * orbit.reach;
    this.camera.updateProjectionMatrix();
    this.camera.lookAt(...orbit.target);
    this.lamp.position.set(eye[0] - orbit.target[0], eye[1] - orbit.target[1], eye[2] - orbit.target[2] + 0.6 * orbit.distance);
    this.renderer.render(this.world, this.camera);
  }
}

const webgl = () => {  // asked of a canvas that is thrown away: a canvas that once had a context keeps it
  if (typeof THREE === 'undefined' || document.documentElement.dataset.renderer === 'canvas') return false;
  const trial = document.createElement('canvas');
  return Boolean(trial.getContext('webgl') || trial.getContext('experimental-webgl'));
};
