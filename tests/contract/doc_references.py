"""Finds dead references in the pages of the project. Prints a line for each, "file:line: fault",
and exits with 1 if any exists.
Argument: the project's folder.

- A relative link points to a file or folder of the project, and its anchor to a heading of that
  page.
- A path in code (in backticks, or in a block) that begins with a folder of the project exists. `*`,
  `{a,b}` and `<name>` stand for any name that fits.
- A source file named in backticks without its folder, `law.hpp` or `kernels/simd.hpp`, exists
  somewhere in the project.
- A component, `family.name`, exists as a folder; those named python, in apps/python/functions. Names that begin with my_, and the name mine,
  belong to the reader, and so do their files.
"""
import itertools
import pathlib
import re
import sys

FOLDERS = ("core", "apps", "plugins", "lattices", "materials", "io", "tests", "docs", "cmake")
FAMILIES = {"lattices": "lattices", "materials": "materials", "failures": "materials/failures", "loads": "plugins/loads",
            "solvers": "plugins/solvers", "probes": "plugins/probes", "writers": "io/writers"}
SOURCES = ("hpp", "cpp", "py", "cmake")
ENDINGS = {*SOURCES, "csv", "json", "jsonc", "md", "txt", "so", "pvd", "vtu", "svg", "png"}  # failures.csv is a file

FENCE = re.compile(r"^(```+|~~~+).*?^\1[ \t]*$", re.M | re.S)
INDENTED = re.compile(r"(?<=\n\n)(?: {4,}\S[^\n]*\n|\n)+")
INLINE = re.compile(r"(?<!`)(`+)(?!`)((?:(?!\n\n).)+?)(?<!`)\1(?!`)", re.S)
LINK = re.compile(r"\]\(\s*<?([^)\s>]+)>?(?:\s+\"[^\"]*\")?\s*\)")
DEFINITION = re.compile(r"^ {0,3}\[[^\]]+\]:\s+<?(\S+?)>?\s*$", re.M)
HEADING = re.compile(r"^ {0,3}#{1,6}\s+(.+?)\s*#*\s*$", re.M)
PATH = re.compile(rf"(?<![\w./<>{{}}*~-])(?:{'|'.join(FOLDERS)})/[\w./<>{{}},*+-]*")
SOURCE = re.compile(rf"(?<![\w./<>{{}}*-])(?!(?:{'|'.join(FOLDERS)})/)\w[\w./-]*\.(?:{'|'.join(SOURCES)})(?![\w.*])")
COMPONENT = re.compile(rf"(?<![\w./])({'|'.join(FAMILIES)})\.([a-z][a-z0-9_]*)")

root = pathlib.Path(sys.argv[1]).resolve()
breaches, seen = [], dict.fromkeys(("links", "anchors", "paths", "sources", "components"), 0)


def is_own(name):
    return name.startswith("my_") or name.split(".")[0] == "mine"


def blank(match):
    """Replaces a match by spaces and keeps its line breaks."""
    return re.sub(r"[^\n]", " ", match.group())


def variants(path):
    """Lists the patterns that a path such as `a/{b,c}/<d>` stands for."""
    parts = [part[1:-1].split(",") if part.startswith("{") else [part] for part in re.split(r"(\{[^}]*\})", re.sub(r"<[^>]*>", "*", path)) if part]
    return ["".join(choice) for choice in itertools.product(*parts)]


def anchors(page, known={}):
    if page not in known:
        known[page], counts = set(), {}
        for heading in HEADING.finditer(FENCE.sub(blank, page.read_text(encoding="utf-8"))):
            text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading[1])
            slug = re.sub(r"[^\w\- ]", "", text.lower()).replace(" ", "-")
            count = counts[slug] = counts.get(slug, -1) + 1
            known[page].add(f"{slug}-{count}" if count else slug)
    return known[page]


def check_link(page, target):
    if re.match(r"[a-z][a-z0-9+.-]*:", target):
        return None
    path, _, anchor = target.partition("#")
    place = (root if path.startswith("/") else page.parent) / path.lstrip("/") if path else page
    seen["links"] += 1
    if not place.resolve().is_relative_to(root) or not place.exists():
        return f"the link {target} points to nothing"
    if anchor and place.suffix == ".md":
        seen["anchors"] += 1
        if anchor not in anchors(place.resolve()):
            return f"the link {target} points to a heading that is not there"
    return None


def check_path(path):
    path = path.rstrip(".,:;")
    if any(is_own(part) for part in path.split("/")):
        return None
    seen["paths"] += 1
    missing = [one for one in variants(path) if not any(root.glob(one.rstrip("/")))]
    return f"{', '.join(missing)} does not exist" if missing else None


def check_source(name):
    if is_own(name.split("/")[-1]):
        return None
    seen["sources"] += 1
    return None if any(file.endswith("/" + name) for file in files) else f"no file is named {name}"


def check_component(family, name):
    if name in ENDINGS - {"csv", "vtu"} or f"{family}.{name}" == "failures.csv" or is_own(name):
        return None
    seen["components"] += 1
    if name == "python":  # the components that call Python functions are the sources of one plugin
        file = root / "apps/python/functions" / f"{family.removesuffix('s')}.hpp"
    else:
        file = root / FAMILIES[family] / name / "CMakeLists.txt"
    return None if file.is_file() else f"there is no component {family}.{name}"


def check(page):
    text = page.read_text(encoding="utf-8")

    def note(offset, what):
        if what:
            breaches.append((page.relative_to(root), text.count("\n", 0, offset) + 1, what))

    blocks = list(FENCE.finditer(text))
    rest = FENCE.sub(blank, text)
    indented = list(INDENTED.finditer(rest))
    rest = INDENTED.sub(blank, rest)
    inline = list(INLINE.finditer(rest))
    prose = INLINE.sub(blank, rest)

    for pattern in (LINK, DEFINITION):
        for link in pattern.finditer(prose):
            note(link.start(1), check_link(page, link[1]))
    for code in blocks + indented + inline:
        for path in PATH.finditer(text, code.start(), code.end()):
            note(path.start(), check_path(path.group()))
    for code in inline:
        for source in SOURCE.finditer(text, code.start(), code.end()):
            note(source.start(), check_source(source.group()))
    for component in COMPONENT.finditer(text):
        note(component.start(), check_component(*component.groups()))


files = [str(file) for folder in FOLDERS if folder != "tests" for file in (root / folder).rglob("*") if file.suffix[1:] in SOURCES]
pages = sorted(itertools.chain(root.glob("*.md"), *((root / folder).rglob("*.md") for folder in FOLDERS)))
for page in pages:
    check(page)
assert all(seen.values()), f"the pages were not read: {seen}"

for page, line, what in sorted(breaches):
    print(f"{page}:{line}: {what}")
if not breaches:
    print(f"{len(pages)} pages: " + ", ".join(f"{count} {what}" for what, count in seen.items()) + ", none of them dead")
sys.exit(1 if breaches else 0)
