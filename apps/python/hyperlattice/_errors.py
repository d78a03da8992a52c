"""The errors of the package. Each message is the one that the program prints."""
from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from ._result import Result


class Fault(NamedTuple):
    """One fault of a scene, a study or a choice."""

    pointer: str
    """JSON pointer of the value, for example "/pipeline/2/peak"; the name of an argument; or empty."""
    value: str
    """The wrong value as written; may be empty."""
    expected: str
    """What was expected, with the nearest valid name if there is one."""
    message: str
    """The whole line of the program."""


class Error(Exception):
    """What all errors of this package have in common."""


class SceneError(Error, ValueError):
    """The input is wrong (exit code 2 of the program); nothing was written. Its message has a line of each fault."""

    def __init__(self, message: str, faults=()):
        super().__init__(message)
        self.faults = [Fault(*fault) for fault in faults]

    def __reduce__(self):
        return type(self), (str(self), self.faults)


class RunError(Error, RuntimeError):
    """The run failed (exit code 3): it is unstable, has lost its energy balance, or finds no state of rest."""

    def __init__(self, message: str, result: Result | None = None):
        super().__init__(message)
        self.result = result
        """What the run has left, up to its failure."""


class OutsideError(Error, OSError):
    """Something outside of the run failed (exit code 4): the disk, the memory, or a plugin."""

    def __init__(self, message: str, result: Result | None = None):
        super().__init__(message)
        self.result = result
        """What the run has left, or None if it left nothing."""


class FunctionError(OutsideError):
    """A Python function of the scene raised an exception, or returned something else than it must.

    Its cause is the exception of the function, with its traceback.
    """
