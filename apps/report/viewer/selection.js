// Which particles are drawn, and where.

// Fields that are 0 for an intact particle.
const failureFields = ["damage", "broken_open", "broken_closed"];

function failureParts(data) {
  return failureFields.map(name => fieldNamed(data, name)).filter(field => field).map(field => field.first);
}

// Fills the cubes with the particles that the settings choose. Returns their numbers.
function fillCubes(data, settings, cubes) {
  const frame = data.frames[settings.frame], displacement = fieldNamed(data, "displacement");
  const moved = displacement ? [0, 1, 2].map(axis => frame.arrays[displacement.first + axis]) : null;
  const failures = settings.hide ? failureParts(data).map(part => frame.arrays[part]) : [];
  const [low, high] = settings.quantity.range, shown = [];
  for (let p = 0; p < data.particles; ++p) {
    if (settings.axis >= 0 && data.rest[settings.axis][p] > settings.cut) continue;
    if (settings.hide && !failures.some(array => valueOf(data, array, p) > 0)) continue;
    const at = 3 * shown.length;
    for (let axis = 0; axis < 3; ++axis) {
      const way = moved ? settings.factor * valueOf(data, moved[axis], p) : 0;
      cubes.places[at + axis] = data.rest[axis][p] + (Number.isFinite(way) ? way : 0);
    }
    const value = quantityAt(data, settings.quantity, settings.frame, p);
    putColour(high > low ? (value - low) / (high - low) : 0 * value, cubes.colours, at);
    shown.push(p);
  }
  cubes.show(shown.length);
  return shown;
}
