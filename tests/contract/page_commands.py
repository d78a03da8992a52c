"""Runs the commands of the pages.
Arguments: the program, the project's folder, and `guide` or `gallery`.

`guide`: README, docs/guide, docs/tutorials. Each page has a folder with the README's bar as scene.json. A block of
code is a file if the paragraph before it says "as `NAME`". A block without a language, or of `sh`, has commands, which
bash runs in the order of the page. They must succeed. A comment before a block, <!-- not run: why -->, leaves it out.

`gallery`: the bodies of these pages are large, and other tests run them at small sizes. `run` is replaced by `plan`,
and the files that other commands name must exist.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

program, source = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
kind = sys.argv[3]
BLOCK = re.compile(r"^```(\w*)\n(.*?)^```$", re.M | re.S)
NAMED = re.compile(r"\bas\s+`([\w.-]+\.(?:json|cpp|py|csv))`")
LEFT_OUT = re.compile(r"<!-- not run: (.+) -->\s*$")
# A program that stands for `hyperlattice` on the pages of the gallery.
PLANNER = """#!/bin/bash
command=$1 scene=$2 settings=()
shift 2
while [ $# -gt 0 ]; do
  if [ "$1" = --set ]; then settings+=(--set "$2"); fi
  shift
done
case $command in
  run) exec "{program}" plan "$scene" "${{settings[@]}}" ;;
  study) exec test -f "$scene" ;;
  *) echo "no such command on the pages of the gallery: $command"; exit 1 ;;
esac
"""


# Components that not every build has.
names = subprocess.run([program, "plugins", "--names"], check=True, capture_output=True, text=True).stdout.split()
HAS_MPI = "engines.mpi" in names and shutil.which("mpirun") is not None
HAS_RENDER = "writers.render" in names


def missing(commands):
    """Returns what commands need that is not here, or an empty text."""
    if not HAS_MPI and re.search(r"^mpirun ", commands, re.M):
        return "no mpirun here, or no engines.mpi"
    return "no writers.render here" if not HAS_RENDER and "/figure.json" in commands else ""


def script_of(page):
    """Returns the script of a page, the number of its blocks with commands, and the blocks that are left out."""
    text, files, commands, left_out = page.read_text(encoding="utf-8"), [], [], []
    for block in BLOCK.finditer(text):
        before = text[:block.start()].rstrip("\n")
        line = text.count("\n", 0, block.start()) + 1
        paragraph = before[before.rfind("\n\n") + 1:]
        skipped, name = LEFT_OUT.search(before), NAMED.findall(paragraph)
        if skipped:
            left_out.append(f"{page.relative_to(source)}:{line}: {skipped[1]}")
        elif name:
            files.append(f"cat > {name[-1]} <<'END OF FILE'\n{block[2]}END OF FILE\n")
        elif block[1] in ("", "sh") and missing(block[2]):
            left_out.append(f"{page.relative_to(source)}:{line}: {missing(block[2])}")
        elif block[1] in ("", "sh"):
            commands.append(f"echo '== {page.relative_to(source)}:{line}'\n{block[2]}")
    return "set -eu -o pipefail\n" + "".join(files + commands), len(commands), left_out


def prepare(folder):
    """Makes the folders and programs that the pages take for granted. Returns the environment."""
    (folder / "home").mkdir()
    (folder / "work/build/release/bin").mkdir(parents=True)
    (folder / "bin").mkdir()
    for place in (folder / "bin", folder / "work/build/release/bin"):
        if kind == "guide":
            (place / "hyperlattice").symlink_to(program)
        else:
            (place / "hyperlattice").write_text(PLANNER.format(program=program))
            (place / "hyperlattice").chmod(0o755)
    if kind == "gallery":
        (folder / "bin/python3").write_text('#!/bin/sh\nexec test -f "$1"\n')
        (folder / "bin/python3").chmod(0o755)
        (folder / "work/docs").symlink_to(source / "docs")
    else:
        (folder / "bin/python3").symlink_to("/usr/bin/python3")  # has the modules of Debian's packages
        scene = BLOCK.search((source / "README.md").read_text(encoding="utf-8"), 0)
        while '"format"' not in scene[2]:
            scene = BLOCK.search(scene.string, scene.end())
        (folder / "work/scene.json").write_text(scene[2].replace('"0.3 ms"', '"3 us"'))
    own = ("HYPERLATTICE_PLUGIN_PATH", "XDG_CACHE_HOME")
    environment = {key: value for key, value in os.environ.items() if key not in own}
    environment |= {"PATH": f"{folder}/bin:{os.environ['PATH']}", "HOME": str(folder / "home"),
                    "OMP_WAIT_POLICY": "passive"}
    # mpirun as root, and with more processes than processors.
    environment |= {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
                    "OMPI_MCA_rmaps_base_oversubscribe": "1"}
    return environment


if kind == "guide":
    # The code of docs/guide/python.md has a test of its own.
    pages = [source / "README.md", *sorted(source.glob("docs/guide/*.md")), *sorted(source.glob("docs/tutorials/*.md"))]
else:
    pages = sorted(source.glob("docs/gallery/*/README.md"))
failed, total, without = 0, 0, []
for page in pages:
    script, blocks, left_out = script_of(page)
    without += left_out
    total += blocks
    if not blocks:
        continue
    with tempfile.TemporaryDirectory() as name:
        environment = prepare(pathlib.Path(name))
        done = subprocess.run(["bash", "-c", script], cwd=f"{name}/work", env=environment, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode:
        failed += 1
        print(f"{page.relative_to(source)}: exit code {done.returncode}\n{done.stdout[-1500:]}")
assert total > 10, "the pages were not read"
for sentence in without:
    print(f"left out: {sentence}")
print(f"{len(pages)} pages, {total} blocks of commands, {failed} pages failed")
sys.exit(1 if failed else 0)
