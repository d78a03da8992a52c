"""A case: a scene, what must come out of it, and where this is known from."""
from collections.abc import Callable
from dataclasses import dataclass, field


LEAST = 1e-16


@dataclass(frozen=True)
class Number:
    """A number that a run must give. `tolerance`: largest difference, in the unit of the number."""
    value: float
    tolerance: float
    truth: str  # where the number comes from, in a few words

    def holds(self, outcome):
        return outcome.value is not None and abs(outcome.value - self.value) <= self.tolerance

    def __str__(self):
        return f"{self.value:.6g} ± {self.tolerance:.1g}: {self.truth}"


def near(value, share, truth):
    """The number `value` to a share of itself."""
    return Number(value, abs(value) * share, truth)


@dataclass(frozen=True)
class Error:
    """An error that the program must end with: its exit code, and words of its message."""
    code: int
    words: str
    truth: str

    def holds(self, outcome):
        return outcome.code == self.code and self.words in outcome.message

    def __str__(self):
        return f"exit code {self.code}, \"{self.words}\": {self.truth}"


@dataclass(frozen=True)
class Case:
    name: str
    what: str  # what is extreme about it, for the page
    scene: dict
    expected: Number | Error
    measure: Callable | None = None  # the number of a run that has ended with 0
    files: dict = field(default_factory=dict)  # name: text, beside the scene
    series: str = ""  # the curve of the family's plot that the case belongs to; none if empty
    at: float = 0  # its abscissa there


@dataclass(frozen=True)
class Outcome:
    case: Case
    code: int
    message: str
    value: float | None
    drift: float | None  # |error of the energy balance| over the gross energy
    step: float | None  # step over critical step
    seconds: float

    @property
    def as_expected(self):
        return self.case.expected.holds(self)

    @property
    def error(self):
        """The distance from the expected number, as a share of it; at least LEAST, for logarithmic scales."""
        return max(abs(self.value / self.case.expected.value - 1), LEAST)

    @property
    def distance(self):
        """The distance from the expected number, at least LEAST."""
        return max(abs(self.value - self.case.expected.value), LEAST)


@dataclass(frozen=True)
class Plot:
    x: str
    y: str
    log: str = ""  # axes with a logarithmic scale, such as "xy"
    height: Callable = lambda outcome: outcome.error
    curves: dict = field(default_factory=dict)  # title: list of (x, y) from theory


@dataclass(frozen=True)
class Family:
    name: str  # also of the plot's file
    title: str
    why: str  # what is tested and why it is hard
    cases: list
    plot: Plot
    reading: str  # what the plot shows
