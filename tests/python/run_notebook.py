"""Executes the code cells of a notebook, or the Python blocks of a page, in one name space, as Jupyter does. Argument:
the notebook (.ipynb) or the page (.md). A value at the end of a cell is shown as HTML by Jupyter; here its HTML is made
and thrown away."""
import ast
import json
import os
import re
import sys
import tempfile


def execute(source, names, name):
    tree = ast.parse(source, name)
    last = ast.Expression(tree.body.pop().value) if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    exec(compile(tree, name, "exec"), names)  # pylint: disable=exec-used
    if last is None:
        return
    value = eval(compile(last, name, "eval"), names)  # pylint: disable=eval-used
    if value is not None:
        print(value)
    if hasattr(value, "_repr_html_"):
        assert "</" in value._repr_html_()


def cells_of(file, text):
    if file.endswith(".md"):
        return re.findall(r"^```python\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)
    notebook = json.loads(text)
    assert notebook["nbformat"] == 4
    cells = [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]
    assert not any(cell["outputs"] for cell in cells), "a notebook is kept without outputs"
    return ["".join(cell["source"]) for cell in cells]


with open(sys.argv[1], encoding="utf-8") as opened:
    sources = cells_of(sys.argv[1], opened.read())
assert sources
space = {"__name__": "__main__"}
with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    for number, source in enumerate(sources, 1):
        execute(source, space, f"{os.path.basename(sys.argv[1])}, block {number}")
