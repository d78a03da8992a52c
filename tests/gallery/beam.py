# Compares the beams of the gallery with geometrically nonlinear finite elements over the whole
# curve of loads. The arguments CELLS are numbers of cells through the height. Errors must be within
# the tolerances and of second order. The result at full load must be far from linear finite
# elements.
#   beam.py PROGRAM SCENE CELLS...
import math
import os
import sys

from lattice_field import run, table

# Probe, column, full load (N), and the largest errors by boundary and cells through the height.
CASES = {
    "beam": ("tip", "displacement_y_mean", 40.0, {"cells": {4: 0.06, 8: 0.016, 12: 0.01, 16: 0.005}, "particles": {4: 0.08, 8: 0.04, 12: 0.04, 16: 0.04}}),
    "clamped_beam": ("middle", "displacement_y@(0.1 0 0)", 600.0, {"cells": {4: 0.06, 8: 0.016, 12: 0.01}, "particles": {4: 0.08, 8: 0.04, 12: 0.04}}),
}

program, scene, numbers = sys.argv[1], sys.argv[2], [int(n) for n in sys.argv[3:]]
folder = os.path.dirname(scene)
name = os.path.basename(folder)
probe, column, full, tolerance = CASES[name]
truth = table(os.path.join(folder, "truth.csv"))
curve = {method: {round(float(row["load_N"]), 6): float(row["uy_tip_or_mid"]) for row in truth if row["method"] == method} for method in ("fem_nlgeom", "fem_linear")}
faults = []
for boundary in tolerance:
    errors = {}
    for n in numbers:
        spacing = 0.01 / n
        settings = {"/pipeline/0/boundary": boundary, "/pipeline/1/stiffness": "bulk" if boundary == "cells" else "eq15"}
        # With boundary particles, the load acts on the two layers beside the middle.
        if name == "clamped_beam" and boundary == "particles":
            settings |= {f"/pipeline/3/on/box/{end}": [0.1 + sign * 0.6 * spacing, sign, sign] for end, sign in (("low", -1), ("high", 1))}
        summary, out = run(program, scene, spacing, settings)
        rows = {round(full * float(row["time"]), 6): float(row[column]) for row in table(os.path.join(out.name, "probes", probe + ".csv"))}
        if not set(curve["fem_nlgeom"]) <= set(rows):
            faults.append("the probe missed a step of the load")
        off = {load: rows[load] / value - 1 for load, value in curve["fem_nlgeom"].items() if load in rows}
        worst = max(off.values(), key=abs)
        # The order is measured at the least load, where the beam is linear: at large strains the
        # laws of the continuum and of the springs differ.
        errors[n] = off[min(off)]
        print(f"{n} through the height, {boundary}: {summary['particles']} particles, at the least load {errors[n]:.4f}, worst {worst:.4f}, "
              f"at full load {off[full]:.4f}, {summary['rest']['iterations']} iterations")
        if abs(worst) > tolerance[boundary][n]:
            faults.append(f"{boundary}, {n}: error {worst}, at most {tolerance[boundary][n]}")
        if abs(rows[full] / curve["fem_linear"][full] - 1) < 0.2:
            faults.append(f"{boundary}, {n}: full load looks linear")
    for coarse, fine in zip(numbers, numbers[1:]):
        order = math.log(abs(errors[coarse] / errors[fine])) / math.log(fine / coarse)
        print(f"{boundary}: order {order:.2f}")
        if boundary == "cells" and order < 1.8:
            faults.append(f"cells: order {order} between {coarse} and {fine}")

for fault in faults:
    print(fault, file=sys.stderr)
sys.exit(1 if faults else 0)
