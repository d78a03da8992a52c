// What a click on a particle shows: its values now, and one quantity over time.

function showParticle(data, settings, quantities, particle, place) {
  place.textContent = "";
  if (particle < 0) return;
  const frame = data.frames[settings.frame];
  const rest = data.rest.map(axis => withUnit(axis[particle], "m")).join(", ");
  place.append(element("h4", {}, `Particle ${particle} of the file, at rest at ${rest}`));
  const table = element("table");
  for (const quantity of quantities)
    table.append(element("tr", {}, element("th", {}, quantity.label),
                         element("td", {}, withUnit(quantityAt(data, quantity, settings.frame, particle),
                                                    quantity.unit))));
  place.append(element("p", {}, `at ${withUnit(frame.time, "s")}`), table);
  const curve = element("canvas", {width: 360, height: 150});
  place.append(element("p", {}, `${settings.quantity.label} over time`), curve);
  drawCurve(curve, data.frames.map(one => one.time),
            data.frames.map((_, f) => quantityAt(data, settings.quantity, f, particle)), settings);
}

function drawCurve(canvas, times, values, settings) {
  const numbers = values.filter(Number.isFinite);
  if (numbers.length === 0) return;
  const pen = canvas.getContext("2d"), {width, height} = canvas, border = 18;
  const low = Math.min(...numbers), high = Math.max(...numbers), last = times.length - 1;
  const share = (value, from, to) => to > from ? (value - from) / (to - from) : 0.5;
  const x = time => border + (width - 2 * border) * share(time, times[0], times[last]);
  const y = value => height - border - (height - 2 * border) * share(value, low, high);
  const ink = getComputedStyle(canvas).color;
  pen.strokeStyle = pen.fillStyle = ink;
  pen.font = "11px sans-serif";
  pen.fillText(withUnit(high, settings.quantity.unit), 2, 11);
  const span = `time from ${withUnit(times[0], "s")} to ${withUnit(times[last], "s")}`;
  pen.fillText(`${withUnit(low, settings.quantity.unit)}; ${span}`, 2, height - 3);
  pen.beginPath();
  values.forEach((value, f) => Number.isFinite(value) && pen.lineTo(x(times[f]), y(value)));
  pen.stroke();
  pen.beginPath();
  pen.arc(x(times[settings.frame]), y(values[settings.frame]), 4, 0, 2 * Math.PI);
  pen.fill();
}
