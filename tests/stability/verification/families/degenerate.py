"""Particles at one place, springs without length, and bodies of hardly any particles."""
import math

from verification.case import Case, Error, Family, Number, Plot, near
from verification.run import Result
from verification.scenes import DENSITY, SPACING, YOUNG, cubic, elastic, explicit, mean, scene, stage, tag, told

K, MASS = 0.4 * YOUNG * SPACING, DENSITY * SPACING**3  # of a whole spring and a whole particle
WAVE = math.sqrt(2 * K / MASS)  # frequency of two particles on one spring


def listed(points, springs, *stages, **more):
    """Points and springs of a list, in mm, with particles of 1e-9 m3."""
    files = {"points.csv": "x,y,z\n" + "".join(f"{x!r},{y!r},{z!r}\n" for x, y, z in points),
             "springs.csv": "a,b\n" + "".join(f"{a},{b}\n" for a, b in springs)}
    return scene(stage("lattices.points", points="points.csv", springs="springs.csv", scale=SPACING, spacing=SPACING,
                       particle_volume=SPACING**3), elastic(), *stages, **more), files


TETRAHEDRON = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)]
EDGES = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)]


def refused(name, what, points, springs, words):
    made, files = listed(points, springs, explicit(1e-5))
    return Case(f"degenerate/{name}", what, made, Error(2, words, "no direction, or no spring of its own"), files=files)


def falling(name, what, points, springs, tolerance=1e-9, **more):
    """All particles under a common acceleration: the last point falls freely."""
    end = 1e-4
    made, files = listed(points, springs, stage("loads.gravity", acceleration=[0, 0, -1.0]), explicit(end),
                         mean("all", "body"), **more)
    return Case(f"degenerate/{name}", what, made, near(-end**2 / 2, tolerance, "free fall"),
                lambda result: result.last("probes/body", "displacement_z_min"), files=files)


def alone(**more):
    """One particle of a grid: no springs, so that a force moves it by F t^2 / 2 m."""
    end, force = 1e-4, 1e-6
    made = scene(cubic([1, 1, 1], "particles"), elastic(), stage("loads.force", on="all", total=[force, 0, 0]),
                 explicit(end, time_step=5e-7), mean("all", "body"), **more)
    return Case("degenerate/particle" + tag(more),
                "a single particle under a force" + told(more), made,
                near(force * end**2 / (2 * MASS), 1e-6 if more else 1e-12, "F t^2 / 2 m"),
                lambda result: result.last("probes/body", "displacement_x_mean"))


def meeting(speed, solver):
    """Two particles on one spring that start towards each other."""
    left, right = ({"box": {"low": [low * SPACING, -1, -1], "high": [(low + 1) * SPACING, 1, 1]}} for low in (0, 1))
    return scene(cubic([2, 1, 1], "particles"), elastic(),
                 stage("loads.start_velocity", on=left, linear=[speed, 0, 0], name="left"),
                 stage("loads.start_velocity", on=right, linear=[-speed, 0, 0], name="right"), solver,
                 mean(left, "left"))


def pair(speed, name, what, tolerance):
    """Two particles on one spring fly at each other; how far each has come after a quarter of a period."""
    steps = 400
    end = math.pi / 2 / WAVE
    made = meeting(speed, explicit(end, time_step=end / steps * (1 + 1e-9)))
    return Case(f"degenerate/{name}", what, made, near(speed / WAVE, tolerance,
                                                       "speed over the frequency sqrt(2 k / m)"),
                lambda result: result.last("probes/left", "displacement_x_mean"))


def through(safety):
    """They meet and fly through each other within a step. The force K x SPACING turns around only at the end of that
    step, up to half a step too late. That is up to 0.36 of the energy for the critical step."""
    speed = 2000.0
    made = meeting(speed, explicit(2 / WAVE, safety=safety, energy_tolerance=0, approach_limit=0))
    return Case(f"degenerate/through_{safety:g}",
                f"two particles fly through each other, {safety:g} of the critical step", made,
                Number(1, 0.36 * safety, "energy: at the end over at the start"), Result.energy_kept, series="energy",
                at=safety)


def stopped():
    """The same with the guard as it is by default."""
    return Case("degenerate/through_stopped", "two particles about to fly through each other, approach_limit 0.5",
                meeting(2000.0, explicit(2 / WAVE, safety=0.9)), Error(3, "come nearer by", "a guard while running"))


CLOSE = [10.0**-n for n in (1, 3, 6, 9)]


def close(distance):
    """A short spring beside others: it is as stiff as they are, so that the body swings as if it were not short."""
    return falling(f"close_{distance:.0e}", f"two particles {distance:g} spacings apart, in free fall",
                   [*TETRAHEDRON, (1.0, distance, 0.0)], [*EDGES, (1, 4), (0, 4), (2, 4), (3, 4)], 1e-7)


FAMILY = Family(
    "degenerate", "Particles at one place, springs without length, bodies of hardly any particles",
    "A spring without length has no direction, two particles at one place are joined by nothing that can be computed, "
    "and a body of one particle has no waves that would give a critical step. Input of the first two kinds must be "
    "refused.",
    [refused("coincident", "two particles at one place, no spring between them", [*TETRAHEDRON, (1.0, 0.0, 0.0)],
             [*EDGES, (0, 4), (2, 4), (3, 4)], "a place of its own"),
     refused("no_length", "a spring between two particles at one place", [*TETRAHEDRON, (1.0, 0.0, 0.0)],
             [*EDGES, (1, 4)], "a place of its own"),
     refused("to_itself", "a spring from a particle to itself", TETRAHEDRON, [*EDGES, (2, 2)], "springs.csv"),
     refused("twice", "two springs between the same particles", TETRAHEDRON, [*EDGES, (1, 0)], "springs.csv"),
     falling("isolated", "a particle without springs beside a body, in free fall", [*TETRAHEDRON, (5.0, 5.0, 5.0)],
             EDGES),
     falling("isolated_float", "the same, precision float", [*TETRAHEDRON, (5.0, 5.0, 5.0)], EDGES, 1e-5,
             precision="float")]
    + [close(distance) for distance in CLOSE]
    + [alone(), alone(precision="float")]
    + [pair(speed, f"spring_{speed:.0e}", f"a single spring, {speed:g} m/s", 1e-5)
       for speed in (1e-9, 1e-3, 1.0, 100.0)]
    + [through(safety) for safety in (0.01, 0.03, 0.1, 0.3, 0.9)] + [stopped()],
    Plot("step over critical step", "change of the energy over the energy", "xy",
         curves={"bound": [(0.01, 0.0036), (0.9, 0.9 * 0.36)]}),
    "Two particles on one spring that fly through each other change their energy by less than the bound, which is in "
    "proportion to the step. Above a seventh of the critical step the bound is more than the energy balance of a run "
    "allows (5 %).")
