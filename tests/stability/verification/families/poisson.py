"""Poisson ratios from -0.9 to 0.499 by the volumetric energy."""
from verification import cubes
from verification.bars import Bar
from verification.case import Case, Error, Family, Number, Plot, near
from verification.scenes import explicit, static, tag, told
from verification.theory import central

RATIOS = [-0.9, -0.5, 0.0, 0.25, 0.45, 0.49, 0.499]
HELD = "chain with C11 of E and nu, under central differences"


def material(nu):
    return {"poisson": nu, **({"volumetric": True} if nu < 0.25 else {})}


def at_rest(nu):
    return Case(f"poisson/rest_{nu:g}", f"nu {nu:g}, at rest",
                cubes.pulled(static(tolerance=1e-9), material(nu), pressure=-1.0),
                Number(nu, 1e-5, "E and nu asked for, homogeneous strain"), cubes.poisson, series="at rest", at=nu)


def swinging(nu, **more):
    """A held bar for 200 steps of 0.6 critical ones of the infinite lattice."""
    bar = Bar([(8, 1, 1)], poisson=nu)
    step = 0.6 * bar.critical()
    return Case(f"poisson/motion_{nu:g}" + tag(more),
                f"nu {nu:g}, a bar swinging for 200 steps" + told(more),
                bar.scene(explicit(200 * step, time_step=step * (1 + 1e-9)), **more),
                near(bar.moved(200 * step, central(step)), 1e-3 if more else 1e-6, HELD), bar.measured,
                series="" if more else "in motion", at=nu)


def refused(name, what, nu, words, **more):
    return Case(f"poisson/{name}", what, cubes.pulled(static(), {"poisson": nu, **more}),
                Error(2, words, "outside of what a solid or the springs can have"))


FAMILY = Family(
    "poisson", "Poisson ratios from -0.9 to 0.499",
    "Near 1/2 the bulk modulus is hundreds of times the shear modulus; near -1 the volumetric energy is negative and "
    "the springs alone keep the body stable. Below -1, from 1/2 on, and out of reach of the springs the program "
    "refuses.",
    [at_rest(nu) for nu in RATIOS] + [swinging(nu) for nu in (0.25, 0.45, 0.49, 0.499)]
    + [swinging(0.49, precision="float"),
       refused("half", "nu 0.5", 0.5, "above -1 and below 0.5"),
       refused("below_minus_one", "nu -1.01", -1.01, "above -1 and below 0.5"),
       refused("springs_alone", "nu 0.2 without membrane or volumetric energy", 0.2, "/pipeline/1/poisson"),
       refused("volumetric_breaks", "nu 0 by negative volumetric energy in a body that breaks", 0.0, "failure",
               volumetric=True,
               failure={"type": "failures.elongation", "limit": 1e-6})],
    Plot("Poisson ratio", "error", "y",
         height=lambda outcome: outcome.distance),
    "The error is round-off and the nonlinearity of the strain over the whole range. No end of it is less exact than "
    "its middle.")
