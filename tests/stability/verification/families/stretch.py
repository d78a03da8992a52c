"""Stretch up to 3, compression down to 0.3."""
from verification import cubes
from verification.case import Case, Error, Family, Plot, near
from verification.scenes import YOUNG, cubic, elastic, explicit, fixed, scene, stage, static
from verification.theory import Homogeneous, softest

LATTICE = "homogeneous strain of the infinite lattice, closed form"
LAMBDA = 2.8  # of I-m at nu 0.1
STIFFNESS = {0.0: 0.4 * YOUNG, LAMBDA: 0.4 * YOUNG / 2.112}  # k / l
OF = {0.0: {}, LAMBDA: {"poisson": 0.1, "membrane": "I-m"}}
NAME = {0.0: "none", LAMBDA: "I-m"}


def force(membrane):
    """The force on a cell's face over k l."""
    return lambda result: result.last("probes/grip", "force_x") / (STIFFNESS[membrane] * (cubes.CELLS * 1e-3)**2)


def free(stretch, membrane=0.0):
    return Case(f"stretch/free_{NAME[membrane]}_{stretch:g}",
                f"stretch {stretch:g}, membrane {NAME[membrane]}, sides free, at rest",
                cubes.stretched(static(load_steps=10), OF[membrane], stretch),
                near(Homogeneous(membrane).pulled(stretch)[2], 1e-5, LATTICE), force(membrane),
                series=f"membrane {NAME[membrane]}, sides free", at=stretch)


def buckled(stretch, steps):
    return Case(f"stretch/free_none_{stretch:g}_buckles", f"stretch {stretch:g}, sides free, {steps} load steps",
                cubes.stretched(static(load_steps=steps, stability=True), {}, stretch),
                Error(3, "finds no state of rest",
                      f"the least eigenvalue of the stiffness is {softest(stretch, cubes.CELLS):.2g} k"))


def held(stretch, solver, name, tolerance=1e-6, **more):
    """The sides are held, so that no state can buckle."""
    scene = cubes.stretched(solver, {}, stretch, rise=1e-4, **more)
    scene["pipeline"].insert(2, fixed("all", "yz"))
    return Case(f"stretch/held_{stretch:g}_{name}", f"stretch {stretch:g}, sides held, {name.replace('_', ', ')}",
                scene,
                near(Homogeneous().force(stretch), tolerance, LATTICE), force(0.0),
                series="membrane none, sides held" if name == "static" else "", at=stretch)


def pulled_in_long_steps():
    """A free block that a force stretches by half. Its stretched springs resist motions across them too."""
    made = scene(cubic([6, 4, 4], "particles"), elastic(), fixed("x_min"),
                 stage("loads.force", on="x_max", total=[8000, 0, 0], rise=2e-4), explicit(1e-3, safety=0.99))
    return Case("stretch/long_steps", "strain of a half under a force, steps of 0.99 critical ones", made,
                Error(3, "have shortened the critical step to about", "a guard while running"))


STRETCHES = [0.3 + 0.05 * n for n in range(55)]
FAMILY = Family(
    "stretch", "Stretch of 3, compression to 0.3",
    "Springs turn and the stiffness changes many times over on the way. A cube is stretched at rest, with free and "
    "with held sides. With free sides it buckles on the way down, and the program has to find the state at which it "
    "does.",
    [free(a) for a in (0.9, 0.7, 0.5, 0.48, 1.5, 2.0, 3.0)]
    + [free(a, LAMBDA) for a in (0.7, 1.5, 2.0, 2.5)]
    + [buckled(0.47, 10), buckled(0.466, 40), buckled(0.3, 10)]
    + [held(a, static(load_steps=10), "static") for a in (0.3, 0.5, 2.0, 3.0)]
    + [held(a, explicit(1e-4, safety=0.5), "explicit", 2e-2) for a in (0.3, 3.0)]
    + [held(3.0, explicit(1e-4, safety=0.5), "explicit_float", 2e-2, precision="float")]
    + [pulled_in_long_steps()],
    Plot("stretch", "force on a face of a cell over k l", height=lambda outcome: outcome.value,
         curves={"theory, none, free": [(a, Homogeneous().pulled(a)[2]) for a in STRETCHES],
                 "theory, none, held": [(a, Homogeneous().force(a)) for a in STRETCHES],
                 "theory, I-m, free": [(a, Homogeneous(LAMBDA).pulled(a)[2]) for a in STRETCHES if 0.7 <= a <= 2.5]}),
    "The forces lie on the curves of theory, up to a stretch of 3. The curve of the free cube ends on the left at "
    "0.475, where the cube buckles; with held sides it goes on to 0.3.")
