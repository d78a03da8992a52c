"""Added mass for stiff parts, so that they do not dictate the step."""
from verification.bars import Bar
from verification.case import Case, Error, Family, Number, Plot, near
from verification.scenes import DENSITY, SPACING, YOUNG, explicit, tag, told
from verification.theory import Chain, central, confined, stiffest_of_cell

SIDE = 20  # soft cells on each side of the stiff one
# The critical step of a cell alone; the stiffest motion of a body is at most that of its cells.
CELL = 2 / stiffest_of_cell(YOUNG, DENSITY, SPACING)
CONTRASTS = (1e2, 1e4, 1e6)


def bar(contrast):
    return Bar([(SIDE, 1, 1), (1, contrast, 1), (SIDE, 1, 1)])


class Scaled(Chain):
    """The chain of the bar whose masses are at least H^2 / 4 times the sum over their cells of the cell's share in
    m omega^2, with H the asked step over that of a soft cell."""

    def __init__(self, contrast, asked):
        of = bar(contrast)
        stiffness = [k for cells, k, _ in of.parts for _ in range(cells)]
        around = [stiffness[n:n + 2] for n in range(len(stiffness))]  # the cells before and behind each mass
        half = DENSITY * SPACING**3 / 2
        super().__init__([SPACING / (confined(YOUNG, of.poisson) * k * of.area) for k in stiffness],
                         [half * max(len(cells), asked**2 * sum(cells)) for cells in around])


def swing(contrast, asked, curve, **more):
    """The bar under a sudden force, for three times the time in which a wave goes to its end and back."""
    of = bar(contrast)
    step = 0.9 * asked * CELL
    steps = round(6 * of.cells * SPACING / of.speed / step)
    chain = Scaled(contrast, asked)
    value = chain.sudden(of.force, steps * step, central(step)) / of.at_rest()
    return Case(f"mass/stiff_{contrast:.0e}_{asked:g}" + tag(more),
                f"one cell in a bar of {of.cells} {contrast:g} times as stiff, mass for {asked:g} times the step of "
                f"a soft cell{told(more)}",
                of.scene(explicit(steps * step, time_step=step * (1 + 1e-9), mass_scaling=asked * CELL), **more),
                near(value, 1e-3 if more else 1e-5, "chain of masses with the added ones under central differences, "
                     "closed form"),
                of.measured, series=curve, at=contrast)


def energy(contrast):
    of = bar(contrast)
    step = 0.99 * CELL
    return Case(f"mass/energy_{contrast:.0e}",
                f"the same bar, contrast {contrast:g}, 2000 steps of 0.99 of the asked critical one: largest error of "
                "the energy balance",
                of.scene(explicit(2000 * step, time_step=step * (1 + 1e-9), mass_scaling=CELL)),
                Number(0, 1e-6, "energy that central differences keep"),
                lambda result: result.summary["energy"]["largest_relative_error"])


def refused(name, what, words, **options):
    return Case(f"mass/{name}", what, bar(1e4).scene(explicit(1e-4, **options)),
                Error(2, words, "both lengthen the step of stiff particles"))


FAMILY = Family(
    "mass", "Added mass",
    "One stiff cell gets mass until it bears the step of the others. Its ends then weigh up to 500,000 times as much as "
    "before, and the motion must be that of a bar with these masses, slower as they predict, and keep its energy.",
    [swing(contrast, 1, "1") for contrast in CONTRASTS]
    + [swing(contrast, 0.5, "0.5") for contrast in CONTRASTS]
    + [swing(1e4, 1, "", precision="float")]
    + [energy(contrast) for contrast in CONTRASTS]
    + [refused("local_steps", "mass beside local steps", "local_steps", mass_scaling=CELL, local_steps=100)],
    Plot("contrast", "error of the displacement", "xy"),
    "The scheme does what the masses say, at any contrast; that the masses change the motion is what is paid for the "
    "longer step.")
