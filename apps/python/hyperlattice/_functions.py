"""Python functions as components of a scene: loads.python, failures.python and writers.python."""
from __future__ import annotations

import json
import pathlib
import traceback
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Callable, Iterator

import numpy as np

from ._code_hash import hash_of
from ._errors import SceneError

KINDS = {"loads.python": "in each evaluation of all forces, which is once in each step and for each record",
         "failures.python": "in each step, after a pass over all springs",
         "writers.python": "for each frame"}
"""The components, and when each of them calls its function."""


@dataclass(frozen=True)
class LoadState:
    """What the function of loads.python gets. Arrays have a row for each loaded particle, and may be kept."""

    time: float
    """s, of the start of the step."""
    displacement: np.ndarray
    """(n, 3) m."""
    velocity: np.ndarray
    """(n, 3) m/s, half a step before the time."""
    positions: np.ndarray
    """(n, 3) m, at rest. The same array in each call; it cannot be written."""
    mass: np.ndarray
    """(n,) kg. As positions."""
    share: np.ndarray
    """(n,) fraction of a whole particle; below 1 at the surface of a body of cells. As positions."""
    particles: np.ndarray
    """(n,) numbers of the particles in the body. As positions."""


@dataclass(frozen=True)
class SpringState:
    """What the function of failures.python gets. Arrays have an entry for each spring, and may be kept.

    The order of the springs is the same in each run of a scene, for any number of threads.
    """

    time: float
    """s."""
    time_step: float
    """Length of the last step, s; 0 at the start and in states of rest."""
    elongation: np.ndarray
    """m."""
    rest_length: np.ndarray
    """m."""
    stiffness: np.ndarray
    """N/m."""
    rate: np.ndarray
    """Rate of elongation half a step before the time, m/s."""
    spring_class: np.ndarray
    """Class of the springs in the lattice."""
    a: np.ndarray
    """Number of the first end."""
    b: np.ndarray
    """Number of the second end, above a."""

    @property
    def strain(self) -> np.ndarray:
        """Elongation over rest length."""
        return self.elongation / self.rest_length


@dataclass(frozen=True)
class Frame(Mapping):
    """What the function of writers.python gets: a mapping from names of fields to arrays, which may be kept.

    An array has a number for each particle, or a row of its components.
    """

    time: float
    """s."""
    step: int
    """Step of the run."""
    number: int
    """Number of the frame, from 0. A resumed run goes on after the frames before."""
    particles: np.ndarray
    """(n,) numbers of the particles in the body."""
    positions: np.ndarray
    """(n, 3) m, at rest."""
    fields: dict[str, np.ndarray]
    _announce: Callable[[str], str] | None = field(repr=False)

    def file(self, name: str) -> pathlib.Path:
        """Makes a file of the run's folder known to the run, and returns its path. The function writes it then.

        Raises RuntimeError for a file that does not belong to the run, and after the function has returned.
        """
        if self._announce is None:
            raise RuntimeError("the frame is over: its function has returned")
        return pathlib.Path(self._announce(name))

    def __getitem__(self, name: str) -> np.ndarray:
        return self.fields[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self.fields)

    def __len__(self) -> int:
        return len(self.fields)


class Call:
    """A function of a scene, and what the core calls for it."""

    def __init__(self, pointer: str, kind: str, name: str, function: Callable[[Any], Any]):
        self.pointer, self.kind, self.name, self.function = pointer, kind, name, function
        self.code = hash_of(function)
        self.error: BaseException | None = None
        self._body: tuple[np.ndarray, ...] = ()

    def begin(self, particles: np.ndarray, positions: np.ndarray, mass: np.ndarray, share: np.ndarray) -> None:
        """Gets the particles of a load, before its forces are asked for."""
        self._body = (positions, mass, share, particles)
        for array in self._body:
            array.setflags(write=False)

    def __call__(self, *arguments: Any) -> Any:
        """Calls the function. The core reports an exception by its text; `error` keeps the exception itself."""
        try:
            return {"loads.python": self._forces, "failures.python": self._broken,
                    "writers.python": self._write}[self.kind](*arguments)
        except BaseException as error:  # SystemExit too must end the run, not the thread that calls
            self.error = self.error or error
            raise RuntimeError(f"{self.name}: {_sentence(error)}") from None

    def _forces(self, time: float, displacement: np.ndarray, velocity: np.ndarray) -> np.ndarray:
        answer = np.asarray(self.function(LoadState(time, displacement, velocity, *self._body)))
        if answer.shape != displacement.shape:
            raise ValueError(f"expected forces of the shape {displacement.shape}, not {answer.shape}")
        if answer.dtype.kind not in "fiu":
            raise TypeError(f"expected forces of real numbers, not of {answer.dtype}")
        wrong = np.flatnonzero(~np.isfinite(answer).all(axis=1))
        if wrong.size:
            raise ValueError(f"the force on particle {self._body[-1][wrong[0]]} is {answer[wrong[0]]} at "
                             f"{time:.6g} s: expected finite numbers")
        return np.ascontiguousarray(answer, dtype=np.float64)

    def _broken(self, *arguments: Any) -> np.ndarray:
        springs = SpringState(*arguments)
        answer = np.asarray(self.function(springs))
        if answer.shape != springs.elongation.shape:
            raise ValueError(f"expected a boolean for each spring, shape {springs.elongation.shape}, "
                             f"not {answer.shape}")
        if answer.dtype != np.bool_:
            raise TypeError(f"expected an array of bool, not of {answer.dtype}")
        return np.ascontiguousarray(answer)

    def _write(self, *arguments: Any) -> None:
        frame = Frame(*arguments)
        try:
            self.function(frame)
        finally:
            object.__setattr__(frame, "_announce", None)


