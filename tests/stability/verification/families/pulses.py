"""Loads that are shorter than a step or begin within one, and impacts within a step."""
import math

from verification.case import Case, Family, Number, Plot, near
from verification.scenes import DENSITY, SPACING, YOUNG, cubic, elastic, explicit, mean, scene, stage, tag, told

STEP, FORCE = 4e-7, 1e-3  # s, N
K, MASS = 0.4 * YOUNG * SPACING, DENSITY * SPACING**3
IMPULSE = "impulse: integral of the force"


def pushed(name, what, load, impulse, steps=40, tolerance=1e-9, series="", at=0, **more):
    """A free block; its momentum is the impulse of the load."""
    return Case(f"pulses/{name}", what,
                scene(cubic([3, 3, 3]), elastic(), load, explicit(steps * STEP, time_step=STEP * (1 + 1e-9)), **more),
                near(impulse, tolerance, IMPULSE), lambda result: result.last("history", "momentum_x"), series=series,
                at=at)


def rectangle(length, start=10.3, **more):
    """A force that lasts `length` steps."""
    begin, end = start * STEP, (start + length) * STEP
    load = stage("loads.expression", on="x_min", total=[FORCE, 0, 0], corners=[begin, end],
                 expression=f"t < {begin!r} ? 0 : (t < {end!r} ? 1 : 0)")
    return pushed(f"rectangle_{length:g}" + tag(more),
                  f"rectangular pulse of {length:g} steps" + told(more), load,
                  FORCE * length * STEP, tolerance=1e-5 if more else 1e-9, **more)


def actuation(name, what, area, **form):
    load = stage("loads.actuation", on="x_min", pressure=FORCE / (9 * SPACING**2), **form)
    return pushed(name, what, load, FORCE * area, steps=800, tolerance=1e-6)


def begun(phase):
    """A force that begins at a share of a step and stays."""
    return pushed(f"begun_{phase:g}", f"force that begins after {phase:g} of a step",
                  stage("loads.actuation", on="x_min", pressure=FORCE / (9 * SPACING**2), start=(10 + phase) * STEP),
                  FORCE * (30 - phase) * STEP, tolerance=1e-6)


def bounce(phase, step):
    """A particle meets a floor after 20 + phase steps. The spring of the floor sets in at the next instant only: in
    closed form this changes the energy by at most theta^2 / 4, theta = sqrt(c / m) step, on the way in and back on the
    way out."""
    speed, theta = 1.0, math.sqrt(K / MASS) * step
    steps = 60 + int(math.pi / theta)
    floor = -(20 + phase) * step * speed
    series = f"floor, step {theta:.2g}"
    return Case(f"pulses/bounce_{phase:g}_{theta:.2g}",
                f"particle on a floor after {20 + phase:g} steps, step {theta:.2g} sqrt(m / c)",
                scene(cubic([1, 1, 1], "particles"), elastic(), stage("loads.start_velocity", linear=[0, 0, -speed]),
                      stage("loads.floor", on="all", point=[0, 0, floor], damping=0, stiffness=K),
                      explicit(steps * step, time_step=step * (1 + 1e-9)), mean("all", "body", field="velocity")),
                Number(1, theta**2 / 8, "elastic impact; energy to theta^2 / 4"),
                lambda result: result.last("probes/body", "velocity_z_mean") / speed, series=series, at=phase)


def collision(phase, step):
    """Two particles meet after 1100 + phase steps, and exchange their velocities."""
    reach, theta = 0.9, math.sqrt(2 * K / MASS) * step
    speed = (2 - reach) * SPACING / 2 / (1100 + phase) / step
    right = {"box": {"low": [1.5 * SPACING, -1, -1], "high": [1, 1, 1]}}
    left = {"box": {"low": [-1, -1, -1], "high": [1.5 * SPACING, 1, 1]}}
    lattice = stage("lattices.cubic", spacing=SPACING, anchor=[0, 0, 0],
                    shape={"union": [{"box": {"low": [n * SPACING, 0, 0],
                                              "high": [(n + 1) * SPACING, SPACING, SPACING]}} for n in (0, 2)]})
    return Case(f"pulses/collision_{phase:g}", f"two particles meet after {1100 + phase:g} steps",
                scene(lattice, elastic(), stage("loads.start_velocity", on=left, linear=[speed, 0, 0], name="left"),
                      stage("loads.start_velocity", on=right, linear=[-speed, 0, 0], name="right"),
                      stage("loads.contact", reach=reach, stiffness=K),
                      explicit(1200 * step, time_step=step * (1 + 1e-9)),
                      mean(left, "left", field="velocity")),
                Number(-1, theta**2 / 8, "elastic collision; energy to theta^2 / 4"),
                lambda result: result.last("probes/left", "velocity_x_mean") / speed, series="two particles, step 0.45",
                at=phase)


BOUND = 6e-7**2 * K / MASS / 8
PHASES = (0.0, 0.25, 0.5, 0.75)
FAMILY = Family(
    "pulses", "Pulses shorter than a step, and impacts within a step",
    "A load that is evaluated at instants misses what happens between them: a pulse of a thousandth of a step would "
    "act never or a thousand times too long. An impact within a step is noticed at the next instant only.",
    [rectangle(length) for length in (1e-6, 1e-3, 0.1, 0.5, 1.5)] + [rectangle(1e-3, precision="float")]
    + [actuation("half_sine", "half sine of a hundredth of a step", 2 / math.pi * 0.01 * STEP, form="half_sine",
                 duration=0.01 * STEP, start=7.7 * STEP),
       actuation("train", "1000 triangles of 0.1 steps, 0.37 steps apart", 1000 * 0.05 * STEP, form="triangle",
                 rise=0.03 * STEP, fall=0.07 * STEP, period=0.37 * STEP, pulses=1000)]
    + [begun(phase) for phase in (0.1, 0.5, 0.999)]
    + [bounce(phase, step) for step in (6e-7, 1e-7) for phase in PHASES]
    + [collision(phase, 5e-7) for phase in PHASES],
    Plot("share of a step after which the bodies touch", "speed after the impact over that before",
         height=lambda outcome: abs(outcome.value),
         curves={"bound, step 0.38": [(0, 1 + BOUND), (0.75, 1 + BOUND), (0.75, 1 - BOUND), (0, 1 - BOUND)]}),
    "The speed after an impact depends on the instant within the step at which the bodies touch, and stays within the "
    "bound theta^2 / 8 of the closed form, theta = step x sqrt(c / m). Steps are given in sqrt(m / c). Impulses of "
    "loads do not depend on it at all.")
