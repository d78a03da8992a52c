"""Checks what an editor reads in the JSON Schema.
Arguments: the program, an empty or absent folder.

Every option of every component has its meaning, its unit if it has one, and a default, an example or the values among
which it is chosen. The values that the schema offers are valid. `--plugin-path` adds a component from a source file.
"""
import json
import os
import pathlib
import subprocess
import sys

from jsonschema import Draft202012Validator

program, folder = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
folder.mkdir(parents=True, exist_ok=True)
environment = {**os.environ, "XDG_CACHE_HOME": str(folder / "cache")}


def output(*words, code=0):
    done = subprocess.run([program, *words], capture_output=True, text=True, env=environment, cwd=folder)
    assert done.returncode == code, f"{words}: {done.stderr}"
    return done.stderr if code else done.stdout


(folder / "my_law.cpp").unlink(missing_ok=True)
output("plugins", "--new", "failures.my_law", "--out", "my_law.cpp")
schema = json.loads(output("schema", "--plugin-path", "my_law.cpp"))
definitions = schema["$defs"]
faults = []

for name, key in schema["properties"].items():
    if not key.get("description"):
        faults.append(f"the key {name} has no meaning")

components = json.loads(output("plugins", "--json", "--plugin-path", "my_law.cpp"))["components"]
seen = 0
for component in components:
    if component["family"] == "engines":
        continue
    described = definitions[component["type"]]
    for option in component["options"] + component["common_options"]:
        place, property = f"{component['type']}/{option['name']}", described["properties"][option["name"]]
        seen += 1
        if option["help"] not in property.get("description", ""):
            faults.append(f"{place}: no meaning")
        if option.get("unit") and f"[{option['unit']}]" not in property["description"]:
            faults.append(f"{place}: no unit")
        text = json.dumps(property)
        # A text is the user's own; criteria and cuts have examples of their options.
        others = ('"enum"', '{"type": "string"}', "#/$defs/failure", "#/$defs/cut")
        if not ("default" in property or "examples" in property or any(other in text for other in others)):
            faults.append(f"{place}: neither default nor example")
        for value in property.get("examples", []):
            errors = list(Draft202012Validator({"$defs": definitions, **property}).iter_errors(value))
            faults += [f"{place}: the example {value} is wrong: {error.message}" for error in errors]
    for stage in described["examples"]:
        errors = list(Draft202012Validator({"$defs": definitions, **described}).iter_errors(stage))
        faults += [f"{component['type']}: the example {stage} is wrong: {error.message}" for error in errors]

print(*faults, sep="\n")
assert not faults and seen > 200, f"{len(faults)} faults, {seen} options"

assert "failures.my_law" not in json.loads(output("schema"))["$defs"]
validator = Draft202012Validator({"$defs": definitions, "$ref": "#/$defs/failure"})
assert validator.is_valid({"type": "failures.my_law", "limit": 1e-3})
assert not validator.is_valid({"type": "failures.my_law", "limits": 1e-3})
(folder / "wrong.cpp").write_text("not C++\n")
assert "wrong.cpp:1" in output("schema", "--plugin-path", "wrong.cpp", code=2)
print(f"{seen} options of {len(components)} components")
