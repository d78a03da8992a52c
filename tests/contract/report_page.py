"""Other programs check the page of `hyperlattice report`: an XML parser and an HTML parser. The
page must be well-formed, hold the numbers of summary.json, run no script, and load nothing from
outside. Arguments: the program, and a working folder, which is deleted and made anew."""
import base64
import html.parser
import json
import pathlib
import shutil
import subprocess
import sys
import xml.etree.ElementTree

TITLE = 'Is 1 < 2 & "quoted" \'so\' </title><script>alert(1)</script> \u03bd \u0007'

SCENE = {
    "format": "hyperlattice/1",
    "title": TITLE,
    "pipeline": [
        {"type": "lattices.cubic", "spacing": "1 mm", "shape": {"hollow_sphere": {"inner_radius": "4 mm", "outer_radius": "8 mm"}}},
        {"type": "materials.elastic", "young": "10 GPa", "poisson": 0.1, "density": 2500, "membrane": "I-m",
         "failure": {"type": "failures.elongation", "limit": "1e-3 mm"}},
        {"type": "loads.blast", "on": "inner_surface", "peak": "100 MPa", "rise": "2 us", "fall": "5 us"},
        {"type": "solvers.explicit", "end_time": "10 us"},
        {"type": "probes.line", "name": "axis", "start": [0, 0, 0], "end": ["7 mm", 0, 0], "points": 5, "between": "nearest"},
        {"type": "writers.picture", "every": "0.5 us", "width": 64, "height": 64}]}


class Page(html.parser.HTMLParser):
    """The contents of a page: elements, links, and text without the style sheet."""

    def __init__(self, text):
        super().__init__()
        self.elements, self.links, self.handlers, self.texts, self.open = [], [], [], [], []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attributes):
        self.elements.append(tag)
        self.open.append(tag)
        for name, value in attributes:
            if name in ("src", "href", "srcset", "data", "action", "xlink:href", "style"):
                self.links.append(value)
            if name.startswith("on"):
                self.handlers.append(name)

    def handle_startendtag(self, tag, attributes):
        self.handle_starttag(tag, attributes)
        self.open.pop()

    def handle_endtag(self, tag):
        assert self.open and self.open[-1] == tag, f"</{tag}> closes {self.open[-3:]}"
        self.open.pop()

    def handle_data(self, data):
        if "style" not in self.open:
            self.texts.append(data)


def complaints_about(text, summaries, title):
    found = []
    xml.etree.ElementTree.fromstring(text)  # raises an error if the page is not well-formed
    page = Page(text)
    words = "".join(page.texts)
    if page.open:
        found.append(f"left open: {page.open}")
    for word in ("http://", "https://", "@import", "url(", "file:"):
        if word in text:
            found.append(f"the page names {word}")
    found += [f"asks for {link[:60]}" for link in page.links if not link.startswith("data:")]
    found += [f"element {name}" for name in page.elements if name in ("script", "link", "iframe", "object", "embed", "base", "form")]
    found += [f"runs a script {name}" for name in page.handlers]
    for summary in summaries:
        wanted = [title, summary["state_hash"], f"{summary['particles']:,}".replace(",", " "), f"{summary['springs']:,}".replace(",", " "),
                  summary["status"], f"{1e6 * summary['end_time']:.4g} \u00b5s"]
        wanted += [plugin["path"] for plugin in summary["plugins"]]
        found += [f"no {what!r} in the page" for what in wanted if what not in words]
    if "nan" in " ".join(part for part in text.split('d="')[1:]).split('"')[0]:
        found.append("a curve with a place that is none")
    for link in page.links:
        kind, data = link.split(",", 1)
        if kind == "data:image/png;base64" and not base64.b64decode(data, validate=True).startswith(b"\x89PNG"):
            found.append("a picture that is no PNG")
    return found, page


def main():
    program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    (folder / "scene.json").write_text(json.dumps(SCENE), encoding="utf-8")
    runs = ["one", 'two & "<b>"']
    for name, poisson in zip(runs, (0.1, 0.2)):
        subprocess.run([program, "run", folder / "scene.json", "--quiet", "--out", folder / name, "--set", f"/pipeline/1/poisson={poisson}"],
                       check=True, capture_output=True)
    summaries = [json.loads((folder / name / "summary.json").read_text(encoding="utf-8")) for name in runs]
    shown_title = TITLE.replace("\u0007", "\ufffd")  # XML has no such character

    subprocess.run([program, "report", folder / runs[0]], check=True, capture_output=True)
    found, page = complaints_about((folder / runs[0] / "report.html").read_text(encoding="utf-8"), summaries[:1], shown_title)
    pictures = [link for link in page.links if link.startswith("data:image/png")]
    written = sorted((folder / runs[0]).glob("picture_*.png"))
    if len(written) <= 6 or len(pictures) != 6:
        found.append(f"{len(pictures)} pictures of {len(written)}: expected 6")
    for n, place in ((0, "first"), (-1, "last")):
        if pictures and base64.b64decode(pictures[n].split(",", 1)[1]) != written[n].read_bytes():
            found.append(f"the {place} picture is not the writer's {place}")
    # Plots: energies, balance, broken springs, and the probe's three components.
    if page.elements.count("svg") != 6:
        found.append(f"{page.elements.count('svg')} plots")

    both = [folder / name for name in runs]
    subprocess.run([program, "report", *both, "--out", folder / "both.html"], check=True, capture_output=True)
    more, page = complaints_about((folder / "both.html").read_text(encoding="utf-8"), summaries, shown_title)
    found += more
    # Six plots for each of two runs, and common plots: four energies, the balance, open and closed
    # failures, three components.
    if page.elements.count("svg") != 2 * 6 + 4 + 1 + 2 + 3:
        found.append(f"{page.elements.count('svg')} plots of two runs")
    if "/pipeline/1/poisson" not in "".join(page.texts) or runs[1] not in "".join(page.texts):
        found.append("nothing of what differs")
    print("\n".join(found) or "a page for people and machines")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
