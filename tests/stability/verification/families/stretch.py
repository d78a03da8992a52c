"""Stretch up to 3, compression down to 0.3."""
from verification import cubes
from verification.case import Case, Error, Family, Number, Plot, near
from verification.scenes import YOUNG, explicit, static
from verification.theory import Homogeneous

LATTICE = "homogeneous strain of the infinite lattice, closed form"
LAMBDA = 2.8  # of I-m at nu 0.1
STIFFNESS = {0.0: 0.4 * YOUNG, LAMBDA: 0.4 * YOUNG / 2.112}  # k / l


def force(result, membrane=0.0):
    """The force on a cell's face over k l."""
    return result.last("probes/grip", "force_x") / (STIFFNESS[membrane] * (cubes.CELLS * 1e-3)**2)


def pulled(stretch, membrane=0.0, series="measured"):
    material = {"poisson": 0.1, "membrane": "I-m"} if membrane else {}
    _, _, expected = Homogeneous(membrane).pulled(stretch)
    name = "I-m" if membrane else "none"
    return Case(f"stretch/free_{name}_{stretch:g}", f"stretch {stretch:g}, membrane {name}, sides free",
                cubes.stretched(static(tolerance=1e-9, load_steps=10), material, stretch),
                near(expected, 1e-5, LATTICE), lambda result: force(result, membrane),
                series=f"{name}, sides free", at=stretch)


def confined(stretch):
    """All displacements but those along x are zero."""
    scene = cubes.stretched(static(tolerance=1e-9, load_steps=10), {}, stretch)
    return scene


FAMILY = Family("stretch", "", "", [pulled(a) for a in (0.9, 0.7, 0.5, 0.3, 1.5, 2.0, 3.0)]
                + [pulled(a, LAMBDA) for a in (0.8, 1.5, 2.0, 2.5)],
                Plot("stretch", "force on a cell over k l", height=lambda o: o.value,
                     curves={f"theory, {name}": [(a, Homogeneous(m).pulled(a)[2]) for a in
                                                 [0.3 + 0.1 * i for i in range(28)]]
                             for name, m in (("none", 0.0),)}), "")
