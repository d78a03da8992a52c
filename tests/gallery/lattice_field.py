# Runs a scene with other values, and interpolates the displacements that the run wrote.
import csv
import itertools
import json
import math
import os
import subprocess
import tempfile

import numpy


class Field:
    """Displacements of particles of a cubic lattice."""

    def __init__(self, table, spacing):
        rows = numpy.loadtxt(table, delimiter=",", skiprows=1)
        self.spacing = spacing
        self.origin = rows[0, :3] % spacing
        self.values = {tuple(site): u for site, u in zip(numpy.rint((rows[:, :3] - self.origin) / spacing).astype(int), rows[:, 3:6])}

    def at(self, point):
        """Interpolates linearly between the eight particles around a point. If some of these are
        missing, extrapolates from the nearest eight."""
        where = (numpy.asarray(point) - self.origin) / self.spacing
        low = numpy.floor(where + 1e-9).astype(int)
        for shift in sorted(itertools.product((0, -1, 1), repeat=3), key=lambda s: math.dist(where, low + numpy.array(s) + 0.5)):
            base = low + numpy.array(shift)
            corners = list(itertools.product((0, 1), repeat=3))
            if all(tuple(base + corner) in self.values for corner in corners):
                t = where - base
                weight = lambda corner: math.prod(t[a] if corner[a] else 1 - t[a] for a in range(3))
                return sum(weight(corner) * self.values[tuple(base + corner)] for corner in corners)
        raise ValueError(f"no eight particles near {point}")


def run(program, scene, spacing, settings):
    """Runs a scene at a spacing (m). Returns the summary and the temporary folder of the results.
    """
    out = tempfile.TemporaryDirectory()
    command = [program, "run", scene, "--quiet", "--out", out.name, "--set", f"/pipeline/0/spacing={spacing}"]
    for pointer, value in settings.items():
        command += ["--set", f"{pointer}={json.dumps(value)}"]
    subprocess.run(command, check=True, stderr=subprocess.DEVNULL)
    with open(os.path.join(out.name, "summary.json")) as file:
        summary = json.load(file)
    return summary, out


def displacements(out, spacing):
    frames = sorted(name for name in os.listdir(out.name) if name.startswith("frames_0"))
    return Field(os.path.join(out.name, frames[-1]), spacing)


def table(file):
    with open(file) as lines:
        return list(csv.DictReader(lines))


def relative_error(found, truth):
    """||found - truth|| / ||truth||"""
    found, truth = numpy.asarray(found), numpy.asarray(truth)
    return float(numpy.sqrt(((found - truth) ** 2).sum() / (truth**2).sum()))
