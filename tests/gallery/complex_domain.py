# Compares the bracket of the gallery with finite elements along three lines, at spacings in mm.
# Errors must be within the tolerances and of first order. The error with membrane IV, which is not
# isotropic, must be large.
#   complex_domain.py PROGRAM SCENE SPACING...
import os
import sys

from lattice_field import displacements, relative_error, run, table

program, scene, spacings = sys.argv[1], sys.argv[2], [float(s) for s in sys.argv[3:]]
truth = table(os.path.join(os.path.dirname(scene), "truth.csv"))
points = [[float(row[c]) for c in "xyz"] for row in truth]
expected = [[float(row["u" + c]) for c in "xyz"] for row in truth]
tolerance = {"cells": {10: 0.12, 5: 0.065, 2.5: 0.035}, "particles": {10: 0.13, 5: 0.08, 2.5: 0.05}}
faults = []


def error(spacing, boundary, membrane):
    stiffness = "bulk" if boundary == "cells" else "eq15"
    settings = {"/pipeline/0/boundary": boundary, "/pipeline/1/stiffness": stiffness, "/pipeline/1/membrane": membrane}
    summary, out = run(program, scene, spacing * 1e-3, settings)
    field = displacements(out, spacing * 1e-3)
    found = relative_error([field.at(point) for point in points], expected)
    print(f"{spacing} mm, {boundary}, {membrane}: {summary['particles']} particles, error {found:.4f}, {summary['rest']['iterations']} iterations")
    return found


for boundary in tolerance:
    errors = {}
    for spacing in spacings:
        errors[spacing] = error(spacing, boundary, "I-m")
        if errors[spacing] > tolerance[boundary][spacing]:
            faults.append(f"{boundary}, {spacing} mm: error {errors[spacing]}, at most {tolerance[boundary][spacing]}")
    for coarse, fine in zip(spacings, spacings[1:]):
        if errors[fine] > 0.7 * errors[coarse]:
            faults.append(f"{boundary}: the error falls from {errors[coarse]} to {errors[fine]} only")
    if error(spacings[0], boundary, "IV") < 3 * errors[spacings[0]]:
        faults.append(f"{boundary}: membrane IV is as good as I-m")

for fault in faults:
    print(fault, file=sys.stderr)
sys.exit(1 if faults else 0)
