"""Checks the page of `hyperlattice report --interactive`: its numbers are those that VTK reads from the frames, it is
well-formed and loads nothing from outside; and, where Chromium is installed, it shows the body, cuts it, answers a
click, and turns the body as the pointer drags it. Arguments: the program, the file of three.js, and a working folder,
which is deleted and made anew."""
import base64
import html.parser
import json
import pathlib
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
import chromium  # noqa: E402

TITLE = '</script><script>alert(1)</script> "a" & \'b\' ]]>'
FIELDS = ["displacement", "broken_open", "stress"]
SCENE = {
    "format": "hyperlattice/1",
    "title": TITLE,
    "pipeline": [
        {"type": "lattices.cubic", "spacing": "1 mm",
         "shape": {"hollow_sphere": {"inner_radius": "3 mm", "outer_radius": "6 mm"}}},
        {"type": "materials.elastic", "young": "10 GPa", "poisson": 0.1, "density": 2500, "membrane": "I-m",
         "failure": {"type": "failures.elongation", "limit": "1e-3 mm"}},
        {"type": "loads.blast", "on": "inner_surface", "peak": "100 MPa", "rise": "2 us", "fall": "5 us"},
        {"type": "solvers.explicit", "end_time": "6 us"},
        {"type": "writers.vtu", "every": "1 us", "fields": FIELDS}]}

# Uses the page as a person does, and leaves what it sees in the element "seen".
VISITOR = """
(async () => {
  const seen = {}, all = name => [...document.querySelectorAll(name)];
  const pixels = async () => {
    await new Promise(done => setTimeout(done, 200));
    const canvas = document.querySelector(".viewer-canvas"), copy = document.createElement("canvas");
    [copy.width, copy.height] = [canvas.width, canvas.height];
    copy.getContext("2d").drawImage(canvas, 0, 0);
    const colours = copy.getContext("2d").getImageData(0, 0, copy.width, copy.height).data, kinds = new Set();
    let count = 0;
    for (let n = 0; n !== colours.length; n += 4)
      if (colours[n + 3]) { ++count; kinds.add(colours[n] * 65536 + colours[n + 1] * 256 + colours[n + 2]); }
    return {share: 4 * count / colours.length, colours: kinds.size,
            text: document.querySelector(".viewer-count").textContent};
  };
  const set = (control, value) => { control.value = value; control.dispatchEvent(new Event("input")); };
  seen.whole = await pixels();
  const canvas = document.querySelector(".viewer-canvas"), box = canvas.getBoundingClientRect();
  const middle = {clientX: box.left + box.width / 2, clientY: box.top + box.height / 2};
  canvas.dispatchEvent(new MouseEvent("click", middle));
  seen.particle = document.querySelector(".viewer-particle").textContent;
  seen.rows = all(".viewer-particle tr").map(row => row.lastChild.textContent);
  const [field, axis] = all(".viewer-controls select"), [time, cut] = all(".viewer-controls input[type=range]");
  set(axis, 1);
  set(cut, 0.5);
  seen.cut = await pixels();
  set(axis, 0);
  set(time, 0);
  all(".viewer-controls input[type=checkbox]")[0].click();
  seen.intact = await pixels();
  const place = document.createElement("pre");
  place.id = "seen";
  place.textContent = JSON.stringify(seen);
  document.body.append(place);
})();
"""

# Keeps the matrix of the camera whenever it is placed anew, which a change of the window's size causes too.
WATCH_CAMERA = """
THREE.PerspectiveCamera.prototype.updateMatrixWorld = function(force) {
  THREE.Camera.prototype.updateMatrixWorld.call(this, force);
  window.cameraMatrix = this.matrixWorld.toArray();
};
window.dispatchEvent(new Event("resize"));
"""
# Keeps how many cubes were drawn.
COUNT_CUBES = """
const draw = WebGLRenderingContext.prototype.drawElements;
WebGLRenderingContext.prototype.drawElements = function(mode, count, ...more) {
  window.cubesDrawn = count / 18;
  draw.call(this, mode, count, ...more);
};
"""
# Draws displacements as they are, so that no gaps open.
TRUE_SIZE = """
(factor => {
  factor.value = 1;
  factor.dispatchEvent(new Event("input"));
  return new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)));
})(document.querySelector(".viewer-controls input[type=number]"))
"""
BOX = """(() => { const box = document.querySelector(".viewer-canvas").getBoundingClientRect();
  return [box.left, box.top, box.width, box.height, window.scrollX, window.scrollY]; })()"""


