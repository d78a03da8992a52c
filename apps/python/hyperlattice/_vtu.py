"""Reads the frames that `writers.vtu` wrote: VTK files in XML, whose arrays follow as raw binary data."""
from __future__ import annotations

import pathlib
import struct
import xml.etree.ElementTree as xml
import zlib

import numpy as np

from . import _core

_TYPES = {"Float32": "f4", "Float64": "f8", "Int32": "i4", "Int64": "i8", "UInt8": "u1"}
_UNPACK = {
    "": lambda packed, size: packed,
    "vtkZLibDataCompressor": lambda packed, size: zlib.decompress(packed, bufsize=size),
    "vtkLZ4DataCompressor": _core.lz4_block,
}


class Series:
    """The frames of one writer, as its collection file (.pvd) lists them."""

    def __init__(self, file: pathlib.Path):
        self.file = file
        sets = xml.parse(file).getroot().iter("DataSet")
        self.frames = [(float(one.attrib["timestep"]), file.parent / one.attrib["file"]) for one in sets]

    @property
    def times(self) -> np.ndarray:
        """Times of the frames, s."""
        return np.array([time for time, _ in self.frames])

    def frame(self, number: int) -> Frame:
        try:
            return Frame(self.frames[number][1])
        except IndexError:
            raise IndexError(f"frame {number}: {self.file.name} has {len(self.frames)} frames") from None


class Frame:
    """One file. Arrays are read when they are asked for."""

    def __init__(self, file: pathlib.Path):
        content = file.read_bytes()
        head, mark, self._data = content.partition(b'<AppendedData encoding="raw">\n_')
        if not mark:
            raise ValueError(f"{file}: no appended raw data")
        root = xml.fromstring(head + b"</VTKFile>")
        self._file = file
        self._order = "<" if root.attrib["byte_order"] == "LittleEndian" else ">"
        self._unpack = _UNPACK.get(root.attrib.get("compressor", ""))
        if self._unpack is None or root.attrib.get("header_type") != "UInt64":
            raise ValueError(f"{file}: packed in a way that this reader does not know")
        self._packed = "compressor" in root.attrib
        self._arrays = {one.attrib["Name"]: one.attrib for one in root.iterfind(".//PointData/DataArray")}
        self._points = root.find(".//Points/DataArray").attrib

    @property
    def fields(self) -> list[str]:
        return list(self._arrays)

    def points(self) -> np.ndarray:
        return self._read(self._points)

    def field(self, name: str) -> np.ndarray:
        if name not in self._arrays:
            raise KeyError(f"no field {name} in {self._file.name}; it has {', '.join(self._arrays)}")
        return self._read(self._arrays[name])

    def _read(self, array) -> np.ndarray:
        numbers = np.frombuffer(self._bytes(int(array["offset"])), dtype=self._order + _TYPES[array["type"]])
        components = int(array.get("NumberOfComponents", 1))
        return numbers.reshape(-1, components) if components > 1 else numbers

    def _bytes(self, start: int) -> bytes:
        """Sizes come first: of the array without a compressor, else of its blocks (docs/guide/python.md)."""
        def sizes(count: int, at: int) -> tuple[int, ...]:
            return struct.unpack_from(f"{self._order}{count}Q", self._data, at)

        if not self._packed:
            return self._data[start + 8:start + 8 + sizes(1, start)[0]]
        blocks, whole, last = sizes(3, start)
        at, out = start + 8 * (3 + blocks), []
        for number, packed in enumerate(sizes(blocks, start + 24)):
            size = last if last and number == blocks - 1 else whole
            out.append(self._unpack(self._data[at:at + packed], size))
            at += packed
        return b"".join(out)
