"""Runs the scene of a case with the installed program and reads what it left."""
import csv
import json
import os
import pathlib
import subprocess
import tempfile
import time

import numpy as np

from verification.case import Outcome

PATIENCE = 300  # s, after which a run is ended


class Result:
    """What a run left in its folder."""

    def __init__(self, folder):
        self.folder = folder
        self.summary = json.loads((folder / "summary.json").read_text())

    def table(self, name):
        """The columns of a table of numbers, by name."""
        with open(self.folder / f"{name}.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        return {key: np.array([float(row[key]) for row in rows]) for key in rows[0]}

    def last(self, name, column):
        return self.table(name)[column][-1]

    def energy_kept(self):
        """Kinetic and stored energy at the end over that at the start."""
        history = self.table("history")
        energy = history["kinetic"] + history["stored"]
        return energy[-1] / energy[0]


def run(program, case):
    with tempfile.TemporaryDirectory(prefix="hyperlattice_verify_") as name:
        folder = pathlib.Path(name)
        for file, text in {**case.files, "scene.json": json.dumps(case.scene)}.items():
            (folder / file).write_text(text, encoding="utf-8")
        out = folder / "out"
        command = [program, "run", folder / "scene.json", "--out", out, "--threads", "1", "--quiet"]
        start = time.monotonic()
        try:
            done = subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE, check=False,
                                  env={**os.environ, "OMP_WAIT_POLICY": "passive"})
        except subprocess.TimeoutExpired:
            return Outcome(case, -1, f"no end within {PATIENCE} s", None, None, None, PATIENCE)
        seconds = time.monotonic() - start
        value = drift = step = None
        if (out / "summary.json").is_file():
            result = Result(out)
            drift = abs(result.summary["energy"]["relative_error"] or 0)
            if result.summary.get("time_step"):
                step = result.summary["time_step"] / result.summary["critical_time_step"]
            if done.returncode == 0 and case.measure:
                value = float(case.measure(result))
        return Outcome(case, done.returncode, done.stderr.strip().replace(f"{name}/", ""), value, drift, step, seconds)
