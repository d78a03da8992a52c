"""Implicit steps of 10, 100 and 1000 critical ones."""
from verification.bars import Bar
from verification.case import Case, Family, Number, Plot, near
from verification.scenes import implicit, tag, told
from verification.theory import midpoint

RULE = "chain of masses under the implicit rule, closed form"
CONTRAST = 1e6  # the critical step is that of the stiff half, a thousandth of that of the soft half
PERIOD = 20 * 1000  # of the soft half, about, in critical steps


def bar():
    return Bar([(4, CONTRAST, 1), (4, 1, 1)])


def swinging(factor, tolerance=1e-4, **more):
    """A swing of the soft half, in steps of `factor` critical ones."""
    of = bar()
    step = factor * of.critical()
    end = PERIOD // factor * step
    return Case(f"implicit/steps_{factor}" + tag(more),
                f"bar, half of it {CONTRAST:g} times as stiff, steps of {factor} critical ones{told(more)}",
                of.scene(implicit(end, step * (1 + 1e-9), residual=1e-8), **more),
                near(of.moved(end, midpoint(step)), tolerance, RULE), of.measured,
                series="" if more else "steps of fixed length", at=factor)


def energy(factor):
    of = bar()
    step = factor * of.critical()
    end = PERIOD // factor * step
    return Case(f"implicit/energy_{factor}", f"the same bar, its energy, steps of {factor} critical ones",
                of.scene(implicit(end, step * (1 + 1e-9), residual=1e-8)),
                Number(1, 1e-6, "kinetic and stored energy over the work of the force"), kept)


def kept(result):
    energy_of = result.summary["energy"]
    return (energy_of["kinetic"] + energy_of["stored"]) / energy_of["injected"]


def damped():
    """Euler's backward method takes all motion out: the bar comes to rest."""
    of = bar()
    end = 100 * PERIOD * of.critical()
    return Case("implicit/damped", "the same bar, damping 1, 100 steps of 20,000 critical ones",
                of.scene(implicit(end, PERIOD * of.critical(), damping=1)), near(1, 1e-5, "the state of rest"),
                of.measured)


def automatic(tolerance):
    of = bar()
    end = PERIOD * of.critical()
    stage = implicit(end, "auto", tolerance=tolerance, residual=1e-8)
    truth = of.moved(end, midpoint(1e-3 * of.critical()))

    def share(result):
        return abs(of.measured(result) - truth) / (2 * tolerance * result.summary["steps"])

    return Case(f"implicit/auto_{tolerance:.0e}",
                f"the same bar, steps from the tolerance {tolerance:g}: error over what is allowed",
                of.scene(stage), Number(0.5, 0.5, "at most tolerance x steps x largest displacement"), share)


def incompressible():
    of = Bar([(8, 1, 1)], poisson=0.499)
    step = 10 * of.critical()
    return Case("implicit/nu_0.499", "bar of nu 0.499, 40 steps of 10 critical ones",
                of.scene(implicit(40 * step, step * (1 + 1e-9), residual=1e-8)),
                near(of.moved(40 * step, midpoint(step)), 1e-5, RULE), of.measured)


FAMILY = Family(
    "implicit", "Implicit steps of 10, 100 and 1000 critical ones",
    "A stiff half makes the critical step a thousandth of what the soft half needs. The implicit rule is stable for "
    "any step, and keeps the energy; it swings too slowly by a known factor. Tolerances are those of this factor, not "
    "of the continuum.",
    [swinging(factor) for factor in (10, 30, 100, 300, 1000)]
    + [swinging(100, 1e-3, precision="float")]
    + [energy(factor) for factor in (100, 1000)]
    + [damped(), automatic(1e-3), automatic(1e-4), incompressible()],
    Plot("step over critical step", "error of the displacement", "xy"),
    "The displacement is that of the closed form of the implicit rule for steps of 10 to 1000 critical ones: 1000 "
    "critical steps are a twentieth of the period.")
