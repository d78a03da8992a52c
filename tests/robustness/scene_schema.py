"""Another program checks the JSON Schema that the program prints. The schema must accept good
scenes, as written and as resolved, and refuse malformed scenes if a schema can find their fault.
Arguments: the program, the table of malformed scenes, good scenes."""
import copy
import json
import subprocess
import sys

from jsonschema import Draft202012Validator


def load(path):
    with open(path, encoding="utf-8") as file:
        lines = [line for line in file if not line.strip().startswith("//")]
    return json.loads("".join(lines))


def place(document, pointer):
    """Returns the container of the pointer's last key, and this key."""
    keys = [key.replace("~1", "/").replace("~0", "~") for key in pointer.split("/")[1:]]
    for key in keys[:-1]:
        document = document[int(key)] if isinstance(document, list) else document.setdefault(key, {})
    return document, int(keys[-1]) if isinstance(document, list) else keys[-1]


def scene_of(case, base):
    scene = copy.deepcopy(base)
    for pointer, value in case.get("set", {}).items():
        container, key = place(scene, pointer)
        if isinstance(container, list) and key == len(container):
            container.append(value)
        else:
            container[key] = value
    for pointer in case.get("drop", []):
        container, key = place(scene, pointer)
        del container[key]
    return scene


def main():
    program, table_file, *good_files = sys.argv[1:]
    schema = json.loads(subprocess.run([program, "schema"], check=True, capture_output=True).stdout)
    Draft202012Validator.check_schema(schema)
    validator = Draft202012Validator(schema)
    table = load(table_file)
    complaints = []

    for name, scene in [("base", table["base"])] + [(file, load(file)) for file in good_files]:
        complaints += [f"{name} is good, but at {error.json_path}: {error.message}" for error in validator.iter_errors(scene)]

    components = json.loads(subprocess.run([program, "plugins", "--json"], check=True, capture_output=True).stdout)["components"]
    # The example of each page replaces the stage of its family. No scene names an engine.
    components = [component for component in components if component["family"] != "engines"]
    for component in components:
        scene = copy.deepcopy(table["base"])
        if component["family"] == "failures":
            scene["pipeline"][1]["failure"] = component["example"]
        elif component["family"] == "lattices":
            scene["pipeline"][0] = component["example"]
        else:
            scene["pipeline"].append(component["example"])
        complaints += [f"example of {component['type']}: {error.message}" for error in validator.iter_errors(scene)]
    scene = copy.deepcopy(table["base"])
    scene["pipeline"][1]["failure"] = [component["example"] for component in components if component["family"] == "failures"]
    complaints += [f"list of failures: {error.message}" for error in validator.iter_errors(scene)]

    refused = 0
    for case in table["cases"]:
        if "set" not in case and "drop" not in case:
            continue
        valid = validator.is_valid(scene_of(case, table["base"]))
        if valid and not case.get("unseen") and not case.get("plan"):
            complaints.append(f"{case['what']}: the schema accepts it")
        if not valid and (case.get("unseen") or case.get("plan")):
            complaints.append(f"{case['what']}: the schema sees it, though the table says that it cannot")
        refused += not valid
    print(f"{len(components)} examples accepted, {refused} malformed scenes refused")
    if not components or refused < 40:
        complaints.append("too few cases")
    print("\n".join(complaints))
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
