# The beam of the gallery against geometrically nonlinear finite elements, over the whole curve of loads, with numbers of cells through the height: within
# the tolerances, of second order; far from linear finite elements.
#   beam.py PROGRAM SCENE CELLS...
import math
import os
import sys

from lattice_field import run, table

program, scene, numbers = sys.argv[1], sys.argv[2], [int(n) for n in sys.argv[3:]]
truth = [row for row in table(os.path.join(os.path.dirname(scene), "truth.csv")) if row["case"] == "cantilever"]
curve = {name: {round(float(row["load_N"]), 6): float(row["uy_tip_or_mid"]) for row in truth if row["method"] == name} for name in ("fem_nlgeom", "fem_linear")}
tolerance = {"cells": {4: 0.06, 8: 0.016, 12: 0.01, 16: 0.005}, "particles": {4: 0.08, 8: 0.04, 12: 0.04, 16: 0.04}}
faults = []
for boundary in tolerance:
    errors = {}
    for n in numbers:
        spacing = 0.01 / n
        settings = {"/pipeline/0/boundary": boundary, "/pipeline/1/stiffness": "bulk" if boundary == "cells" else "eq15"}
        summary, out = run(program, scene, spacing, settings)
        rows = {round(40 * float(row["time"]), 6): float(row["displacement_y_mean"]) for row in table(os.path.join(out.name, "probes", "tip.csv"))}
        if not set(curve["fem_nlgeom"]) <= set(rows):
            faults.append("the probe missed a step of the load")
        off = {load: rows[load] / value - 1 for load, value in curve["fem_nlgeom"].items() if load in rows}
        errors[n] = max(off.values(), key=abs)
        print(f"{n} through the height, {boundary}: {summary['particles']} particles, worst {errors[n]:.4f}, at full load {off[40.0]:.4f}, "
              f"{summary['rest']['iterations']} iterations")
        if abs(errors[n]) > tolerance[boundary][n]:
            faults.append(f"{boundary}, {n}: error {errors[n]}, at most {tolerance[boundary][n]}")
        if abs(rows[40.0] / curve["fem_linear"][40.0] - 1) < 0.2:
            faults.append(f"{boundary}, {n}: full load looks linear")
    for coarse, fine in zip(numbers, numbers[1:]):
        order = math.log(errors[coarse] / errors[fine]) / math.log(fine / coarse)
        print(f"{boundary}: order {order:.2f}")
        if boundary == "cells" and order < 1.8:
            faults.append(f"cells: order {order} between {coarse} and {fine}")

for fault in faults:
    print(fault, file=sys.stderr)
sys.exit(1 if faults else 0)
