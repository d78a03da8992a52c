# A run breaks a bar across, and VTK's own reader reads the faces of the crack: their area is that of
# the cross-section, and their particles and times are those of failures.csv.
#   crack_surfaces.py PROGRAM
import json
import subprocess
import sys
import tempfile

import numpy as np
import vtk
from series import read, times
from vtk.util.numpy_support import vtk_to_numpy

lattices = {
    "cells": {"type": "lattices.cubic", "boundary": "cells"},
    "particles": {"type": "lattices.cubic", "boundary": "particles"},
}
writers = {
    "lz4": {"codec": "lz4", "precision": "double"},
    "zlib": {"codec": "zlib", "precision": "double", "deformed": True},
    "none": {"codec": "none", "precision": "single", "diagonals": True},
}


def scene(lattice):
    return {
        "format": "hyperlattice/1",
        "regions": {"low": {"box": {"low": [-1, -1, -1], "high": [1, 1, "5.9 mm"]}}, "high": {"box": {"low": [-1, -1, "5.9 mm"], "high": [1, 1, 1]}}},
        "pipeline": [
            {"spacing": "1 mm", "shape": {"box": {"low": [0, 0, 0], "high": ["4 mm", "3 mm", "12 mm"]}}, **lattice},
            {"type": "materials.elastic", "young": "10 GPa", "poisson": 0.25, "density": 2500,
             "failure": {"type": "failures.elongation", "limit": "1 um"}},
            {"type": "loads.start_velocity", "on": "low", "linear": [0, 0, -50]},
            {"type": "loads.start_velocity", "on": "high", "linear": [0, 0, 50]},
            {"type": "solvers.explicit", "end_time": "0.4 us", "time_step": "0.02 us"},
            *({"type": "writers.cracks", "name": name, "every": "0.1 us", **options} for name, options in writers.items()),
            {"type": "probes.fragments", "every": 0},
        ],
    }


def areas(surface):
    """The area of each face, from the corners."""
    points = vtk_to_numpy(surface.GetPoints().GetData()).astype(float)
    corners = vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 4)
    edges = points[corners[:, 1]] - points[corners[:, 0]], points[corners[:, 3]] - points[corners[:, 0]]
    return np.linalg.norm(np.cross(*edges), axis=1)


def number(surface, name):
    return vtk_to_numpy(surface.GetCellData().GetArray(name))


def check(folder, lattice):
    with open(f"{folder}/scene.json", "w") as file:
        json.dump(scene(lattice), file)
    subprocess.run([sys.argv[1], "run", f"{folder}/scene.json", "--out", f"{folder}/out", "--threads", "2"], check=True)
    failures = np.loadtxt(f"{folder}/out/failures.csv", delimiter=",", skiprows=1)
    assert len(failures) > 0, "nothing broke"
    when = {(int(a), int(b)): time for _, time, a, b, *_ in failures}
    for name, options in writers.items():
        entries = times(f"{folder}/out/{name}/cracks.pvd")
        assert len(entries) == 5, f"{name}: {len(entries)} frames"
        for frame, (time, file) in enumerate(entries):
            surface = read(f"{folder}/out/{name}/{file}", vtk.vtkXMLPolyDataReader)
            assert vtk_to_numpy(surface.GetFieldData().GetArray("TimeValue"))[0] == time
            if frame == 0:
                assert surface.GetNumberOfCells() == 0, f"{name}: faces before anything broke"
                continue
            ends = list(zip(number(surface, "particle_a"), number(surface, "particle_b")))
            classes = number(surface, "spring_class")
            assert np.all(number(surface, "damage") == 1)
            assert np.allclose(number(surface, "time"), [when[pair] for pair in ends], rtol=1e-6)
            faces = classes == 0
            own = areas(surface)
            assert np.allclose(own[faces], number(surface, "area")[faces], rtol=1e-5)
            assert np.all(number(surface, "area")[~faces] == 0) and np.any(~faces) == options.get("diagonals", False)
            normal, jump = number(surface, "normal"), number(surface, "jump")
            assert np.allclose(abs(normal[faces]), [0, 0, 1])
            assert np.allclose(number(surface, "opening")[faces], np.sum(normal * jump, axis=1)[faces], rtol=0.1)
            assert np.all(number(surface, "opening") > 0)
            exact = 12e-6
            error = abs(number(surface, "area").sum() - exact) / exact
            assert error < 1e-6, f"{name}: the area is wrong by {error}"
        if options.get("diagonals"):
            assert set(ends) == set(when), "a spring of failures.csv is missing"
    with open(f"{folder}/out/probes/fragments.csv") as file:
        header = file.readline().strip().split(",")
        first, *_, last = [dict(zip(header, map(float, line.split(",")))) for line in file]
    assert first["fragments"] == 1 and last["fragments"] == 2
    assert abs(last["mass"] + last["dust_mass"] - first["mass"]) < 1e-12 * first["mass"]
    print(f"{len(failures)} broken springs, {int(last['fragments'])} fragments")


for lattice in lattices.values():
    with tempfile.TemporaryDirectory() as folder:
        check(folder, lattice)
