// Puts the parts together.

// A factor with which the largest displacement is about a tenth of the body, as 1, 2 or 5 times a
// power of ten; 1 if displacements are large.
function clearFactor(data, quantities, radius) {
  const displacement = quantities.find(quantity => quantity.label === "displacement, magnitude");
  const wanted = displacement && displacement.range[1] > 0 ? 0.1 * radius / displacement.range[1] : 1;
  if (!(wanted > 1)) return 1;
  const power = 10 ** Math.floor(Math.log10(wanted));
  return power * [5, 2, 1].find(step => step * power <= wanted * 1.0000001);
}

function start() {
  const place = document.getElementById("viewer-place");
  const data = readData(), quantities = quantitiesOf(data);
  data.rest = data.reference.map(array => valuesOf(data, array));
  data.neighbours = neighboursOf(data);
  const middle = data.reference.map(({min, max}) => (min + max) / 2);
  const radius = Math.hypot(...data.reference.map(({min, max}) => (max - min) / 2 + data.spacing / 2));
  const settings = {frame: data.frames.length - 1, quantity: quantities[0], axis: -1, cut: 0, hide: false,
                    factor: clearFactor(data, quantities, radius)};

  const canvas = element("canvas", {class: "viewer-canvas"});
  const cubes = new Cubes(data.spacing), scene = new THREE.Scene();
  let renderer = null;
  try {
    renderer = new THREE.WebGLRenderer({canvas, alpha: true, antialias: true, preserveDrawingBuffer: true});
  } catch (error) {
    place.textContent = "This browser has no WebGL, so the body is not shown in 3D.";
    return;
  }
  const legend = new Legend(), details = element("div", {class: "viewer-particle"});
  const count = element("p", {class: "viewer-count soft"});
  scene.add(cubes.mesh);

  let waits = false;
  const draw = () => {
    waits = false;
    renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
    renderer.setSize(canvas.clientWidth, canvas.clientHeight, false);
    cubes.material.uniforms.eye.value.copy(view.camera.position);
    renderer.render(scene, view.camera);
  };
  const drawSoon = () => {
    if (!waits) requestAnimationFrame(draw);
    waits = true;
  };
  const view = new Turntable(canvas, new THREE.Vector3(...middle), radius, drawSoon);

  let shown = [], picked = -1;
  const changed = () => {
    const filled = fillCubes(data, settings, cubes);
    shown = filled.shown;
    count.textContent = `${filled.count} of ${data.particles} particles are shown.`;
    legend.show(settings.quantity);
    showParticle(data, settings, quantities, picked, details);
    drawSoon();
  };
  const controls = makeControls(data, quantities, settings, changed);
  canvas.addEventListener("click", event => {
    if (view.travel > 5) return;
    const {origin, direction} = view.ray(event), met = cubes.met(origin, direction);
    picked = met < 0 ? -1 : shown[met];
    showParticle(data, settings, quantities, picked, details);
  });
  place.append(controls, canvas, legend.place, count, details);
  window.addEventListener("resize", () => view.place());
  view.place();
  draw();
}

start();
