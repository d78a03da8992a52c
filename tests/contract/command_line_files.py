"""Checks the manual pages and the completion of shells that the program prints.
Arguments: the program; the folder of the pages and scripts of the build.

mandoc must find no fault in a page, and each command has one. bash and fish must propose what can follow the words of a
line, and zsh must read its script. A shell or mandoc that is not installed is left out, but not bash.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

program, manual = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
environment = {**os.environ, "PATH": f"{program.parent}:{os.environ['PATH']}", "HOME": "/nonexistent"}


def output(*command, **more):
    done = subprocess.run(command, capture_output=True, text=True, env=environment, **more)
    assert done.returncode == 0, f"{command}: {done.stdout}{done.stderr}"
    return done.stdout


usage = output(program, "--help")
commands = re.findall(r"^  (\w+) ", usage[usage.index("Subcommands:"):], re.M)
assert len(commands) >= 10, usage

# Manual pages.
pages = {page.name for page in manual.glob("*.1")}
assert pages == {"hyperlattice.1", *(f"hyperlattice-{command}.1" for command in commands)}, pages
for command in commands:
    page = (manual / f"hyperlattice-{command}.1").read_text().replace("\\-", "-")
    for option in re.findall(r"^  (?:-\w,)?--([\w-]+)", output(program, command, "--help"), re.M):
        assert f"\\fB--{option}\\fR" in page, f"the page of {command} has no --{option}"
if shutil.which("mandoc"):
    for page in sorted(manual.glob("*.1")):
        output("mandoc", "-Tlint", "-Wstyle", page)


def from_bash(line, folder):
    """Returns what bash proposes for the last word of a line."""
    words = line.split(" ")
    script = (f"source {manual}/completion.bash || exit; COMP_WORDS=({' '.join(repr(word) for word in words)}); "
              f"COMP_CWORD={len(words) - 1}; _hyperlattice; printf '%s\\n' \"${{COMPREPLY[@]}}\"")
    return set(output("bash", "-c", script, cwd=folder).split())


def from_fish(line, folder):
    """Returns what fish proposes for the last word of a line."""
    script = f"source {manual}/completion.fish; complete -C '{line}'"
    lines = output("fish", "--no-config", "-c", script, cwd=folder).splitlines()
    return {proposed.split("\t")[0].rstrip("/") for proposed in lines}


EXPECTED = {
    "hyperlattice ": set(commands),
    "hyperlattice pl": {"plan", "plugins"},
    "hyperlattice run --over": {"--overwrite"},
    "hyperlattice plugins loads.bl": {"loads.blast"},
    "hyperlattice analyze --lattice lattices.b": {"lattices.bcc"},
    "hyperlattice analyze --membrane I": {"I", "II", "III", "IV", "I-m"},
    "hyperlattice report bar": {"bar_out"},
    "hyperlattice run --out bar": {"bar_out"},
    "hyperlattice plan bar": {"bar.json", "bar_out"},
    "hyperlattice completion ": {"bash", "zsh", "fish"},
    "hyperlattice manual hyperlattice-st": {"hyperlattice-study"},
}
with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    (folder / "bar_out").mkdir()
    (folder / "bar.json").touch()
    shells = [from_bash] + ([from_fish] if shutil.which("fish") else [])
    for complete in shells:
        for line, expected in EXPECTED.items():
            found = complete(line, folder)
            assert found == expected, f"{complete.__name__}: {line!r} gives {sorted(found)}, not {sorted(expected)}"
    assert from_bash("hyperlattice run --out = bar", folder) == {"bar_out"}
if shutil.which("zsh"):
    output("zsh", "-n", manual / "completion.zsh")

wrong = subprocess.run([program, "completion", "bsh"], capture_output=True, text=True)
assert wrong.returncode == 2 and "did you mean 'bash'?" in wrong.stderr, wrong.stderr
print(f"{len(pages)} manual pages; {len(EXPECTED)} lines completed by {len(shells)} shells")
