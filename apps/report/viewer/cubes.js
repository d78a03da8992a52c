// Particles as cubes. Only the three faces that point to the camera are drawn: the shader mirrors
// them for each cube.

const cubeVertices = `
precision highp float;
attribute vec3 position, normal, place, colour;
uniform mat4 modelViewMatrix, projectionMatrix;
uniform vec3 eye;
uniform float edge;
varying vec3 shade;
void main() {
  vec3 side = sign(eye - place) + vec3(equal(eye, place));
  vec4 seen = modelViewMatrix * vec4(place + 0.5 * edge * side * position, 1.0);
  vec3 towards = normalize(eye - place);
  float light = 0.45 + 0.55 * abs(dot(normal * side, normalize(towards + vec3(0.2, 0.35, 0.6))));
  shade = colour * light;
  gl_Position = projectionMatrix * seen;
}`;
const cubeColours = `
precision mediump float;
varying vec3 shade;
void main() { gl_FragColor = vec4(shade, 1.0); }`;

class Cubes {
  constructor(most, edge) {
    this.places = new Float32Array(3 * most);
    this.colours = new Uint8Array(3 * most);
    this.edge = edge;
    const corners = [], normals = [], indices = [];
    for (let axis = 0; axis < 3; ++axis)
      for (const [a, b] of [[-1, -1], [1, -1], [1, 1], [-1, 1]]) {
        const corner = [1, 1, 1], normal = [0, 0, 0];
        corner[(axis + 1) % 3] = a;
        corner[(axis + 2) % 3] = b;
        normal[axis] = 1;
        corners.push(...corner);
        normals.push(...normal);
      }
    for (let face = 0; face < 3; ++face) indices.push(...[0, 1, 2, 0, 2, 3].map(n => 4 * face + n));
    const geometry = this.geometry = new THREE.InstancedBufferGeometry();
    geometry.setIndex(indices);
    geometry.setAttribute("position", new THREE.Float32BufferAttribute(corners, 3));
    geometry.setAttribute("normal", new THREE.Float32BufferAttribute(normals, 3));
    geometry.setAttribute("place", new THREE.InstancedBufferAttribute(this.places, 3));
    geometry.setAttribute("colour", new THREE.InstancedBufferAttribute(this.colours, 3, true));
    this.material = new THREE.RawShaderMaterial({
      vertexShader: cubeVertices, fragmentShader: cubeColours, side: THREE.DoubleSide,
      uniforms: {eye: {value: new THREE.Vector3()}, edge: {value: edge}}});
    this.mesh = new THREE.Mesh(geometry, this.material);
    this.mesh.frustumCulled = false;
  }

  // Draws the first `count` places with their colours.
  show(count) {
    this.count = count;
    this.geometry.maxInstancedCount = count;
    this.mesh.visible = count > 0;
    this.geometry.attributes.place.needsUpdate = this.geometry.attributes.colour.needsUpdate = true;
  }

  // The number of the nearest cube that a ray meets, among those drawn; -1 if it meets none.
  met(origin, direction) {
    const from = origin.toArray(), along = direction.toArray(), half = this.edge / 2;
    let nearest = Infinity, found = -1;
    for (let n = 0; n < this.count; ++n) {
      let enter = 0, leave = nearest;
      for (let axis = 0; axis < 3 && enter <= leave; ++axis) {
        const middle = (this.places[3 * n + axis] - from[axis]) / along[axis], reach = half / Math.abs(along[axis]);
        enter = Math.max(enter, middle - reach);
        leave = Math.min(leave, middle + reach);
      }
      if (enter <= leave && enter < nearest) [nearest, found] = [enter, n];
    }
    return found;
  }
}
