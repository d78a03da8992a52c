"""Checks which parts of the project know which others. Prints a line for each breach,
"file:line: fault", and exits with 1 if any exists.
Argument: the project's folder.

- Core and the tools name no built-in component: the program gives them the components of their
  scenes.
- A room of core includes itself, the rooms that its target links (directly or through others), the
  SDK and the kernels. The kernels include the SDK; the SDK includes nothing else of the project.
  Any other folder of core is a library: it includes itself and the SDK, and the kernels if it
  links them.
- A tool under apps includes rooms, itself, and the tools that it links. No other part includes
  apps.
- A component's folder includes itself, the SDK and the kernels, never another component; the room
  quantities too, if it links that room for its expressions.
- A part that includes a library of core also links it: its CMakeLists.txt names
  hyperlattice_<library>.
"""
import pathlib
import re
import sys

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
FAMILIES = {"lattices": "lattices", "materials": "materials", "materials/failures": "failures", "io/writers": "writers",
            "plugins/loads": "loads", "plugins/solvers": "solvers", "plugins/probes": "probes"}  # by their folders

source = pathlib.Path(sys.argv[1]).resolve()
breaches = []


def breach(file, line, what):
    breaches.append(f"{file.relative_to(source)}:{line}: {what}")


def lines_below(folder):
    for file in sorted(folder.rglob("*")):
        if file.is_file():
            for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), 1):
                yield file, number, line


def projects(place):
    """Maps the name of each subfolder with a CMakeLists.txt to its path."""
    return {file.parent.name: file.parent for file in sorted((source / place).glob("*/CMakeLists.txt"))}


def recipe_of(folder):
    file = folder / "CMakeLists.txt"
    return re.sub(r"#.*", "", file.read_text(encoding="utf-8")) if file.is_file() else ""


def targets(place, function, key):
    """Maps each target of the folders under `place` to the targets that it links, directly or
    through others. hyperlattice_room(model ... ROOMS scene ...) links scene and everything that
    scene links."""
    direct = {}
    for name, folder in projects(place).items():
        for call in re.findall(rf"\b{function}\(([^)]*)\)", recipe_of(folder)):
            words, of = call.split(), ""
            if words[0] != name:
                breach(folder / "CMakeLists.txt", 1, f"the target {words[0]} in the folder {name}")
            direct[name] = set()
            for word in words[1:]:
                if word.isupper():
                    of = word
                elif of == key:
                    direct[name].add(word)

    def all_of(name, above=()):
        assert name not in above, f"{name} links itself: {above}"
        return direct[name].union(*(all_of(other, (*above, name)) for other in direct[name]))

    return {name: all_of(name) for name in direct}


def check_names(folder):
    for file, number, line in lines_below(folder):
        for found in TYPE.finditer(line):
            breach(file, number, f"names the component {found[1]}")


def check_includes(folder, who, may, roots):
    """Checks the includes of a folder. `may`: allowed first folders of paths; `roots`: folders
    where <hyperlattice/...> may be found."""
    may = may | {library for library in libraries if re.search(rf"\b(hyperlattice_|Hyperlattice::){library}\b", recipe_of(folder))}
    for file, number, line in lines_below(folder):
        if file.suffix not in (".hpp", ".cpp", ".h", ".c") or not (found := INCLUDE.match(line)):
            continue
        quoted, path = found[1] == '"', found[2]
        first = path.split("/")[0]
        if quoted:
            if not any(place.is_file() and place.resolve().is_relative_to(folder) for place in (file.parent / path, folder / path)):
                breach(file, number, f'{who} includes "{path}", which is not in its folder')
        elif first == "hyperlattice":
            if not any((root / path).is_file() for root in roots):
                breach(file, number, f"{who} includes <{path}>, which is not open to it")
        elif first in of_the_project and first not in may:
            breach(file, number, f"{who} includes <{path}>, but may not know {first}")


rooms, tools = targets("core", "hyperlattice_room", "ROOMS"), targets("apps", "hyperlattice_tool", "TOOLS")
components = {f"{family}.{name}": folder for place, family in FAMILIES.items() for name, folder in projects(place).items()}
starters = projects("plugins/starter")
libraries = {folder.name for folder in (source / "core").iterdir() if folder.is_dir()} - {"sdk", "kernels", *rooms}
of_the_project = {*rooms, *tools, *libraries, "core", "apps", "plugins", "materials", "lattices", "io"}
assert {"base", "model"} <= rooms["run"] and {"analyze", "contract"} <= set(tools), "the lists were not read"
assert set(FAMILIES.values()) == {name.split(".")[0] for name in components}, "the components were not found"

# The pattern excludes model.loads.force(time) and loads.force.x, which are no types.
NO_MEMBER = r"(?![\w(\[]|->|\.(?!so\b)[a-z])"
TYPE = re.compile(r"(?<![\w.])(" + "|".join(re.escape(name) for name in components) + ")" + NO_MEMBER)
sdk, kernels = source / "core/sdk/include", source / "core/kernels/include"
assert sdk.is_dir() and kernels.is_dir()

check_names(source / "core")
check_includes(source / "core/sdk", "the SDK", set(), [sdk])
check_includes(source / "core/kernels", "the kernels", set(), [kernels, sdk])
for name, linked in rooms.items():
    check_includes(source / "core" / name, f"the room {name}", {name, *linked}, [kernels, sdk])
for name in sorted(libraries):
    kernels_too = [kernels] if "hyperlattice_kernels" in recipe_of(source / "core" / name) else []
    check_includes(source / "core" / name, f"the library {name}", {name}, [*kernels_too, sdk])
for name, linked in tools.items():
    check_names(source / "apps" / name)
    check_includes(source / "apps" / name, f"the tool {name}", {*rooms, name, *linked}, [kernels, sdk])
for name, folder in {**components, **starters}.items():
    # Components with an expression as an option link the room of expressions.
    quantities = {"quantities"} if "hyperlattice_quantities" in recipe_of(folder) else set()
    check_includes(folder, name, quantities, [kernels, sdk])

print("\n".join(breaches) if breaches else f"{len(rooms)} rooms, {len(tools)} tools, {len(components)} components: each knows what it may")
sys.exit(1 if breaches else 0)
