"""What a run will load, allocate and compute, known before anything is computed."""
from __future__ import annotations

import json
import os
import pathlib
from collections.abc import Mapping, Sequence
from typing import Any

from . import _core, _html
from ._functions import notes_of
from ._scenes import Scene, scene_arguments
from ._waiting import pass_on_log, wait_for


_SLOW = "Python functions, slow beside built-in components; the run time above does not count them"


class Plan(dict):
    """The keys of `hyperlattice plan --json`. `str(plan)` is the text for people."""

    def __init__(self, values: Mapping[str, Any], text: str, functions: Sequence[Mapping[str, str]] = ()):
        """functions: the notes on Python functions, which only a plan of Python has, as "python_functions"."""
        super().__init__(values)
        if functions:
            self["python_functions"] = [dict(one) for one in functions]
            lines = [f"  {one['pointer']} {one['type']} calls {one['function']} {one['called']}\n" for one in functions]
            text = f"{text.rstrip()}\n{_SLOW}\n{''.join(lines)}"
        self.text = text

    def __str__(self) -> str:
        return self.text

    def _repr_html_(self) -> str:
        return _html.plan_page(self)


def plan(scene: Scene, threads: int | None = None, *, settings: Mapping[str, Any] | None = None,
         out: str | os.PathLike[str] | None = None) -> Plan:
    """Checks a scene and says what a run of it will do; writes nothing.

    scene: a dict, or the name of a scene file.
    threads: number of threads; None: as the program chooses.
    settings: values to replace in a scene file, {"/pipeline/1/poisson": 0.1}.
    out: the folder that the results would go to; its disk must have room for them.

    Raises SceneError with all faults of the scene, and OutsideError if a plugin cannot be loaded.
    """
    arguments = scene_arguments(scene, settings, threads)
    work = _core.plan(**arguments, out=pathlib.Path(out) if out else pathlib.Path())
    wait_for(work)
    try:
        found = json.loads(work.result())
    finally:
        pass_on_log(work)
    return Plan(found["plan"], found["text"], notes_of(arguments["functions"]))
