// What a particle can be coloured by: each component of each field, and the magnitude of vectors.

function quantitiesOf(data) {
  const all = [];
  for (const field of data.fields) {
    const parts = field.components.map((_, n) => field.first + n);
    const label = field.name.replace(/_/g, " ");
    if (field.is_vector) all.push({label: label + ", magnitude", unit: field.unit, parts});
    field.components.forEach((part, n) =>
      all.push({label: part ? label + " " + part : label, unit: field.unit, parts: [parts[n]]}));
  }
  for (const quantity of all) quantity.range = rangeOf(data, quantity);
  return all;
}

function quantityAt(data, quantity, frame, particle) {
  const arrays = data.frames[frame].arrays;
  if (quantity.parts.length === 1) return valueOf(data, arrays[quantity.parts[0]], particle);
  let sum = 0;
  for (const part of quantity.parts) sum += valueOf(data, arrays[part], particle) ** 2;
  return Math.sqrt(sum);
}

// The least and the greatest value of all frames, so that colours mean the same at all times.
function rangeOf(data, quantity) {
  let low = Infinity, high = -Infinity;
  data.frames.forEach((frame, f) => {
    if (quantity.parts.length === 1) {
      const array = frame.arrays[quantity.parts[0]];
      if (array.min === null) return;
      low = Math.min(low, array.min);
      high = Math.max(high, array.max);
      return;
    }
    for (let p = 0; p < data.particles; ++p) {
      const value = quantityAt(data, quantity, f, p);
      if (value < low) low = value;
      if (value > high) high = value;
    }
  });
  return low <= high ? [low, high] : [0, 0];
}

// A number with four digits and its unit.
function withUnit(value, unit) {
  if (!Number.isFinite(value)) return "no number";
  const size = Math.abs(value);
  const text = size !== 0 && (size < 1e-3 || size >= 1e5) ? value.toExponential(3) : String(+value.toPrecision(4));
  return unit ? text + " " + unit : text;
}
