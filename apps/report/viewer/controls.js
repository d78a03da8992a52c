// The controls of the section. Each change writes the settings and calls `changed`.

function makeControls(data, quantities, settings, changed) {
  const place = element("div", {class: "viewer-controls"});
  const last = data.frames.length - 1;

  const time = slider(0, last, 1, settings.frame), timeText = element("output");
  place.append(labelled("Time", time, timeText));

  const field = choice(quantities.map(quantity => quantity.label));
  field.value = quantities.indexOf(settings.quantity);
  place.append(labelled("Field", field));

  const factor = element("input", {type: "number", min: 0, step: "any"});
  factor.value = settings.factor;
  if (fieldNamed(data, "displacement")) place.append(labelled("Displacements times", factor));

  const axis = choice(["no cut", "x", "y", "z"]), cut = slider(0, 1, 0.002, 0.5);
  const cutText = element("output");
  place.append(labelled("Cut across", axis, cut), cutText);

  const hide = element("input", {type: "checkbox"});
  if (failureParts(data).length > 0) place.append(labelled("Hide intact particles", hide));

  const read = () => {
    settings.frame = Number(time.value);
    settings.quantity = quantities[field.value];
    settings.factor = Number.isFinite(factor.valueAsNumber) ? factor.valueAsNumber : 0;
    settings.axis = axis.value - 1;
    settings.hide = hide.checked;
    cut.hidden = cutText.hidden = settings.axis < 0;
    if (settings.axis >= 0) {
      const {min, max} = data.reference[settings.axis];
      settings.cut = min + cut.value * (max - min);
      cutText.textContent = `shown at rest up to ${"xyz"[settings.axis]} = ${withUnit(settings.cut, "m")}`;
    }
    timeText.textContent = withUnit(data.frames[settings.frame].time, "s");
    changed();
  };
  for (const control of [time, field, factor, axis, cut, hide]) control.addEventListener("input", read);
  read();
  return place;
}
