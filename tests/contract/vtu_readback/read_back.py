# Reads a series with VTK's own reader and compares all numbers, bit by bit, with dumps of them.
#   read_back.py PROGRAM CODEC PRECISION
import subprocess
import sys
import tempfile

import numpy as np
import vtk
from series import read, times
from vtk.util.numpy_support import vtk_to_numpy

program, codec, precision = sys.argv[1:]
real = {"single": np.float32, "double": np.float64}[precision]
compressors = {"zlib": b"vtkZLibDataCompressor", "lz4": b"vtkLZ4DataCompressor", "none": None}
faults = []


def same(what, read, dump, components, kind=real):
    expected = np.fromfile(dump, dtype=np.float64).astype(kind)
    if components > 1:
        expected = expected.reshape(-1, components)
    if read.dtype != kind or read.shape != expected.shape:
        faults.append(f"{what}: {read.dtype} {read.shape}, expected {kind} {expected.shape}")
    elif read.tobytes() != expected.tobytes():
        faults.append(f"{what}: values differ")


def check(folder, file, region, deformed):
    subprocess.run([program, folder, codec, precision, file, region, deformed], check=True)
    entries = times(f"{folder}/{file}.pvd")
    if len(entries) != 3:
        faults.append(f"{file}.pvd: {len(entries)} files, expected three")
    for number, (stated, name) in enumerate(entries):
        base = f"{folder}/{file}{number}"
        time = np.fromfile(base + ".time", dtype=np.float64)
        if stated != time[0] or name != f"{file}_{number:06d}.vtu":
            faults.append(f"{file}.pvd: entry {number} is {name} at {stated}")
        grid = read(f"{folder}/{name}")
        same("TimeValue", vtk_to_numpy(grid.GetFieldData().GetArray("TimeValue")), base + ".time", 1, np.float64)
        same("points", vtk_to_numpy(grid.GetPoints().GetData()), base + ".points", 3)
        data = grid.GetPointData()
        if data.GetNumberOfArrays() != 4:
            faults.append(f"{data.GetNumberOfArrays()} fields")
        for name, components in (("displacement", 3), ("velocity", 3), ("broken_open", 1), ("material", 1)):
            same(name, vtk_to_numpy(data.GetArray(name)), f"{base}.{name}", components)
        points = grid.GetNumberOfPoints()
        connectivity = vtk_to_numpy(grid.GetCells().GetConnectivityArray())
        offsets = vtk_to_numpy(grid.GetCells().GetOffsetsArray())
        types = vtk_to_numpy(grid.GetCellTypesArray())
        if not (
            np.array_equal(connectivity, np.arange(points))
            and np.array_equal(offsets, np.arange(points + 1))
            and np.array_equal(types, np.full(points, vtk.VTK_VERTEX))
        ):
            faults.append("cells are not one vertex for each point")
    text = open(f"{folder}/{file}_000000.vtu", "rb").read(400)
    named = [compressor for compressor in compressors.values() if compressor and compressor in text]
    if named != [compressors[codec]] * (codec != "none"):
        faults.append(f"the file names {named} as compressor, expected {codec}")


with tempfile.TemporaryDirectory() as folder:
    check(folder, "whole", "all", "false")
    check(folder, "part", "some", "true")

print("\n".join(faults) if faults else "every value is the same")
sys.exit(1 if faults else 0)