def _sentence(error: BaseException) -> str:
    """The exception, and the line of the function that raised it."""
    text = f"{type(error).__name__}: {error}" if str(error) else type(error).__name__
    lines = [line for line in traceback.extract_tb(error.__traceback__) if line.filename != __file__]
    return f"{text} ({lines[-1].filename}, line {lines[-1].lineno})" if lines else text


def _name_of(function: Callable[..., Any]) -> str:
    """The name of a function, of its class if it is an object, or of the function that functools.partial fixes."""
    function = getattr(function, "func", function)
    named = function if hasattr(function, "__qualname__") else type(function)
    return f"{named.__module__}.{named.__qualname__}"


class Functions:
    """The functions of one scene, and the scene with their names in their places."""

    def __init__(self, scene: Mapping):
        self.calls: dict[str, Call] = {}
        self.are_named = False  # whether a stage of the scene calls a function, or should
        self.scene = self._without_functions(scene, "")

    def _without_functions(self, value: Any, pointer: str) -> Any:
        if isinstance(value, (list, tuple)):
            return [self._without_functions(entry, f"{pointer}/{n}") for n, entry in enumerate(value)]
        if not isinstance(value, Mapping):
            return value
        plain = {key: self._without_functions(entry, f"{pointer}/{key}") for key, entry in value.items()}
        function, kind = plain.get("function"), plain.get("type")
        if not isinstance(kind, str) or kind not in KINDS:
            return plain
        self.are_named = True
        if callable(function):
            name = self._free_name(_name_of(function))
            self.calls[name] = call = Call(pointer, kind, name, function)
            plain.update(function=name, code=call.code)
        return plain

    def _free_name(self, name: str) -> str:
        """The name, with a number if the scene has a function of this name already."""
        number, free = 1, name
        while free in self.calls:
            number += 1
            free = f"{name} ({number})"
        return free


def raised_in(calls: Mapping[str, Call]) -> BaseException | None:
    """The exception that one of the functions has raised."""
    return next((call.error for call in calls.values() if call.error is not None), None)


def notes_of(calls: Mapping[str, Call]) -> list[dict[str, str]]:
    """What a plan says about the functions."""
    return [{"pointer": call.pointer, "type": call.kind, "function": call.name, "called": KINDS[call.kind]}
            for call in calls.values()]


def check_unchanged(calls: Mapping[str, Call], folder: pathlib.Path) -> None:
    """Raises SceneError if the run in a folder had functions of the same names with other code."""
    try:
        before = json.loads((folder / "scene.resolved.json").read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return  # the run itself says what is missing
    codes = dict(_codes_in(before))
    faults = []
    for call in calls.values():
        if codes.get(call.name, call.code) != call.code:
            expected = ("expected the function of the run that is resumed: its code, or a value that it uses, is "
                        "another one now")
            faults.append((f"{call.pointer}/function", call.name, expected,
                           f"{call.pointer}/function: {call.name}: {expected}"))
    if faults:
        raise SceneError("\n".join(fault[-1] for fault in faults), faults)


def _codes_in(value: Any) -> Iterator[tuple[str, str]]:
    """The names and the hashes of the functions of a scene."""
    if isinstance(value, dict):
        if value.get("type") in KINDS:
            yield value.get("function", ""), value.get("code", "")
        value = list(value.values())
    if isinstance(value, list):
        for entry in value:
            yield from _codes_in(entry)
