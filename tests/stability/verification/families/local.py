"""Short steps of stiff parts within steps of the others."""
from verification.bars import Bar
from verification.case import Case, Error, Family, Number, Plot, near
from verification.scenes import explicit, tag, told
from verification.theory import midpoint

SOFT = 40  # cells


def bar(contrast):
    return Bar([(SOFT // 2, 1, 1), (1, contrast, 1), (SOFT // 2, 1, 1)])


def swing(contrast, share, curve, **more):
    """Most of a swing of the bar under a sudden force. `share`: of the stable step."""
    of = bar(contrast)
    soft = bar(1).critical()  # the stable step of the soft cells, about
    step = share * soft
    end = 80 * soft
    parts = round(contrast**0.5)
    return Case(f"local/stiff_{contrast:.0e}_{share:g}" + tag(more),
                f"one cell in a bar of {SOFT} {contrast:g} times as stiff, {parts} local steps, "
                f"steps of {share:g} of a wave's time through a cell{told(more)}",
                of.scene(explicit(end, time_step=step * (1 + 1e-9), local_steps=parts), **more),
                near(of.moved(end, midpoint(1e-3 * soft)), 2 * (step * 40 / end)**2, "chain of masses, exact in time, "
                     "to the square of the step"), of.measured, series=curve, at=contrast)


def rest_of_momentum(contrast):
    """A bar that nothing holds is pushed: its momentum is the impulse."""
    of = bar(contrast)
    end = 200 * bar(1).critical()
    made = of.scene(explicit(end, local_steps="auto"))
    made["pipeline"] = [one for one in made["pipeline"] if one.get("name") != "x_min_x"]
    return Case(f"local/momentum_{contrast:.0e}", f"the same bar, free, contrast {contrast:g}: momentum", made,
                near(of.force * end, 1e-9, "force x time"), lambda result: result.last("history", "momentum_x"))


def refused(name, what, words, material=(), **options):
    of = bar(1e4)
    made = of.scene(explicit(1e-4, local_steps=100, **options))
    for one in made["pipeline"]:
        if one["type"].startswith("materials."):
            one.update(material)
    return Case(f"local/{name}", what, made, Error(2, words, "local steps cannot do it"))


FAMILY = Family(
    "local", "Local steps",
    "One stiff cell dictates the step of a whole bar, unless it alone takes short steps. The scheme must stay stable "
    "and of second order at any contrast, and momentum must stay.",
    [swing(contrast, 0.5, "0.5") for contrast in (1e2, 1e4, 1e6)]
    + [swing(contrast, 0.25, "0.25") for contrast in (1e2, 1e4, 1e6)]
    + [swing(1e4, 0.5, "", precision="float")]
    + [rest_of_momentum(contrast) for contrast in (1e2, 1e4, 1e6)]
    + [refused("volumetric", "nu 0.45", "without a volumetric energy", {"poisson": 0.45}),
       refused("damping", "local damping", "local_steps", damping=0.1)],
    Plot("contrast", "error of the displacement", "xy"),
    "The error falls by four where the step is halved, and does not depend on the contrast.")
