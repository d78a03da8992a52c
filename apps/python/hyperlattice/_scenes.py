"""Scenes as users give them: a dict, or the name of a file."""
from __future__ import annotations

import json
import os
import pathlib
from collections.abc import Mapping
from typing import Any, Union

import numpy as np

from . import _core
from ._functions import Functions

Scene = Union[Mapping, str, "os.PathLike[str]"]
"""A scene: a dict, whose relative file names count from the current folder, or the name of a scene file. Stages of the
dict may hold Python functions, see docs/guide/python.md."""

MOST_THREADS = 4096
_FUNCTIONS_PLUGIN = pathlib.Path(__file__).with_name("python_functions.so")


def _plain(value: Any) -> Any:
    """Turns values of NumPy and paths into values of JSON."""
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    raise TypeError(f"a scene cannot hold a {type(value).__name__}: {value!r}")


def as_json(value: Any) -> str:
    return json.dumps(value, default=_plain)


def settings_list(settings: Mapping[str, Any] | None) -> list[str]:
    """The arguments of --set: {"/pipeline/1/poisson": 0.1} gives ["/pipeline/1/poisson=0.1"]."""
    return [f"{pointer}={as_json(value)}" for pointer, value in (settings or {}).items()]


def thread_number(threads: int | None) -> int:
    if threads is None:
        return 0
    if isinstance(threads, bool) or threads != int(threads) or not 1 <= threads <= MOST_THREADS:
        raise ValueError(f"threads: {threads!r}: expected a whole number from 1 to {MOST_THREADS}")
    return int(threads)


def scene_arguments(scene: Scene, settings: Mapping[str, Any] | None, threads: int | None) -> dict[str, Any]:
    """The arguments that name a scene to the core."""
    common = {"threads": thread_number(threads), "functions": {}}
    if isinstance(scene, Mapping):
        if settings:
            raise TypeError("settings are for scene files: change the dict instead")
        found = Functions(scene)
        plain = found.scene
        if found.are_named:
            _core.connect_functions(_FUNCTIONS_PLUGIN)
            if isinstance(plain.get("plugins", []), list):  # else a fault of the scene
                plain["plugins"] = [*plain.get("plugins", []), os.fspath(_FUNCTIONS_PLUGIN)]
            common["functions"] = found.calls
        return {"text": as_json(plain), "file": "", "settings": [], **common}
    if isinstance(scene, (str, os.PathLike)):
        return {"text": None, "file": os.fspath(scene), "settings": settings_list(settings), **common}
    raise TypeError(f"a scene is a dict or the name of a file, not a {type(scene).__name__}")
