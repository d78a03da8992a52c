// Particles that nobody can see: all six neighbours of a cubic grid are drawn, and none has moved away
// by more than a tenth of an edge. Most particles of a large body are hidden.

const widestGap = 0.1;  // of an edge

// The six neighbours of each particle, -1 where there is none; null if the places at rest are no cubic
// grid, or if the grid is mostly empty.
function neighboursOf(data) {
  const edge = data.spacing, size = [], low = [];
  for (let axis = 0; axis < 3; ++axis) {
    const {min, max} = data.reference[axis];
    low.push(min);
    size.push(Math.round((max - min) / edge) + 1);
  }
  const steps = [1, size[0], size[0] * size[1]], sites = steps[2] * size[2];
  if (!(sites <= 20 * data.particles + 1000)) return null;
  const at = new Int32Array(sites).fill(-1), siteOf = new Int32Array(data.particles);
  for (let p = 0; p < data.particles; ++p) {
    let site = 0;
    for (let axis = 0; axis < 3; ++axis) {
      const place = (data.rest[axis][p] - low[axis]) / edge, whole = Math.round(place);
      if (!(Math.abs(place - whole) < 0.02)) return null;
      site += steps[axis] * whole;
    }
    if (at[site] >= 0) return null;
    at[site] = p;
    siteOf[p] = site;
  }
  const neighbours = new Int32Array(6 * data.particles);
  for (let p = 0; p < data.particles; ++p)
    for (let axis = 0; axis < 3; ++axis) {
      const place = Math.floor(siteOf[p] / steps[axis]) % size[axis];
      neighbours[6 * p + 2 * axis] = place > 0 ? at[siteOf[p] - steps[axis]] : -1;
      neighbours[6 * p + 2 * axis + 1] = place < size[axis] - 1 ? at[siteOf[p] + steps[axis]] : -1;
    }
  return neighbours;
}

// Whether the neighbours hide a particle. `chosen`: 1 for each particle that is to be seen; `moved`: the
// displacements as they are drawn.
function isHidden(data, chosen, moved, particle) {
  const most = widestGap * data.spacing;
  for (let n = 6 * particle; n < 6 * particle + 6; ++n) {
    const other = data.neighbours[n];
    if (other < 0 || !chosen[other]) return false;
    for (let axis = 0; axis < 3; ++axis)
      if (!(Math.abs(moved[3 * other + axis] - moved[3 * particle + axis]) <= most)) return false;
  }
  return true;
}
