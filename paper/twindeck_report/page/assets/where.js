// Where the diagnosis would change the model: scores as colours of parts and as spots.
class Where {
  constructor(root, data, mesh) {
    const lines = unpack(mesh.lines, Uint32Array), faces = unpack(mesh.faces, Uint32Array);
    const points = unpack(mesh.points, Float32Array), score = unpack(data.score, Float32Array);
    const spots = Float32Array.from(data.spots.flatMap(s => s.at));
    this.viewer = new Viewer(root, v => {
      for (let i = 0; i < score.length; ++i) blend([PALE, AMBER, RED], score[i], v.colours, 3 * i);
      data.spots.forEach((s, i) => blend([PALE, AMBER, RED], s.score / data.most, v.spotColours, 3 * i));
    }, fewMembers({ lines, faces }));
    this.viewer.show({ base: points, framed: framed(points, mesh), faces, lines, spots,
      names: data.spots.map(s => `${s.name}: ${s.score.toFixed(1)}`), dot: 11, ghost: false, spotsOnTop: true });
  }
}
