"""Springs that break in states of rest and at the ends of implicit steps."""
import csv

from verification.case import Case, Error, Family, Number, Plot, near
from verification.scenes import SPACING, box, cubic, elastic, fixed, implicit, scene, stage, static

CELLS, PULL = 10, 3e-3  # particles in a row; strain at the end
WEAK = 1e-3  # strain at which the springs of one particle break


def row(solver, load, limit=WEAK):
    """A row of particles whose sides are held; the springs of one of them are weak."""
    failure = {"type": "failures.strain", "limit": 1.0}
    weak = elastic(name="weak", region=box([4, 0, 0], [5, 1, 1]), failure={**failure, "limit": limit})
    return scene(cubic([CELLS, 1, 1], "particles"), elastic(failure=failure), weak, fixed("all", "yz"),
                 fixed("x_min", "x"), load, solver)


def moved(time):
    return stage("loads.displacement", on="x_max", axes="x", value=[PULL * (CELLS - 1) * SPACING, 0, 0], rise=time)


def first(result):
    """Time of the first failure."""
    with open(result.folder / "failures.csv", encoding="utf-8") as file:
        return float(next(csv.DictReader(file))["time"])


def at_rest(steps, overshoot=1e-3):
    return Case(f"tearing/rest_{steps}_{overshoot:g}", f"at rest, {steps} load steps, overshoot {overshoot:g}: load of "
                "the first failure", row(static(end_time=1, load_steps=steps, overshoot=overshoot), moved(1)),
                near(WEAK / PULL, overshoot * 1.01, "limit over strain at the end"), first,
                series="at rest", at=steps)


def in_time(steps, overshoot=1e-2):
    time = 1e-2  # s: ten thousand times that of a wave through the row
    return Case(f"tearing/implicit_{steps}", f"{steps} implicit steps or more: time of the first failure",
                row(implicit(time, time / steps), moved(time)),
                near(WEAK / PULL * time, overshoot * 1.2, "limit over strain at the end"), first,
                series="implicit steps", at=steps)


def torn(name, limit, force):
    """A force that the row cannot carry."""
    load = stage("loads.force", on="x_max", total=[force, 0, 0], rise=1)
    return Case(f"tearing/{name}", f"a force that the row cannot carry, limit {limit:g}",
                row(static(end_time=1), load, limit), Error(3, "springs broke", "a torn row has no state of rest"))


def energy():
    """The stored energy of the whole row goes at the failure; none is left at the end."""
    def gone(result):
        of = result.summary["energy"]
        return (of["dissipated"] - of["injected"]) / of["injected"]

    return Case("tearing/energy", "at rest: energy that goes with the springs, less the work",
                row(static(end_time=1, load_steps=5), moved(1)), Number(0, 1e-9, "conservation"), gone)


STIFFNESS = 0.4 * 1e9 * SPACING  # of a spring, N/m
FAMILY = Family(
    "tearing", "Springs that break at rest and in long steps",
    "A step, of load or of time, may go far beyond the first failure. It has to be cut, so that the failure does not "
    "depend on the length of the steps.",
    [at_rest(steps) for steps in (1, 3, 10, 100)] + [at_rest(1, 1e-1), at_rest(1, 1e-5)]
    + [in_time(steps) for steps in (10, 100, 1000)]
    + [torn("torn", WEAK, 2 * STIFFNESS * WEAK * SPACING), torn("torn_soft", 1e-9, 2e-9 * STIFFNESS * SPACING),
       energy()],
    Plot("steps", "error of the load or the time", "xy"),
    "The error stays below `overshoot`, 1e-3 at rest and 1e-2 in time, for any number of steps.")
