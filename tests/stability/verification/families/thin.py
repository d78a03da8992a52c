"""Rods and plates one cell thick, and bars 20,000 times as long as thick."""
from verification.case import Case, Family, Plot, near
from verification.scenes import (DENSITY, SPACING, YOUNG, cubic, elastic, explicit, fixed, mean, scene, stage, static,
                                 tag, told)

STRAIN = 1e-6


def pulled(name, what, counts, tolerance=1e-5, series="", at=0, **material):
    """A box of cells pulled along x at rest, on planes of symmetry."""
    force = STRAIN * YOUNG * counts[1] * counts[2] * SPACING**2
    return Case(f"thin/{name}", what,
                scene(cubic(counts), elastic(**material), *(fixed(f"{axis}_min", axis) for axis in "xyz"),
                      stage("loads.force", on="x_max", total=[force, 0, 0]), static(), mean("x_max", "end")),
                near(STRAIN * counts[0] * SPACING, tolerance, "force x length / (E x area)"),
                lambda result: result.last("probes/end", "displacement_x_mean"), series=series, at=at)


def row(particles):
    """A row of single particles, joined by one spring each: no stiffness but along the row."""
    force = STRAIN * 0.4 * YOUNG * SPACING**2
    return Case(f"thin/row_{particles}", f"row of {particles} particles, pulled",
                scene(cubic([particles, 1, 1], "particles"), elastic(), fixed("all", "yz"), fixed("x_min", "x"),
                      stage("loads.force", on="x_max", total=[force, 0, 0]), static(), mean("x_max", "end")),
                near(STRAIN * SPACING * (particles - 1), 1e-5, "force / k of each spring"),
                lambda result: result.last("probes/end", "displacement_x_mean"), series="pulled at its end, particles",
                at=particles)


def hanging(length):
    """A bar under its own weight."""
    weight = 1e-6 * YOUNG / (DENSITY * length * SPACING)
    return Case(f"thin/hanging_{length}", f"bar of 1 x 1 x {length} cells under its own weight",
                scene(cubic([1, 1, length]), elastic(), *(fixed(f"{axis}_min", axis) for axis in "xyz"),
                      stage("loads.gravity", acceleration=[0, 0, weight]), static(), mean("z_max", "end")),
                near(0.5e-6 * length * SPACING, 1e-4, "weight x length / (2 E x area)"),
                lambda result: result.last("probes/end", "displacement_z_mean"), series="own weight, cells", at=length)


def pushed(length, tolerance=1e-9, **more):
    """A free bar is pushed at one end: its momentum is force x time, and most of it has not felt it yet."""
    end, force = 1e-4, 1e-3
    return Case(f"thin/pushed_{length}" + tag(more),
                f"free bar of 1 x 1 x {length} cells, pushed at its end{told(more)}",
                scene(cubic([1, 1, length]), elastic(), stage("loads.force", on="z_min", total=[0, 0, force]),
                      explicit(end), **more),
                near(force * end, tolerance, "force x time: momentum"),
                lambda result: result.last("history", "momentum_z"))


LENGTHS = (20, 200, 2000, 20000)
FAMILY = Family(
    "thin", "One cell thick, and 1 : 20,000",
    "A body one cell thick consists of edges only, and a row of single particles has no stiffness across. A slender "
    "bar is hard for a solver of equations, since a load at its end has to travel through all cells.",
    [pulled(f"rod_{n}", f"rod of 1 x 1 x {n} cells, pulled", [n, 1, 1], series="pulled at its end, cells", at=n)
     for n in LENGTHS]
    + [pulled("rod_I-m", "rod of 1 x 1 x 20 cells, membrane I-m, nu 0", [20, 1, 1], poisson=0.0, membrane="I-m"),
       pulled("rod_volumetric", "rod of 1 x 1 x 20 cells, nu 0.49", [20, 1, 1], poisson=0.49),
       pulled("plate", "plate of 60 x 60 x 1 cells, pulled", [60, 60, 1]),
       pulled("plate_I-m", "plate of 60 x 60 x 1 cells, membrane I-m, nu 0.1", [60, 60, 1], poisson=0.1,
              membrane="I-m")]
    + [row(n) for n in LENGTHS]
    + [hanging(n) for n in LENGTHS[:-1]]
    + [pushed(20000), pushed(20000, 1e-5, precision="float")],
    Plot("length over thickness", "error of the displacement", "xy"),
    "The error is that of the residual asked for, at any length. What grows is the work: conjugate gradients take "
    "some 15 iterations for 2,000 cells and some 100 for 20,000.")