def read_with_vtk(file):
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(file))
    reader.Update()
    grid = reader.GetOutput()
    fields = {name: vtk_to_numpy(grid.GetPointData().GetArray(name)).astype(float) for name in FIELDS}
    return vtk_to_numpy(grid.GetPoints().GetData()).astype(float), fields


LOADING = ("src", "href", "srcset", "data", "action", "xlink:href")


class Links(html.parser.HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.links, self.scripts = [], 0
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        self.scripts += tag == "script"
        self.links += [value for name, value in attributes if name in LOADING]


def script(text, name):
    return re.search(f'id="{name}">([^<]*)</script>', text).group(1)


def complaints_about_numbers(text, folder, deformed):
    about = json.loads(script(text, "viewer-about"))
    numbers = np.frombuffer(base64.b64decode(script(text, "viewer-numbers"), validate=True), "<u2")

    def values(array):
        steps = numbers[array["at"]:array["at"] + about["particles"]]
        return array["min"] + steps * (array["max"] - array["min"]) / 65534

    def differ(array, truth):
        half_step = 0.5 * (array["max"] - array["min"]) / 65534
        return np.abs(values(array) - truth).max() > half_step * 1.0001 + 1e-12 * np.abs(truth).max()

    found = []
    files = sorted(folder.glob("frames_*.vtu"))
    if len(about["frames"]) != len(files) or len(files) != 7 or about["particles"] < 500:
        found.append(f"{len(about['frames'])} frames of {len(files)}, {about['particles']} particles")
    if abs(about["spacing"] - 1e-3) > 1e-6:
        found.append(f"spacing {about['spacing']}")
    for number, (frame, file) in enumerate(zip(about["frames"], files)):
        points, fields = read_with_vtk(file)
        rest = points - fields["displacement"] if deformed else points
        if abs(frame["time"] - number * 1e-6) > 0.3e-6:
            found.append(f"frame {number} at {frame['time']} s")
        for axis in range(3):
            error = np.abs(values(about["reference"][axis]) - rest[:, axis]).max()
            if error > 12e-3 / 65534 + 2e-9:  # a step, and the 7 digits of displaced points
                found.append(f"places at rest off by {error} m in frame {number}")
        for field in about["fields"]:
            truth = fields[field["name"]].reshape(about["particles"], -1)
            for part in range(truth.shape[1]):
                if differ(frame["arrays"][field["first"] + part], truth[:, part]):
                    found.append(f"{field['name']} {part} of frame {number}")
    units = {field["name"]: (field["unit"], len(field["components"])) for field in about["fields"]}
    if units != {"displacement": ("m", 3), "broken_open": ("", 1), "stress": ("Pa", 6)}:
        found.append(f"units {units}")
    return found


def complaints_about_browser(text, folder):
    browser = shutil.which("chromium")
    if browser is None:
        print("no chromium: what the page draws is not checked")
        return []
    page = folder / "visited.html"
    page.write_text(text.replace("</body>", f"<script>//<![CDATA[\n{VISITOR}\n//]]></script></body>"), encoding="utf-8")
    run = subprocess.run(
        [browser, "--headless=new", "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader",
         "--enable-unsafe-swiftshader", f"--user-data-dir={folder / 'browser'}", "--enable-logging=stderr",
         "--window-size=900,900", "--virtual-time-budget=5000", "--dump-dom", page.resolve().as_uri()],
        capture_output=True, text=True, timeout=500)
    found = [line for line in run.stderr.splitlines() if re.search("CONSOLE.*(error|exception|uncaught)", line, re.I)]
    dom = re.search('<pre id="seen">(.*?)</pre>', run.stdout, re.DOTALL)
    if dom is None:
        return found + ["the page does not run to its end", run.stderr[-2000:]]
    seen = json.loads(html.unescape(dom.group(1)))
    whole, cut, intact = seen["whole"], seen["cut"], seen["intact"]
    if not 0.02 < whole["share"] < 0.9 or whole["colours"] < 20:
        found.append(f"the whole body fills {whole['share']:.3f} of the picture with {whole['colours']} colours")
    shown = {name: int(re.search(r"(\d+) of \d+ particles", seen[name]["text"]).group(1))
             for name in ("whole", "cut", "intact")}
    if not 0.4 < shown["cut"] / shown["whole"] < 0.6 or cut["share"] <= 0:
        found.append(f"shown: {shown}")
    if shown["intact"] != 0 or intact["share"] != 0:  # no spring is broken in the first frame
        found.append(f"intact particles of the first frame are shown: {shown}")
    # The values of the particle in the middle are those that VTK reads.
    _, fields = read_with_vtk(sorted(folder.glob("frames_*.vtu"))[-1])
    met = re.match(r"Particle (\d+) ", seen["particle"])
    if met is None:
        return found + ["a click meets nothing"]
    particle = int(met.group(1))
    displacement, stress = fields["displacement"], fields["stress"]
    truth = [np.linalg.norm(displacement[particle]), *displacement[particle], fields["broken_open"][particle],
             *stress[particle]]
    scales = [np.abs(displacement).max()] * 4 + [1] + [np.abs(stress).max()] * 6
    for text_shown, value, scale in zip(seen["rows"], truth, scales, strict=True):
        if abs(float(text_shown.split()[0]) - value) > 2e-3 * scale:
            found.append(f"particle {particle}: {text_shown} instead of {value}")
    return found


def read_png(png, file):
    """Returns the colours of a picture as an array of rows, columns and three parts."""
    file.write_bytes(png)
    reader = vtkPNGReader()
    reader.SetFileName(str(file))
    reader.Update()
    image = reader.GetOutput()
    colours = vtk_to_numpy(image.GetPointData().GetScalars())
    return colours.reshape(image.GetDimensions()[1], image.GetDimensions()[0], -1)[::-1, :, :3].astype(int)


def matrix_of(page):
    matrix = np.array(page.run("window.cameraMatrix")).reshape(4, 4)
    return matrix[:3, :3], matrix[3, :3]  # the axes of the camera as rows, and its place


def complaints_about_pointer(page_file, folder):
    """Drags the pointer over the body as a person does: the camera turns by the angle that the drag means, and the
    picture of the page shows it."""
    right, down, per_pixel = 90, 35, 0.008  # pixels; radians, as in camera.js
    found = []
    all_drawn = folder / "all_drawn.html"
    text = page_file.read_text(encoding="utf-8")
    all_drawn.write_text(text.replace("data.neighbours = neighboursOf(data);", "data.neighbours = null;"),
                         encoding="utf-8")
    with chromium.Page(folder / "pointer") as page:
        page.before_pages(COUNT_CUBES)
        page.open(all_drawn.resolve().as_uri())
        page.run(TRUE_SIZE)
        left, top, width, height, _, scrolled = page.run(BOX)
        complete = read_png(page.picture(clip=(left, top + scrolled, width, height)), folder / "complete.png")
        of_all = page.run("window.cubesDrawn")
        page.open(page_file.resolve().as_uri())
        page.run(TRUE_SIZE)
        # A picture of the whole page shows the body, although it was never in the window.
        left, top, width, height, _, scrolled = page.run(BOX)
        clip = (left, top + scrolled, width, height)
        never_seen = read_png(page.picture(clip=clip), folder / "never_seen.png")
        if top < 900 or len(np.unique(never_seen.reshape(-1, 3), axis=0)) < 20:
            found.append("the picture of the whole page has no body in it")
        # Particles that others hide are not drawn, and the picture is the same but for gaps of a tenth of an edge.
        drawn, changed = page.run("window.cubesDrawn"), (complete != never_seen).any(axis=2).mean()
        if not 0 < drawn < of_all or changed > 0.01:
            found.append(f"{drawn} of {of_all} cubes are drawn, and {changed:.4f} of the picture are not the same")
        page.run('document.querySelector(".viewer-canvas").scrollIntoView()')
        page.run(WATCH_CAMERA)
        left, top, width, height, _, scrolled = page.run(BOX)
        clip = (left, top + scrolled, width, height)
        axes, place = matrix_of(page)
        before = read_png(page.picture(clip=clip), folder / "before.png")
        start = (left + width / 2, top + height / 2)
        page.drag(start, (start[0] + right, start[1] + down))
        page.run("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")
        after = read_png(page.picture(clip=clip), folder / "after.png")
        turned_axes, turned_place = matrix_of(page)

        # The camera looks along -z of its axes; the height of its view above the horizon is that of the z axis.
        def angles(of):
            return np.arctan2(of[2][1], of[2][0]), np.arcsin(of[2][2])

        change = [now - then for now, then in zip(angles(turned_axes), angles(axes))]
        if np.abs(np.array(change) - [-per_pixel * right, per_pixel * down]).max() > 2 * per_pixel:
            found.append(f"a drag by {right}, {down} pixels turns the body by {change} radians")
        # The body is around the origin: the camera keeps its distance.
        if abs(np.linalg.norm(turned_place) / np.linalg.norm(place) - 1) > 0.05:
            found.append(f"the camera goes from {place} to {turned_place}")
        differing = (before != after).any(axis=2)
        if not 0.02 < differing.mean() < 0.9 or differing[:20, :20].any():
            found.append(f"{differing.mean():.3f} of the picture differ after the drag")
        if page.run('document.querySelector(".viewer-particle").textContent') != "":
            found.append("a drag chooses a particle")
        page.mouse("mousePressed", *start)
        page.mouse("mouseReleased", *start, buttons=0)
        if not page.run('document.querySelector(".viewer-particle").textContent').startswith("Particle "):
            found.append("a click chooses no particle")
        found += [f"the page complains: {json.dumps(one)[:500]}" for one in page.complaints()]
    return found


def main():
    program, three, folder = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    (folder / "scene.json").write_text(json.dumps(SCENE), encoding="utf-8")

    def run(name, *options):
        settings = [word for option in options for word in ("--set", option)]
        subprocess.run([program, "run", folder / "scene.json", "--quiet", "--out", folder / name, *settings],
                       check=True, capture_output=True)
        return subprocess.run([program, "report", folder / name, "--interactive"], capture_output=True, text=True)

    found = []
    for codec, deformed in (("lz4", False), ("zlib", True), ("none", False)):
        made = run(codec, f'/pipeline/4/codec="{codec}"', f"/pipeline/4/deformed={json.dumps(deformed)}")
        if not three.is_file():
            is_written = (folder / codec / "report.html").exists()
            refused = made.returncode == 4 and "libjs-three" in made.stderr and not is_written
            print("no three.js: only the refusal is checked" if refused else f"no refusal without three.js: {made}")
            return 0 if refused else 1
        if made.returncode != 0:
            print(made.stderr)
            return 1
        text = (folder / codec / "report.html").read_text(encoding="utf-8")
        xml.etree.ElementTree.fromstring(text)  # raises an error if the page is not well-formed
        links = Links(text)
        found += [f"asks for {link[:60]}" for link in links.links if not link.startswith("data:")]
        if links.scripts != 4 or "Copyright (c) 2010-2019 three.js authors" not in text:
            found.append(f"{links.scripts} scripts, or no licence")
        found += [f"{codec}: {fault}" for fault in complaints_about_numbers(text, folder / codec, deformed)]
    found += complaints_about_browser((folder / "lz4" / "report.html").read_text(encoding="utf-8"), folder / "lz4")
    if chromium.PROGRAM is not None:
        found += complaints_about_pointer(folder / "lz4" / "report.html", folder / "lz4")

    # A run without its frames, and a frame that is cut off, are refused.
    (folder / "zlib" / "report.html").unlink()
    last = folder / "zlib" / "frames_000006.vtu"
    last.write_bytes(last.read_bytes()[:last.stat().st_size // 2])
    collection = folder / "zlib" / "frames.pvd"
    for fault, spoil in (("a frame that is cut off", lambda: None), ("no frames", collection.unlink)):
        spoil()
        refused = subprocess.run([program, "report", folder / "zlib", "--interactive"], capture_output=True, text=True)
        if refused.returncode != 2 or (folder / "zlib" / "report.html").exists():
            found.append(f"{fault}: exit code {refused.returncode}")
    print("\n".join(found) or "the page holds the frames")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
