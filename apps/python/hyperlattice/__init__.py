"""Hyperlattice: the four-dimensional lattice spring model of solids.

    import hyperlattice
    result = hyperlattice.run("scene.json")
    result.table("history")
    result.field("displacement", frame=-1)

A scene is a dict or the name of a scene file. See docs/guide/python.md.
"""
from ._core import version as __version__
from ._errors import Error, Fault, OutsideError, RunError, SceneError
from ._plan import Plan, plan
from ._result import Result
from ._run import run
from ._simulation import Simulation
from ._tools import analyze, calibrate, study

__all__ = ["Error", "Fault", "OutsideError", "Plan", "Result", "RunError", "SceneError", "Simulation", "analyze",
           "calibrate", "plan", "run", "study", "__version__"]
