"""Hyperlattice: the four-dimensional lattice spring model of solids.

    import hyperlattice
    result = hyperlattice.run("scene.json")
    result.table("history")
    result.field("displacement", frame=-1)

A scene is a dict or the name of a scene file; stages of a dict may hold Python functions. See docs/guide/python.md.
"""
from ._core import version as __version__
from ._errors import Error, Fault, FunctionError, OutsideError, RunError, SceneError
from ._functions import Frame, LoadState, SpringState
from ._plan import Plan, plan
from ._result import Result
from ._run import run
from ._simulation import Simulation
from ._tools import analyze, calibrate, study

__all__ = ["Error", "Fault", "Frame", "FunctionError", "LoadState", "OutsideError", "Plan", "Result", "RunError",
           "SceneError", "Simulation", "SpringState", "analyze", "calibrate", "plan", "run", "study", "__version__"]
