// The data of the page: a description (JSON) and one block of 16-bit numbers (base64).

// A value q from 0 to 65534 means min + q (max - min) / 65534; 65535 means "no number".
const largestStep = 65534, noNumber = 65535;

function readData() {
  const about = JSON.parse(document.getElementById("viewer-about").textContent);
  const text = atob(document.getElementById("viewer-numbers").textContent.trim());
  const bytes = new Uint8Array(text.length);
  for (let n = 0; n < text.length; ++n) bytes[n] = text.charCodeAt(n);
  about.numbers = new Uint16Array(bytes.buffer);
  return about;
}

// The value of one particle in one array {min, max, at}.
function valueOf(data, array, particle) {
  const step = data.numbers[array.at + particle];
  return step === noNumber ? NaN : array.min + step * (array.max - array.min) / largestStep;
}

// All values of one array.
function valuesOf(data, array) {
  const values = new Float32Array(data.particles);
  for (let p = 0; p < data.particles; ++p) values[p] = valueOf(data, array, p);
  return values;
}

function fieldNamed(data, name) {
  return data.fields.find(field => field.name === name);
}
