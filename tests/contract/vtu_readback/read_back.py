# Reads a series with VTK's own reader and compares every number, bit by bit, with the dumps written beside it.
#   read_back.py PROGRAM COMPRESS
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml

import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy

program, compress = sys.argv[1:]
faults = []


def same(what, read, dump, components):
    expected = np.fromfile(dump, dtype=np.float64)
    if components > 1:
        expected = expected.reshape(-1, components)
    if read.dtype != np.float64 or read.shape != expected.shape:
        faults.append(f"{what}: {read.dtype} {read.shape}, expected float64 {expected.shape}")
    elif read.tobytes() != expected.tobytes():
        faults.append(f"{what}: values differ")


def read(path):
    """The grid, or None with a fault if VTK's reader complains."""
    complaints = []
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.AddObserver("ErrorEvent", lambda *_: complaints.append(path))
    reader.SetFileName(path)
    reader.Update()
    if complaints:
        faults.append(f"{path}: VTK's reader complains")
    return reader.GetOutput()


def check(folder, file, region, deformed):
    subprocess.run([program, folder, compress, file, region, deformed], check=True)
    collection = xml.parse(f"{folder}/{file}.pvd").getroot()
    entries = collection.findall("./Collection/DataSet")
    if collection.get("type") != "Collection" or len(entries) != 3:
        faults.append(f"{file}.pvd: not a collection of three files")
    for number, entry in enumerate(entries):
        base = f"{folder}/{file}{number}"
        time = np.fromfile(base + ".time", dtype=np.float64)
        if float(entry.get("timestep")) != time[0] or entry.get("file") != f"{file}_{number:06d}.vtu":
            faults.append(f"{file}.pvd: entry {number} is {entry.attrib}")
        grid = read(f"{folder}/{entry.get('file')}")
        same("TimeValue", vtk_to_numpy(grid.GetFieldData().GetArray("TimeValue")), base + ".time", 1)
        same("points", vtk_to_numpy(grid.GetPoints().GetData()), base + ".points", 3)
        data = grid.GetPointData()
        if data.GetNumberOfArrays() != 3:
            faults.append(f"{data.GetNumberOfArrays()} fields")
        for name, components in (("displacement", 3), ("velocity", 3), ("broken_open", 1)):
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
    if (b"vtkZLibDataCompressor" in text) != (compress == "true"):
        faults.append("the file is not compressed as asked")


with tempfile.TemporaryDirectory() as folder:
    check(folder, "whole", "all", "false")
    check(folder, "part", "some", "true")

print("\n".join(faults) if faults else "every value is the same")
sys.exit(1 if faults else 0)
