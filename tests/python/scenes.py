"""Scenes and helpers that the tests of the Python package share."""
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["HYPERLATTICE_PROGRAM"]
BUILD = pathlib.Path(os.environ["HYPERLATTICE_BUILD"])


def bar(high=("8 mm", "4 mm", "4 mm"), end="20 us", stages=(), material=None, lattice=None):
    """A bar that a moving end pulls."""
    return {"format": "hyperlattice/1", "title": "Bar", "pipeline": [
        {"type": "lattices.cubic", "spacing": "1 mm", "boundary": "cells",
         "shape": {"box": {"low": [0, 0, 0], "high": list(high)}}, **(lattice or {})},
        {"type": "materials.elastic", "young": "10 GPa", "poisson": 0.2, "density": 2500, "membrane": "I-m",
         **(material or {})},
        {"type": "loads.velocity", "on": "x_max", "value": ["1 m/s", 0, 0], "rise": "1 us"},
        {"type": "solvers.explicit", "end_time": end}, *stages]}


def free_block(**lattice):
    """A block without loads. With these particles the state is one array in memory: rows of 8."""
    return {"format": "hyperlattice/1", "pipeline": [
        {"type": "lattices.cubic", "spacing": "1 mm", "boundary": "particles",
         "shape": {"box": {"low": [0, 0, 0], "high": ["8 mm", "4 mm", "3 mm"]}}, **lattice},
        {"type": "materials.elastic", "young": "10 GPa", "poisson": 0.2, "density": 2500, "membrane": "I-m"},
        {"type": "solvers.explicit", "end_time": "20 us"}]}


class FolderTest(unittest.TestCase):
    """Tests with a folder of their own, which is also the current folder."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder)

    def write(self, scene, name="scene.json"):
        (self.folder / name).write_text(json.dumps(scene))
        return self.folder / name

    def program(self, *words):
        """Runs the program; returns its standard output."""
        done = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout
