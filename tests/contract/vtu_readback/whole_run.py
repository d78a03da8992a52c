# A run writes the same frames as VTK files and as tables. Both must hold the same numbers at the
# same times, and agree with the probe of a point.
#   whole_run.py PROGRAM
import json
import subprocess
import sys
import tempfile

import numpy as np
from series import read, times
from vtk.util.numpy_support import vtk_to_numpy

fields = {"displacement": 3, "velocity": 3, "height": 1, "material": 1, "broken_open": 1, "broken_closed": 1, "damage": 1,
          "stress": 6, "nominal_stress": 9, "principal_stress": 3, "von_mises": 1, "hencky_strain": 6}
outputs = {"every": "2 us", "fields": list(fields)}
scene = {
    "format": "hyperlattice/1",
    "pipeline": [
        {"type": "lattices.cubic", "spacing": "2 mm", "shape": {"hollow_sphere": {"inner_radius": "8 mm", "outer_radius": "16 mm"}}},
        {"type": "materials.elastic", "young": "10 GPa", "poisson": 0.2, "density": 2500, "membrane": "I-m",
         "failure": {"type": "failures.elongation", "limit": "3 um"}},
        {"type": "loads.blast", "on": "inner_surface", "peak": "100 MPa", "rise": "2 us", "fall": "2 us"},
        {"type": "solvers.explicit", "end_time": "6 us", "energy_tolerance": 0},
        {"type": "writers.vtu", "precision": "double", **outputs},
        {"type": "writers.csv", **outputs},
        {"type": "probes.point", "position": ["15 mm", "1 mm", "1 mm"], "field": "velocity", "every": "2 us"},
    ],
}


def main(folder):
    with open(f"{folder}/scene.json", "w") as file:
        json.dump(scene, file)
    subprocess.run([sys.argv[1], "run", f"{folder}/scene.json", "--out", f"{folder}/out"], check=True)
    out = f"{folder}/out"
    table_times = np.loadtxt(f"{out}/frames_times.csv", delimiter=",", skiprows=1, usecols=2)
    probe = np.loadtxt(f"{out}/probes/point.csv", delimiter=",", skiprows=1)
    entries = times(f"{out}/frames.pvd")
    assert [time for time, _ in entries] == list(table_times) == list(probe[:, 0]), "the times differ"
    assert len(entries) >= 3, "too few frames"
    broken = 0
    for number, (time, name) in enumerate(entries):
        grid = read(f"{out}/{name}")
        assert vtk_to_numpy(grid.GetFieldData().GetArray("TimeValue"))[0] == time, name
        with open(f"{out}/frames_{number:06d}.csv") as file:
            columns = file.readline().strip().split(",")
        table = np.loadtxt(f"{out}/frames_{number:06d}.csv", delimiter=",", skiprows=1)
        points = vtk_to_numpy(grid.GetPoints().GetData())
        assert np.array_equal(points, table[:, :3]), f"{name}: points"
        column = 3
        for field, components in fields.items():
            values = vtk_to_numpy(grid.GetPointData().GetArray(field)).reshape(len(points), components)
            assert np.array_equal(values, table[:, column : column + components], equal_nan=True), f"{name}: {field}"
            assert columns[column].startswith(field), f"{name}: column {columns[column]}"
            column += components
        assert column == len(columns) == table.shape[1], f"{name}: columns"
        near = np.argmin(np.linalg.norm(points - [0.015, 0.001, 0.001], axis=1))
        velocity = vtk_to_numpy(grid.GetPointData().GetArray("velocity"))[near]
        assert np.array_equal(velocity, probe[number, 1:]), f"{name}: probe"
        broken = vtk_to_numpy(grid.GetPointData().GetArray("broken_open")).sum()
    assert np.any(velocity != 0) and broken > 0, "nothing happened, so nothing was compared"
    print(f"{len(entries)} frames of {len(points)} particles agree")


with tempfile.TemporaryDirectory() as folder:
    main(folder)
