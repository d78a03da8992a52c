"""Collects the pages of the site in a folder for Sphinx.

The pages are those of the project as they are. Three pages are added: the gallery and the list of components, to which
other pages link as folders, and the list of the headers.
"""
import re
import shutil

TOP = ("README.md", "CONTRIBUTING.md", "CHANGELOG.md", "CITATION.cff")
FILES = (".md", ".png", ".svg", ".ipynb", ".json", ".csv", ".py")
# Sections of the navigation: title, and how the names of its pages begin.
SECTIONS = (("Guide", "docs/guide/"), ("Tutorials", "docs/tutorials/"), ("Notebooks", "docs/notebooks/"),
            ("Gallery", "docs/gallery/"), ("Components", "docs/components/"), ("Headers", "headers"),
            ("Theory", "docs/theory/"), ("Project", ""))
LINK = re.compile(r"\]\(([^)\s]+)\)")


def version(root):
    """Returns the version that CMakeLists.txt states."""
    return re.search(r"project\(Hyperlattice VERSION (\S+)", (root / "CMakeLists.txt").read_text())[1]


def title(page):
    """Returns the first heading of a page."""
    return re.search(r"^# (.+)$", page.read_text(encoding="utf-8"), re.M)[1]


def first_picture(page):
    """Returns the file name of the first picture of a page."""
    return re.search(r"!\[[^]]*\]\(([^)\s]+)\)", page.read_text(encoding="utf-8"))[1]


def gallery(root):
    """Returns the page with a small picture and the title of each scene of the gallery."""
    cards, members = [], []
    for page in sorted((root / "docs/gallery").glob("*/README.md"), key=title):
        name = page.parent.name
        cards.append(f"[![{title(page)}]({name}/{first_picture(page)}) {title(page)}]({name}/README.md)")
        members.append(f"docs/gallery/{name}/README")
    return ("# Gallery\n\nEach scene has a page with pictures, the truth, and a table of errors.\n\n"
            ":::{container} gallery\n" + "\n\n".join(cards) + "\n:::\n" + contents(members))


def components(root):
    """Returns the page with a table of all components."""
    rows, members = [], []
    for page in sorted((root / "docs/components").glob("*.md")):
        summary = re.search(r"^# .+\n+([^\n#]+)", page.read_text(encoding="utf-8"))
        rows.append(f"| [{page.stem}]({page.name}) | {summary[1] if summary else ''} |")
        members.append(f"docs/components/{page.stem}")
    return ("# Components\n\nWhat a scene can name, as the program documents it.\n\n"
            "| component | meaning |\n|---|---|\n" + "\n".join(rows) + "\n" + contents(members))


def headers(root):
    """Returns the page with a table of all headers, which leads to the reference that Doxygen makes."""
    rows = []
    for folder in ("core/sdk/include", "core/kernels/include"):
        for file in sorted((root / folder).rglob("*.hpp")):
            comment = re.match(r"(?:// ?\S.*\n)*", file.read_text(encoding="utf-8"))[0]
            words = re.sub(r"^// ", "", comment, flags=re.M)
            sentence = re.split(r"(?<=\.)\s|\n\s", words)[0].replace("\n", " ").replace("|", "\\|").replace("<", "&lt;")
            link = file.name.replace("_", "__").replace(".", "_8") + ".html"
            name = file.relative_to(root / folder)
            rows.append(f'| <a href="sdk/{link}"><code>{name}</code></a> | {sentence} |')
    return ('# Headers that a plugin may include\n\n<a href="sdk/index.html">The reference</a> has all types and '
            "functions of these headers. [Plugins](docs/guide/plugins.md) is the page to begin with.\n\n"
            "| header | content |\n|---|---|\n" + "\n".join(rows) + "\n")


def navigation(root):
    """Returns the contents of the site. Pages come in the order of the README's last links to them, others follow."""
    named = LINK.findall((root / "README.md").read_text(encoding="utf-8"))
    places = {page: place for place, page in enumerate(named)}
    found = [*TOP[1:3]]
    for pattern in ("docs/**/*.md", "docs/**/*.ipynb", "tests/*/README.md"):
        found += [str(page.relative_to(root)) for page in sorted(root.glob(pattern))]
    found.sort(key=lambda page: places.get(page, len(places)))
    found.append("headers.md")
    indexed = ("docs/gallery/", "docs/components/")
    text = ""
    for name, start in SECTIONS:
        members = [page for page in found if page.startswith(start)]
        found = [page for page in found if page not in members]
        if members:
            text += contents([start + "index"] if start in indexed else members, name)
    return text


def contents(members, name=None):
    """Returns the directive that puts these pages into the navigation."""
    lines = ["", "```{toctree}", ":hidden:", *([f":caption: {name}"] if name else []), ""]
    lines += ["/" + re.sub(r"\.(md|ipynb)$", "", page) for page in members]
    return "\n".join([*lines, "```", ""])


def linked(file):
    """Returns the text of a page of the project with its links as the site needs them."""
    text = file.read_text(encoding="utf-8")
    # A link to a folder leads to the page of the folder, and the README is the first page.
    text = re.sub(r"\]\(((?:[\w.]+/)*(?:components|gallery)/)\)", r"](\1index.md)", text)
    return re.sub(r"\]\(((?:\.\./)+)README\.md", r"](\1index.md", text)


def put(file, text):
    """Writes a file if its text changes, so that Sphinx reads again only what changed."""
    if not file.is_file() or file.read_text(encoding="utf-8") != text:
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")


def write(root, source):
    """Fills the folder `source` with the pages of the project in `root`, and removes what is no longer a page."""
    files = [*(root / name for name in TOP[1:]), *root.glob("tests/*/README.md")]
    files += [file for file in (root / "docs").rglob("*") if file.suffix in FILES and file.parent != root / "docs/site"]
    wanted = {str(file.relative_to(root)): file for file in files}
    texts = {"docs/gallery/index.md": gallery(root), "docs/components/index.md": components(root),
             "headers.md": headers(root), "index.md": linked(root / "README.md") + navigation(root)}
    texts |= {name: linked(file) for name, file in wanted.items() if file.suffix == ".md"}
    for file in list(source.rglob("*")):
        if file.is_file() and str(file.relative_to(source)) not in {**wanted, **texts}:
            file.unlink()
    for name, text in texts.items():
        put(source / name, text)
    for name, file in wanted.items():
        copy = source / name
        if name not in texts and (not copy.is_file() or copy.stat().st_mtime != file.stat().st_mtime):
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(file, copy)
