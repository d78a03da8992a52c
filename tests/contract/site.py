"""Builds the site of the documentation and checks that nothing is missing in it.
Arguments: the project's folder, a folder for the site."""
import pathlib
import subprocess
import sys
import tempfile

root, site = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
sys.dont_write_bytecode = True
sys.path.insert(0, str(root / "docs/site"))
import links  # noqa: E402

built = subprocess.run([root / "docs/build_site", site], capture_output=True, text=True)
assert built.returncode == 0, built.stdout + built.stderr

pages = [page for pattern in ("docs/**/*.md", "docs/**/*.ipynb") for page in root.glob(pattern)]
missing = [page for page in pages if not (site / page.relative_to(root)).with_suffix(".html").is_file()]
assert len(pages) > 50 and not missing, f"pages without a page of the site: {missing}"

gallery = (site / "docs/gallery/index.html").read_text()
for scene in root.glob("docs/gallery/*/README.md"):
    assert f'href="{scene.parent.name}/README.html"' in gallery, f"{scene} has no picture in the gallery"
assert gallery.count("<img") >= len(list(root.glob("docs/gallery/*/README.md")))

index = (site / "searchindex.js").read_text()
assert "microstructur" in index and "docs/guide/scenes" in index, "the search does not know the pages"
assert (site / "sdk/structhyperlattice_1_1SpringFacts.html").is_file(), "the reference has no SpringFacts"

with tempfile.TemporaryDirectory() as folder:
    page = pathlib.Path(folder) / "page.html"
    page.write_text('<script src="//example.org/a.js"></script><a href="nowhere.html">a</a> <a href="page.html">b</a>')
    found = links.faults(page.parent)
    assert len(found) == 2 and "from the network" in found[0] and "nowhere.html" in found[1], found
print(built.stdout.strip())
