# Reads series of VTK files with VTK's own reader.
import xml.etree.ElementTree as xml

import vtk


def times(path):
    """Times and file names of the entries of a .pvd collection."""
    collection = xml.parse(path).getroot()
    if collection.get("type") != "Collection":
        raise SystemExit(f"{path}: not a collection")
    return [(float(entry.get("timestep")), entry.get("file")) for entry in collection.findall("./Collection/DataSet")]


def read(path, reader_class=vtk.vtkXMLUnstructuredGridReader):
    """Reads the data in a file. Ends the test if VTK's reader complains."""
    complaints = []
    reader = reader_class()
    reader.AddObserver("ErrorEvent", lambda *_: complaints.append(path))
    reader.SetFileName(path)
    reader.Update()
    if complaints:
        raise SystemExit(f"{path}: VTK's reader complains")
    return reader.GetOutput()
