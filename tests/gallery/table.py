# Compares the table of the gallery with finite elements along the middle line of its top, at a
# spacing in mm. Errors must be within the tolerances. The edge must move less for larger Poisson
# ratios.
#   table.py PROGRAM SCENE SPACING POISSON...
import os
import sys

import numpy

from lattice_field import displacements, relative_error, run, table

program, scene, spacing, ratios = sys.argv[1], sys.argv[2], float(sys.argv[3]) * 1e-3, [float(nu) for nu in sys.argv[4:]]
truth = table(os.path.join(os.path.dirname(scene), "truth.csv"))
coarse = spacing > 0.004
# Bounds of the errors of ux and uy. For cells, the bounds are the errors found here with a small
# margin; for particles, the errors that the authors of the truth found with an independent program.
tolerance = {"cells": (0.17, 0.13) if coarse else (0.06, 0.05), "particles": (0.12, 0.105) if coarse else (0.08, 0.07)}
faults = []
for boundary in tolerance:
    edges = []
    for nu in ratios:
        stiffness = "bulk" if boundary == "cells" else "eq15"
        settings = {"/pipeline/0/boundary": boundary, "/pipeline/1/stiffness": stiffness, "/pipeline/1/poisson": nu}
        summary, out = run(program, scene, spacing, settings)
        field = displacements(out, spacing)
        # Boundary particles are half a spacing below the surface.
        depth = 0 if boundary == "cells" else spacing / 2
        line = [row for row in truth if float(row["nu"]) == nu and abs(float(row["depth_below_top"]) - depth) < 1e-9]
        # Only points at the places of particles count.
        line = [row for row in line if abs((float(row["x"]) - depth) / spacing - round((float(row["x"]) - depth) / spacing)) < 1e-6]
        found = numpy.array([field.at([float(row["x"]), 0.055 - depth, 0]) for row in line])
        errors = [relative_error(found[:, axis], [float(row[u]) for row in line]) for axis, u in ((0, "ux"), (1, "uy"))]
        edges.append(abs(found[-1, 0]))
        print(f"{spacing * 1e3} mm, {boundary}, nu {nu}: {summary['particles']} particles, errors of ux {errors[0]:.4f}, uy {errors[1]:.4f}")
        for value, most, name in zip(errors, tolerance[boundary], ("ux", "uy")):
            if value > most:
                faults.append(f"{boundary}, nu {nu}: error of {name} {value}, at most {most}")
    if any(later >= earlier for earlier, later in zip(edges, edges[1:])):
        faults.append(f"{boundary}: the edge does not move less with a larger Poisson ratio: {edges}")

for fault in faults:
    print(fault, file=sys.stderr)
sys.exit(1 if faults else 0)
