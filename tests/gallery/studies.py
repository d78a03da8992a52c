# Runs a study of the gallery without its finest spacings and checks what it found: the errors, the orders of convergence, the files.
#   studies.py PROGRAM SOURCE NAME
import json
import pathlib
import subprocess
import sys
import tempfile

program, source, name = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3]
faults = []


def check(holds, what):
    if not holds:
        faults.append(what)


def plane_wave(rows, orders):
    """Particles lose the springs of the surface, a share of the section that falls with the spacing: order 1. Cells lose nothing; a scheme of second
    order has the order 2 * 2.5 / 3 for a wave whose displacement has a kink in its second derivative."""
    order = {o["boundary"]: o["order"] for o in orders}
    check(abs(order["particles"] - 1) < 0.2, f"order of particles {order['particles']}, expected 1")
    check(abs(order["cells"] - 5 / 3) < 0.15, f"order of cells {order['cells']}, expected 5/3")
    error = {(r["boundary"], r["spacing"]): r["error"] for r in rows}
    check(error["cells", "4 mm"] < 1e-3, f"cells, 4 mm: {error['cells', '4 mm']}")


def hollow_sphere_blast(rows, orders):
    """Within the tolerances of the truth: 16 % for eq15 at 2 mm; cells are better than any particles."""
    error = {(r["boundary"], r["stiffness"], r["spacing"]): r["error"] for r in rows}
    check(error["particles", "eq15", "2 mm"] < 0.16, f"eq15, 2 mm: {error['particles', 'eq15', '2 mm']}")
    check(error["cells", "bulk", "2 mm"] < 0.07, f"cells, 2 mm: {error['cells', 'bulk', '2 mm']}")
    for spacing in ("4 mm", "2 mm"):
        check(error["cells", "bulk", spacing] < 0.8 * error["particles", "eq15", spacing], f"cells are no better than eq15 at {spacing}")
    check(len(orders) == 3 and all(o["order"] > 0.8 for o in orders), f"orders {[o['order'] for o in orders]}")


studies = {
    "plane_wave": (plane_wave, '/exclude=[{"spacing": "0.5 mm"}]', 6),
    "hollow_sphere_blast": (hollow_sphere_blast, '/exclude/-={"spacing": "1 mm"}', 6),
}
find_faults, setting, runs = studies[name]
with tempfile.TemporaryDirectory() as folder:
    out = pathlib.Path(folder) / "out"
    study = source / "docs" / "gallery" / name / "study.json"
    command = [program, "study", study, "--out", out, "--json", "--set", "/repeats=1", "--set", setting]
    found = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
    check((out / "study.svg").is_file() and (out / "study.csv").is_file(), "no plot or no table")
check(len(found["rows"]) == runs and all(r["status"] == "done" for r in found["rows"]), "not every run is done")
find_faults(found["rows"], found["orders"])
for row in found["rows"]:
    print({key: value for key, value in row.items() if key in ("spacing", "boundary", "stiffness", "error", "seconds", "particles")})
print("\n".join(faults) if faults else f"{name}: {runs} runs, orders {[round(o['order'], 2) for o in found['orders']]}")
sys.exit(1 if faults else 0)
