"""Cells that are flat or turned inside out."""
import math

from verification.case import Case, Family, Plot, near
from verification.scenes import SPACING, YOUNG, cubic, elastic, explicit, fixed, scene, stage, tag, told

NU = 0.45
FLAT = 1 / 64  # ratio of volumes below which the pressure goes on in a straight line
BULK = YOUNG / (2 * (1 + NU)) * (4 * NU - 1) / (1 - 2 * NU)  # K_v = C (4 nu - 1) / (1 - 2 nu), C = E / (2 (1 + nu))


def springs(stretch, nu):
    """Energy of the springs of a cell, J, whose height is scaled by `stretch`: four edges of a quarter spring, and
    eight diagonals of half a spring."""
    k = YOUNG * SPACING / (2 * (1 + nu))
    edges = (abs(stretch) - 1)**2
    diagonals = 4 * (math.sqrt(1 + stretch**2) - math.sqrt(2))**2
    return k * SPACING**2 / 2 * (edges + diagonals)


def pressure(J):
    y = max(J, FLAT)**(-1 / 3)
    p = 3 * BULK * y * (1 - y)
    if J >= FLAT:
        return p
    slope = BULK * y**4 * (2 * y - 1)  # dp/dJ at FLAT
    return p + slope * (J - FLAT)


def volumetric(J):
    """Energy of the volume, J: 9/2 K_v (J^(1/3) - 1)^2, below FLAT with a pressure that is linear in J."""
    inside = max(J, FLAT)
    density = 4.5 * BULK * (inside**(1 / 3) - 1)**2
    if J < FLAT:
        density += (pressure(FLAT) + pressure(J)) / 2 * (J - FLAT)
    return density * SPACING**3


def energy(stretch, nu):
    return springs(stretch, nu) + (volumetric(stretch) if nu > 0.25 else 0)


def flattened(stretch, nu=0.25, tolerance=1e-6, **more):
    """One cell; its upper face goes down to `stretch` slowly, and its sides are held."""
    name = "volumetric" if nu > 0.25 else "springs"
    return Case(f"cells/{name}_{stretch:g}" + tag(more), f"one cell, height {stretch:g}, nu {nu:g}{told(more)}",
                scene(cubic([1, 1, 1]), elastic(poisson=nu), fixed("all", "xy"), fixed("z_min", "z"),
                      stage("loads.displacement", on="z_max", axes="z", value=[0, 0, (stretch - 1) * SPACING],
                            rise=1e-3),
                      explicit(1e-3), **more),
                near(energy(stretch, nu), tolerance, "energy of the springs and of the volume, closed form"),
                lambda result: result.summary["energy"]["stored"], series="" if more else f"nu {nu:g}", at=stretch)


HEIGHTS = (0.5, 0.1, 1e-3, 0.0, -1e-3, -0.5, -1.5)
SCALE = 1e3  # the plot is in mJ
FAMILY = Family(
    "cells", "Collapsed and inverted cells",
    "A cell is pressed flat, and through itself. At height 0 its upright springs have no length and no direction, and "
    "its volume is zero; below that it is inside out. The forces must stay finite and the energies those of the "
    "closed form.",
    [flattened(a, nu) for nu in (0.25, NU) for a in HEIGHTS]
    + [flattened(a, NU, 1e-4, precision="float") for a in (0.1, -0.5)],
    Plot("height of the cell over its height at rest", "stored energy, mJ", "y",
         height=lambda outcome: outcome.value * SCALE,
         curves={f"theory, nu {nu:g}": [(n / 50, SCALE * energy(n / 50, nu)) for n in range(-75, 50)]
                 for nu in (0.25, NU)}),
    "The energies lie on the curves through the flat cell down to a height of -1.5. The border is the height 0 itself: "
    "a spring between two particles at exactly one place has no direction, and its force is no number.")
