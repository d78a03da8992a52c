# The beam that cracks slowly: the peak between beam theory and linear fracture mechanics, the way down, the energy.
#   notched_beam.py PROGRAM SCENE
import csv
import json
import pathlib
import subprocess
import sys
import tempfile

program, scene = sys.argv[1:]
with tempfile.TemporaryDirectory() as folder:
    out = pathlib.Path(folder) / "out"
    subprocess.run([program, "run", scene, "--out", out, "--quiet"], check=True)
    with open(out / "probes" / "force.csv") as file:
        force = [-float(row["force_y"]) for row in csv.DictReader(file)]
    energy = json.loads((out / "summary.json").read_text())["energy"]

young, strength, fracture_energy = 50e9, 8e6, 60.0
span, height, notch, thickness = 0.180, 0.050, 0.015, 0.0025
ligament = height - notch
of_strength = strength * thickness * ligament**2 / (1.5 * span)
ratio = notch / height
shape = 3 * ratio**0.5 * (1.99 - ratio * (1 - ratio) * (2.15 - 3.93 * ratio + 2.7 * ratio**2)) / (2 * (1 + 2 * ratio) * (1 - ratio) ** 1.5)
of_toughness = (young * fracture_energy) ** 0.5 * thickness * height**1.5 / (span * shape)
taken = energy["dissipated_failure"] / (fracture_energy * thickness)
print(f"peak {max(force):.1f} N between {of_strength:.1f} and {of_toughness:.1f}, at the end {force[-1]:.1f}; cracked {1e3 * taken:.1f} mm, balance {energy['relative_error']:.1e}")
good = (
    1.2 * of_strength < max(force) < 0.9 * of_toughness
    and force[-1] < 0.25 * max(force)
    and 0.6 * ligament < taken < ligament
    and abs(energy["relative_error"]) < 1e-4
)
sys.exit(0 if good else 1)
