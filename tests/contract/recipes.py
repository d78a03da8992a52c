"""Compares the recipes in .ci/recipes with the project.
Argument: the project's folder.

The versions are those of CMakeLists.txt. The container copies every folder that the build reads, and nothing that is
not there. package.py is Python with one package; meta.yaml is YAML.
"""
import ast
import pathlib
import re
import sys

root = pathlib.Path(sys.argv[1])
recipes = root / ".ci/recipes"
project = (root / "CMakeLists.txt").read_text()
version = re.search(r"project\(Hyperlattice VERSION (\S+)", project)[1]

# The container.
lines = (recipes / "Containerfile").read_text().replace("\\\n", " ").splitlines()
words = {line.split()[0] for line in lines if line and not line.startswith("#")}
assert words == {"FROM", "COPY", "WORKDIR", "RUN", "ENTRYPOINT"}, words
copied = [name for line in lines if line.startswith("COPY ") and "--from" not in line for name in line.split()[1:-1]]
missing = [name for name in copied if not (root / name).exists()]
assert not missing, f"the Containerfile copies what is not there: {missing}"
install = (root / "cmake/Install.cmake").read_text()
read = {*re.findall(r"(?<![\w/*])([a-z]+)/\*/", project), *re.findall(r"add_subdirectory\((\w+)\)", project)}
read = read - {"tests"} | {"cmake", "docs"}
read |= {name for names in re.findall(r"install\(FILES ([A-Z][^$)]*?) DESTINATION", install) for name in names.split()}
assert {"core", "apps", "lattices", "materials", "plugins", "io", "LICENSE"} <= read, f"not read: {read}"
assert not read - set(copied), f"the Containerfile does not copy {read - set(copied)}"

# Spack.
tree = ast.parse((recipes / "spack/packages/hyperlattice/package.py").read_text())
packages = [node for node in tree.body if isinstance(node, ast.ClassDef)]
assert [package.name for package in packages] == ["Hyperlattice"] and packages[0].bases[0].id == "CMakePackage"
calls = [node.value for node in packages[0].body if isinstance(node, ast.Expr) and isinstance(node.value, ast.Call)]
assert [call.args[0].value for call in calls if call.func.id == "version"] == [version], "another version for Spack"
assert sum(call.func.id == "depends_on" for call in calls) > 10

# conda.
text = (recipes / "conda/meta.yaml").read_text()
try:
    import yaml
except ImportError:
    print("no Python module yaml: meta.yaml and repo.yaml were not read")
else:
    recipe = yaml.safe_load(text)
    assert recipe["package"] == {"name": "hyperlattice", "version": version}, recipe["package"]
    assert (recipes / "conda" / recipe["source"]["path"]).resolve() == root.resolve()
    assert yaml.safe_load((recipes / "spack/repo.yaml").read_text()) == {"repo": {"namespace": "hyperlattice"}}
print(f"recipes of version {version}: {len(copied)} names copied, {len(calls)} directives of Spack")
