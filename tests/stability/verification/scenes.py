"""Parts of scenes that several families share. Lengths are in spacings, so that a scene has any size."""

SPACING, YOUNG, DENSITY = 1e-3, 1e9, 1000.0


def tag(options):
    """The end of a case's name for options that it has besides."""
    return "".join(f"_{value}" for value in options.values())


def told(options):
    """The same in words."""
    return "".join(f", {key} {value}" for key, value in options.items())


def stage(kind, **options):
    return {"type": kind, **options}


def scene(*stages, **more):
    return {"format": "hyperlattice/1", **more, "pipeline": list(stages)}


def box(low, high, spacing=SPACING):
    return {"box": {"low": [x * spacing for x in low], "high": [x * spacing for x in high]}}


def cubic(counts, boundary="cells", spacing=SPACING):
    """A box of counts[0] x counts[1] x counts[2] cells, with a corner at the origin."""
    return stage("lattices.cubic", spacing=spacing, boundary=boundary, shape=box([0, 0, 0], counts, spacing))


def elastic(**options):
    return stage("materials.elastic", **{"young": YOUNG, "density": DENSITY, "poisson": 0.25, **options})


def fixed(on, axes="xyz"):
    return stage("loads.fixed", on=on, axes=axes, name=f"{on}_{axes}")


def rollers():
    """Three faces slide on planes of symmetry, so that a homogeneous strain stays homogeneous."""
    return [fixed(f"{axis}_min", axis) for axis in "xyz"]


def explicit(end, **options):
    return stage("solvers.explicit", end_time=end, **options)


def implicit(end, step, **options):
    return stage("solvers.implicit", end_time=end, time_step=step, **options)


def static(**options):
    return stage("solvers.static", **options)


def mean(on, name, every=0, field="displacement"):
    """A probe of the mean of a field over a region; every = 0: at the first and the last instant."""
    return stage("probes.region", region=on, name=name, field=field, every=every)


def reaction(on, name="grip"):
    return stage("probes.reaction", on=on, name=name, every=0)
