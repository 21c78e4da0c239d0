// One picture: the tetrahedra of a region, the polygon, and what has just happened, drawn with OGL.

const VERTEX = `
attribute vec3 position, centre, normal, colour;
uniform mat4 modelViewMatrix, projectionMatrix;
uniform float shrink, explode, pointSize;
uniform vec3 middle;
varying vec3 vColour, vNormal;
void main() {
  vec3 p = centre + (centre - middle) * explode + (position - centre) * shrink;
  vColour = colour;
  vNormal = mat3(modelViewMatrix) * normal;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(p, 1.0);
  gl_PointSize = pointSize;
}`;

// Light comes from the viewer and from above; both sides of a triangle are alike. Lines and points have no normal and no light.
const FRAGMENT = `
precision highp float;
uniform float alpha, pointSize;
varying vec3 vColour, vNormal;
void main() {
  if (pointSize > 0.0 && distance(gl_PointCoord, vec2(0.5)) > 0.5) discard;
  float light = 1.0;
  if (dot(vNormal, vNormal) > 0.0) {
    vec3 n = normalize(vNormal);
    if (n.z < 0.0) n = -n;
    light = 0.66 + 0.28 * n.z + 0.14 * n.y;
  }
  gl_FragColor = vec4(vColour * light, alpha);
}`;

const FACES = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];
const EDGES = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];

/** Vertices with what the shader wants of them. */
class Shape {
  constructor() {
    this.arrays = { position: [], centre: [], normal: [], colour: [] };
  }

  add(position, centre, normal, colour) {
    const { arrays } = this;
    arrays.position.push(...position);
    arrays.centre.push(...centre);
    arrays.normal.push(...normal);
    arrays.colour.push(...colour);
  }

  triangle(corners, centre, colour) {
    const [a, b, c] = corners;
    const [u, w] = [minus(b, a), minus(c, a)];
    const normal = [u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0]];
    const length = Math.hypot(...normal) || 1;
    for (const p of corners) this.add(p, centre ?? p, normal.map((x) => x / length), colour);
  }

  line(p, q, centre, colour) {
    for (const r of [p, q]) this.add(r, centre ?? r, [0, 0, 0], colour);
  }

  get size() {
    return this.arrays.position.length / 3;
  }
}

const minus = (p, q) => p.map((x, i) => x - q[i]);
const mean = (points) => [0, 1, 2].map((i) => points.reduce((s, p) => s + p[i], 0) / points.length);
const darker = (colour, by) => colour.map((x) => x * by);

/** The colours of the style sheet, which follow the light or dark mode. */
function palette() {
  const style = getComputedStyle(document.documentElement);
  const colour = (name) => {
    const hex = style.getPropertyValue(`--v-${name}`).trim();
    return [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16) / 255);
  };
  const names = ["crossing", "above", "below", "fresh", "refused", "polygon", "ink", "back"];
  return Object.fromEntries(names.map((name) => [name, colour(name)]));
}

class Stage {
  constructor(canvas, labels) {
    const probe = document.createElement("canvas").getContext("webgl2");
    this.works = probe !== null;
    if (!this.works) return;
    // Chromium keeps only so many contexts.
    probe.getExtension("WEBGL_lose_context")?.loseContext();
    this.labels = labels;
    this.renderer = new OGL.Renderer({
      canvas, alpha: false, antialias: true, preserveDrawingBuffer: true, dpr: Math.min(window.devicePixelRatio, 2),
    });
    this.gl = this.renderer.gl;
    this.camera = new OGL.Camera(this.gl, { fov: 28, near: 0.05, far: 60 });
    this.root = new OGL.Transform();
    const { gl } = this;
    this.meshes = {
      tets: this.mesh(gl.TRIANGLES, {}),
      edges: this.mesh(gl.LINES, {}),
      faces: this.mesh(gl.TRIANGLES, {}),
      circuit: this.mesh(gl.LINES, { transparent: true, depthTest: false }),
      // What the last event was about is seen through what is before it.
      glow: this.mesh(gl.TRIANGLES, { transparent: true, alpha: 0.28, depthTest: false }),
      vertices: this.mesh(gl.POINTS, { pointSize: 5 }),
      five: this.mesh(gl.POINTS, { pointSize: 9, transparent: true, depthTest: false }),
      outline: this.mesh(gl.LINES, {}),
      polygon: this.mesh(gl.TRIANGLES, { transparent: true, alpha: 0.3 }),
      // Where tetrahedra hide it, a trace of it.
      hidden: this.mesh(gl.TRIANGLES, { transparent: true, alpha: 0.13, depthTest: false }),
    };
  }

  mesh(mode, { transparent = false, alpha = 1, pointSize = 0, depthTest = true }) {
    const { gl } = this;
    const program = new OGL.Program(gl, {
      vertex: VERTEX, fragment: FRAGMENT, cullFace: false, transparent, depthTest, depthWrite: !transparent,
      uniforms: {
        shrink: { value: 1 }, explode: { value: 0 }, middle: { value: [0, 0, 0] }, alpha: { value: alpha },
        pointSize: { value: pointSize * this.renderer.dpr },
      },
    });
    const mesh = new OGL.Mesh(gl, { mode, program, geometry: this.geometry(new Shape()), frustumCulled: false });
    mesh.setParent(this.root);
    return mesh;
  }

  geometry(shape) {
    const attributes = Object.entries(shape.arrays).map(([name, data]) => {
      return [name, { size: 3, data: new Float32Array(data.length > 0 ? data : 3) }];
    });
    return new OGL.Geometry(this.gl, Object.fromEntries(attributes));
  }

  fill(name, shape) {
    const mesh = this.meshes[name];
    mesh.geometry.remove();
    mesh.geometry = this.geometry(shape);
    mesh.visible = shape.size > 0;
  }

