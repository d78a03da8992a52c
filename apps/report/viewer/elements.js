// Makes an element with attributes and content; text never becomes markup.
function element(name, attributes = {}, ...content) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...content);
  return made;
}

// A control with its label and a text beside it.
function labelled(label, control, beside = "") {
  return element("label", {}, element("span", {}, label), control, beside);
}

function slider(from, to, step, value) {
  const made = element("input", {type: "range", min: from, max: to, step});
  made.value = value;
  return made;
}

function choice(names) {
  const made = element("select");
  names.forEach((name, n) => made.append(element("option", {value: n}, name)));
  return made;
}
