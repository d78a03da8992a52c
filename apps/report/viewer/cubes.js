// Particles as cubes. Only the three faces that point to the camera are drawn: the shader mirrors
// them for each cube. Cubes are no instances of one cube, because browsers without a graphics
// processor draw instances one by one.

const verticesOfCube = 12, indicesOfCube = 18;

const cubeVertices = `
precision highp float;
attribute vec3 position;  // of the cube
attribute vec4 colour;    // and the number of the corner: four of each face
uniform mat4 modelViewMatrix, projectionMatrix;
uniform vec3 eye;
uniform float edge;
varying vec3 shade;
void main() {
  float face = floor(colour.a / 4.0 + 0.01), number = colour.a - 4.0 * face;
  vec3 corner = vec3(1.0, number > 0.5 && number < 2.5 ? 1.0 : -1.0, number > 1.5 ? 1.0 : -1.0);
  vec3 normal = vec3(1.0, 0.0, 0.0);
  if (face > 0.5) {
    corner = corner.zxy;
    normal = normal.zxy;
  }
  if (face > 1.5) {
    corner = corner.zxy;
    normal = normal.zxy;
  }
  vec3 side = sign(eye - position) + vec3(equal(eye, position));
  vec4 seen = modelViewMatrix * vec4(position + 0.5 * edge * side * corner, 1.0);
  vec3 towards = normalize(eye - position);
  float light = 0.45 + 0.55 * abs(dot(normal * side, normalize(towards + vec3(0.2, 0.35, 0.6))));
  shade = colour.rgb / 255.0 * light;
  gl_Position = projectionMatrix * seen;
}`;
const cubeColours = `
precision mediump float;
varying vec3 shade;
void main() { gl_FragColor = vec4(shade, 1.0); }`;

class Cubes {
  constructor(edge) {
    this.edge = edge;
    this.room = -1;  // number of cubes for which there is memory
    this.geometry = new THREE.BufferGeometry();
    this.material = new THREE.RawShaderMaterial({
      vertexShader: cubeVertices, fragmentShader: cubeColours, side: THREE.DoubleSide,
      uniforms: {eye: {value: new THREE.Vector3()}, edge: {value: edge}}});
    this.mesh = new THREE.Mesh(this.geometry, this.material);
    this.mesh.frustumCulled = false;
  }

  // Draws the first `count` cubes, given their places, m, and colours, three numbers each.
  show(count, places, colours) {
    [this.count, this.places] = [count, places];
    if (!(count <= this.room)) this.makeRoom(Math.ceil(1.2 * count));
    const {position, colour} = this.geometry.attributes;
    for (let vertex = 0; vertex < verticesOfCube * count; ++vertex) {
      const from = 3 * Math.floor(vertex / verticesOfCube);
      for (let part = 0; part < 3; ++part) {
        position.array[3 * vertex + part] = places[from + part];
        colour.array[4 * vertex + part] = colours[from + part];
      }
    }
    this.geometry.setDrawRange(0, indicesOfCube * count);
    this.mesh.visible = count > 0;
    position.needsUpdate = colour.needsUpdate = true;
  }

  // Makes room for so many cubes. The fourth number of a colour is the number of the corner.
  makeRoom(count) {
    this.room = count;
    const indices = new Uint32Array(indicesOfCube * count), colours = new Uint8Array(4 * verticesOfCube * count);
    for (let vertex = 0; vertex < verticesOfCube * count; ++vertex) colours[4 * vertex + 3] = vertex % verticesOfCube;
    const corners = [0, 1, 2, 0, 2, 3];  // of the two triangles of a face
    for (let n = 0; n < indices.length; ++n) indices[n] = 4 * Math.floor(n / 6) + corners[n % 6];
    this.geometry.dispose();
    this.geometry.setIndex(new THREE.BufferAttribute(indices, 1));
    this.geometry.setAttribute(
      "position", new THREE.BufferAttribute(new Float32Array(3 * verticesOfCube * count), 3));
    this.geometry.setAttribute("colour", new THREE.BufferAttribute(colours, 4));
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
