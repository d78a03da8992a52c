"""A cube of two cells along each edge between frictionless planes: its strain is homogeneous, and exactly that of the
infinite lattice."""
from verification.scenes import cubic, elastic, mean, rollers, scene, stage

CELLS = 2


def pulled(solver, material, pressure=-1e3, boundary="cells", **more):
    """Under a pressure on the end along x."""
    return scene(cubic([CELLS] * 3, boundary), elastic(**material), *rollers(),
                 stage("loads.pressure", on="x_max", pressure=pressure), solver, mean("x_max", "end"),
                 mean("y_max", "side"), **more)


def stretched(solver, material, stretch, rise=1.0, **more):
    """With the end along x moved until the cube has this stretch."""
    length = CELLS * 1e-3
    return scene(cubic([CELLS] * 3), elastic(**material), *rollers(),
                 stage("loads.displacement", on="x_max", axes="x", value=[(stretch - 1) * length, 0, 0], rise=rise),
                 solver, mean("x_max", "end"), mean("y_max", "side"),
                 stage("probes.reaction", on="x_max", name="grip", every=0), **more)


def hit(material, solver, **more):
    """A free block of 3 x 3 x 3 cells whose corner has a velocity."""
    corner = {"box": {"low": [-1, -1, -1], "high": [0.5e-3, 0.5e-3, 0.5e-3]}}
    return scene(cubic([3, 3, 3]), material, stage("loads.start_velocity", on=corner, linear=[1e-6, 2e-6, 3e-6]),
                 solver, **more)


def poisson(result):
    """The ratio of the strains."""
    return -result.last("probes/side", "displacement_y_mean") / result.last("probes/end", "displacement_x_mean")


def strain(result):
    return result.last("probes/end", "displacement_x_mean") / (CELLS * 1e-3)
