// Which particles are drawn, and where.

// Fields that are 0 for an intact particle.
const failureFields = ["damage", "broken_open", "broken_closed"];

function failureParts(data) {
  return failureFields.map(name => fieldNamed(data, name)).filter(field => field).map(field => field.first);
}

// Fills the cubes with those of the chosen particles that can be seen. Returns the numbers of the
// particles that are drawn, and how many the settings choose.
function fillCubes(data, settings, cubes) {
  const frame = data.frames[settings.frame], displacement = fieldNamed(data, "displacement");
  const moved = displacement ? [0, 1, 2].map(axis => frame.arrays[displacement.first + axis]) : null;
  const failures = settings.hide ? failureParts(data).map(part => frame.arrays[part]) : [];
  const [low, high] = settings.quantity.range, shown = [];
  const places = new Float32Array(3 * data.particles), colours = new Uint8Array(3 * data.particles);
  const chosen = new Uint8Array(data.particles), ways = new Float32Array(3 * data.particles);
  let count = 0;
  for (let p = 0; p < data.particles; ++p) {
    if (settings.axis >= 0 && data.rest[settings.axis][p] > settings.cut) continue;
    if (settings.hide && !failures.some(array => valueOf(data, array, p) > 0)) continue;
    chosen[p] = 1;
    ++count;
    for (let axis = 0; axis < 3; ++axis) {
      const way = moved ? settings.factor * valueOf(data, moved[axis], p) : 0;
      ways[3 * p + axis] = Number.isFinite(way) ? way : 0;
    }
  }
  for (let p = 0; p < data.particles; ++p) {
    if (!chosen[p] || (data.neighbours && isHidden(data, chosen, ways, p))) continue;
    const at = 3 * shown.length;
    for (let axis = 0; axis < 3; ++axis) places[at + axis] = data.rest[axis][p] + ways[3 * p + axis];
    const value = quantityAt(data, settings.quantity, settings.frame, p);
    putColour(high > low ? (value - low) / (high - low) : 0 * value, colours, at);
    shown.push(p);
  }
  cubes.show(shown.length, places, colours);
  return {shown, count};
}
