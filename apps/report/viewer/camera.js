// A camera that turns around the body. Left button or one finger: turn. Right button or Shift: move.
// Wheel: distance. The z axis points up.

class Turntable {
  constructor(canvas, middle, radius, changed) {
    this.camera = new THREE.PerspectiveCamera(35, 1, radius / 100, radius * 100);
    this.camera.up.set(0, 0, 1);
    this.radius = radius;
    this.target = middle.clone();
    this.distance = 2.9 * radius;
    this.azimuth = 0.9;
    this.height = 0.45;
    this.canvas = canvas;
    this.changed = changed;
    let last = null;
    canvas.addEventListener("pointerdown", event => {
      last = event;
      this.travel = 0;
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener("pointermove", event => {
      if (!last || event.pointerId !== last.pointerId) return;
      const dx = event.clientX - last.clientX, dy = event.clientY - last.clientY;
      this.travel += Math.abs(dx) + Math.abs(dy);
      if ((event.buttons & 2) || event.shiftKey) this.move(dx, dy);
      else this.turn(dx, dy);
      last = event;
    });
    canvas.addEventListener("pointerup", () => { last = null; });
    canvas.addEventListener("pointercancel", () => { last = null; });
    canvas.addEventListener("contextmenu", event => event.preventDefault());
    canvas.addEventListener("wheel", event => {
      event.preventDefault();
      this.distance = Math.min(Math.max(this.distance * Math.exp(0.001 * event.deltaY), 0.05 * radius), 50 * radius);
      this.place();
    }, {passive: false});
  }

  turn(dx, dy) {
    this.azimuth -= 0.008 * dx;
    this.height = Math.min(Math.max(this.height + 0.008 * dy, -1.55), 1.55);
    this.place();
  }

  move(dx, dy) {
    const perPixel = 2 * this.distance * Math.tan(this.camera.fov * Math.PI / 360) / this.canvas.clientHeight;
    const right = new THREE.Vector3().setFromMatrixColumn(this.camera.matrix, 0);
    const up = new THREE.Vector3().setFromMatrixColumn(this.camera.matrix, 1);
    this.target.addScaledVector(right, -dx * perPixel).addScaledVector(up, dy * perPixel);
    this.place();
  }

  place() {
    const flat = this.distance * Math.cos(this.height);
    this.camera.position.set(flat * Math.cos(this.azimuth), flat * Math.sin(this.azimuth),
                             this.distance * Math.sin(this.height)).add(this.target);
    this.camera.lookAt(this.target);
    this.camera.near = Math.max(this.distance - 3 * this.radius, 0.01 * this.distance);
    this.camera.far = this.distance + 10 * this.radius;
    this.camera.aspect = this.canvas.clientWidth / Math.max(this.canvas.clientHeight, 1);
    this.camera.updateProjectionMatrix();
    this.camera.updateMatrixWorld();
    this.changed();
  }

  // The ray under a place of the screen.
  ray(event) {
    const box = this.canvas.getBoundingClientRect(), caster = new THREE.Raycaster();
    caster.setFromCamera({x: 2 * (event.clientX - box.left) / box.width - 1,
                          y: 1 - 2 * (event.clientY - box.top) / box.height}, this.camera);
    return caster.ray;
  }
}
