"""What a run has left in its folder."""
from __future__ import annotations

import json
import os
import pathlib
from typing import Any

import numpy as np

from . import _html, _tables, _vtu


class Result:
    """The results of a run. They are read from its folder when they are asked for.

    A folder that `run` made itself is temporary: it is removed when the last reference to the result is gone.
    """

    def __init__(self, folder: str | os.PathLike[str], *, _keep: object = None):
        self.folder = pathlib.Path(folder).absolute()
        """The folder of the run."""
        self._keep = _keep
        with open(self.folder / "summary.json", encoding="utf-8") as file:
            self.summary: dict[str, Any] = json.load(file)
            """summary.json: status, figures of the body, energies, state_hash."""

    @property
    def status(self) -> str:
        """"done", "failed" or "interrupted"."""
        return self.summary["status"]

    @property
    def state_hash(self) -> str:
        """Hash of the last state. Equal hashes mean equal bits."""
        return self.summary["state_hash"]

    def _table_files(self) -> dict[str, pathlib.Path]:
        files = {file.stem: file for file in sorted(self.folder.glob("probes/*.csv"))}
        for name in ("history", "failures"):
            if (self.folder / f"{name}.csv").is_file():
                files[name] = self.folder / f"{name}.csv"
        return files

    @property
    def tables(self) -> list[str]:
        """The names for table()."""
        return sorted(self._table_files())

    def table(self, name: str) -> Any:
        """Returns a table: "history", "failures", or the name of a probe.

        It is a DataFrame if pandas is installed, else a dict of NumPy arrays, one for each column.
        Raises KeyError if the run has no such table.
        """
        files = self._table_files()
        if name not in files:
            raise KeyError(f"no table {name}; the run has {', '.join(sorted(files)) or 'none'}")
        return _tables.read_table(files[name])

    def _series(self, writer: str | None) -> _vtu.Series:
        files = {file.stem: file for file in sorted(self.folder.rglob("*.pvd"))}
        series = {}
        for name, file in files.items():
            one = _vtu.Series(file)
            if one.frames and one.frames[0][1].suffix == ".vtu":
                series[name] = one
        if not series:
            raise KeyError("the run has no frames: add a stage of writers.vtu to the scene")
        if writer is None and len(series) > 1:
            raise KeyError(f"several writers have frames, name one: {', '.join(series)}")
        if writer is not None and writer not in series:
            raise KeyError(f"no frames of {writer}; the run has {', '.join(series)}")
        return series[writer] if writer is not None else next(iter(series.values()))

    def times(self, writer: str | None = None) -> np.ndarray:
        """Returns the times of the frames, s."""
        return self._series(writer).times

    def fields(self, writer: str | None = None) -> list[str]:
        """Returns the names of the fields in the frames."""
        return self._series(writer).frame(0).fields

    def field(self, name: str, frame: int = -1, writer: str | None = None) -> np.ndarray:
        """Returns a field of a frame that `writers.vtu` wrote.

        The array has a number for each particle, or a row of its components: three of a vector, six of a tensor in
        the order xx yy zz yz xz xy. Its precision is that of the file, by default float32.
        frame: number of the frame from 0; -1 is the last one.
        writer: name of the collection file without .pvd, if several writers have frames.
        """
        return self._series(writer).frame(frame).field(name)

    def points(self, frame: int = -1, writer: str | None = None) -> np.ndarray:
        """Returns the places of the particles in a frame, m: at rest, or displaced if the writer is `deformed`."""
        return self._series(writer).frame(frame).points()

    def __repr__(self) -> str:
        figures = f"{self.summary['particles']} particles, {self.summary['steps']} steps"
        return f"<Result {self.status}: {figures}, {self.folder}>"

    def _repr_html_(self) -> str:
        return _html.result_page(self)
