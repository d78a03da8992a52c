# A series of VTK files, read with VTK's own reader.
import xml.etree.ElementTree as xml

import vtk


def times(path):
    """Time and file name of each entry of a .pvd collection."""
    collection = xml.parse(path).getroot()
    if collection.get("type") != "Collection":
        raise SystemExit(f"{path}: not a collection")
    return [(float(entry.get("timestep")), entry.get("file")) for entry in collection.findall("./Collection/DataSet")]


def read(path):
    """The grid of a file; ends the test if VTK's reader complains."""
    complaints = []
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.AddObserver("ErrorEvent", lambda *_: complaints.append(path))
    reader.SetFileName(path)
    reader.Update()
    if complaints:
        raise SystemExit(f"{path}: VTK's reader complains")
    return reader.GetOutput()