  /** Looks at the middle of a scene from now on; distances are in its radii. */
  frame(scene) {
    const range = (i, pick) => pick(...scene.at.map((p) => p[i]));
    this.target = [0, 1, 2].map((i) => (range(i, Math.min) + range(i, Math.max)) / 2);
    this.radius = Math.max(...scene.at.map((p) => Math.hypot(...minus(p, this.target))));
    for (const mesh of Object.values(this.meshes ?? {})) mesh.program.uniforms.middle.value = this.target;
  }

  /** Shows a run of a scene after k events. */
  show(scene, run, k, { settled, polygon }) {
    if (!this.works) return;
    const colours = palette();
    this.gl.clearColor(...colours.back, 1);
    const at = (v) => scene.at[v];
    const step = k > 0 ? run.steps[k - 1] : null;
    const refused = step !== null && step.flip === 0;
    const [tets, edges, glow] = [new Shape(), new Shape(), new Shape()];
    for (const t of tetsAfter(scene, run, k)) {
      const corners = scene.tets[t].map(at);
      const fresh = step?.created.includes(t) ?? false;
      const held = refused && scene.tets[t].every((v) => step.circuit.includes(v));
      const place = scene.crosses[t] ? "crossing" : scene.above[t] ? "above" : "below";
      const colour = colours[fresh ? "fresh" : held ? "refused" : place];
      const centre = mean(corners);
      if (settled || scene.crosses[t] || fresh || held) {
        for (const face of FACES) tets.triangle(face.map((i) => corners[i]), centre, colour);
      }
      if (fresh || held) {
        for (const face of FACES) glow.triangle(face.map((i) => corners[i]), centre, colour);
      }
      for (const [i, j] of EDGES) edges.line(corners[i], corners[j], centre, darker(colour, 0.45));
    }
    this.fill("tets", tets);
    this.fill("edges", edges);
    this.fill("glow", glow);
    this.showEvent(scene, run, k, colours, at);
    this.showPolygon(scene, polygon, colours, at);
  }

  showEvent(scene, run, k, colours, at) {
    const step = k > 0 ? run.steps[k - 1] : null;
    const [circuit, five, faces, vertices] = [new Shape(), new Shape(), new Shape(), new Shape()];
    scene.at.forEach((p) => vertices.add(p, p, [0, 0, 0], colours.ink));
    if (step !== null) {
      const colour = colours[step.flip === 0 ? "refused" : "fresh"];
      const [v, x, y, z, w] = step.circuit.map(at);
      for (const [p, q] of [[x, y], [y, z], [z, x], [v, x], [v, y], [v, z], [w, x], [w, y], [w, z]]) {
        circuit.line(p, q, null, colour);
      }
      for (const p of [v, x, y, z, w]) five.add(p, p, [0, 0, 0], colour);
    }
    if (k === run.steps.length) {
      for (const face of run.bad) faces.triangle(face.map(at), null, colours.refused);
    }
    this.fill("circuit", circuit);
    this.fill("five", five);
    this.fill("faces", faces);
    this.fill("vertices", vertices);
    const named = step === null ? [] : step.circuit;
    this.labels.innerHTML = named.map((v) => `<span>${scene.names[v]}</span>`).join("");
    this.named = named.map(at);
  }

  showPolygon(scene, visible, colours, at) {
    const [polygon, outline] = [new Shape(), new Shape()];
    if (visible) {
      const corners = scene.polygon.map(at);
      // All polygons of the scenes are convex.
      for (let i = 2; i < corners.length; i += 1) polygon.triangle([corners[0], corners[i - 1], corners[i]], null, colours.polygon);
      corners.forEach((p, i) => outline.line(p, corners[(i + 1) % corners.length], null, colours.polygon));
    }
    this.fill("polygon", polygon);
    this.fill("hidden", polygon);
    this.fill("outline", outline);
  }

  resize() {
    if (!this.works) return;
    const { clientWidth, clientHeight } = this.labels;
    this.renderer.setSize(clientWidth, clientHeight);
    this.camera.perspective({ aspect: clientWidth / Math.max(clientHeight, 1) });
  }

  /** Draws what is shown, seen from the given direction. */
  render({ theta, phi, distance, shrink, explode }) {
    if (!this.works) return;
    for (const name of ["tets", "edges", "glow"]) {
      this.meshes[name].program.uniforms.shrink.value = shrink;
      this.meshes[name].program.uniforms.explode.value = explode;
    }
    const [x, y, z] = this.target;
    const far = distance * this.radius;
    this.camera.position.set(
      x + far * Math.cos(phi) * Math.sin(theta), y + far * Math.sin(phi), z + far * Math.cos(phi) * Math.cos(theta),
    );
    this.camera.lookAt(this.target);
    this.renderer.render({ scene: this.root, camera: this.camera });
    const { clientWidth, clientHeight } = this.labels;
    [...this.labels.children].forEach((label, i) => {
      const p = new OGL.Vec3(...this.named[i]);
      this.camera.project(p);
      label.style.transform = `translate(${((p.x + 1) / 2) * clientWidth}px, ${((1 - p.y) / 2) * clientHeight}px)`;
    });
  }

  /** How many colours the picture has, of some sampled pixels: 1 if nothing is drawn. */
  colours() {
    const { gl } = this;
    const [w, h] = [gl.drawingBufferWidth, gl.drawingBufferHeight];
    const pixels = new Uint8Array(4 * w * h);
    gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    const seen = new Set();
    for (let i = 0; i < pixels.length; i += 4 * 7) seen.add(pixels[i] + 256 * pixels[i + 1] + 65536 * pixels[i + 2]);
    return seen.size;
  }
}
