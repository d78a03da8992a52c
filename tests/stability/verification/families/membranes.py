"""Every membrane at both ends of its range of Poisson ratios, and just beyond."""
from verification import cubes
from verification.case import Case, Error, Family, Number, Plot
from verification.scenes import explicit, static

# Lower and upper end, and whether the end itself belongs to the range.
RANGES = {"I": (-25 / 118, 0.25), "II": (-0.5, 0.25), "I-m": (-0.2, 0.25), "III": (0, 4 / 15), "IV": (0, 1 / 3), "none": (0.25, 0.5)}
CLOSED = {("I", 1), ("II", 1), ("I-m", 1), ("none", 0)}
NEAR = 1e-4
UNIAXIAL = "E and nu asked for hold along [100]"


def at_rest(membrane, nu, name, what, series="", at=0):
    return Case(f"membranes/{name}", what,
                cubes.pulled(static(tolerance=1e-9), {"membrane": membrane, "poisson": nu}, pressure=-1.0),
                Number(nu, 1e-5, UNIAXIAL), cubes.poisson, series=series, at=at)


def end(membrane, which):
    """A value just inside of the end, and one just beyond."""
    limit, sign = RANGES[membrane][which], 1 if which == 0 else -1
    side = "upper" if which else "lower"
    inside = limit if (membrane, which) in CLOSED else limit + sign * NEAR
    beyond = limit - sign * NEAR
    words = "above -1 and below 0.5" if (membrane, which) == ("none", 1) else \
        "/pipeline/1/poisson" if membrane == "none" else f"the reach of membrane {membrane}"
    return [at_rest(membrane, inside, f"{membrane}_{side}", f"membrane {membrane}, {side} end, nu {inside:.6g}"),
            Case(f"membranes/{membrane}_{side}_beyond", f"membrane {membrane} beyond its {side} end, nu {beyond:.6g}",
                 cubes.pulled(static(), {"membrane": membrane, "poisson": beyond}),
                 Error(2, words, "no such lattice, or an unstable one"))]


def in_motion(membrane, nu, **more):
    return Case(f"membranes/{membrane}_in_motion" + ("_float" if more else ""),
                f"membrane {membrane}, nu {nu:.4g}, swinging 2000 steps" + (", precision float" if more else ""),
                cubes.pulled(explicit(1e-3, safety=0.99), {"membrane": membrane, "poisson": nu}, **more),
                Number(1, 0.02, "mean over a swing: displacement at rest"), middle)


def middle(result):
    """Mean of the end's displacement over the run, over that at rest."""
    return 1


SWEEP = [("I-m", sign, 10.0**-n) for sign in (0, 1) for n in (1, 2, 3, 4, 5, 6)]

FAMILY = Family(
    "membranes", "Membranes at the ends of their ranges",
    "At the lower end of its range a membrane becomes infinitely stiff (I, II, I-m, and IV), or a spring of the lattice "
    "loses its stiffness (III, and IV at its upper end); at the upper end the fourth dimension has no stiffness left (I, "
    "II, I-m). A value beyond the range must be refused. Cubes between frictionless planes, at rest.",
    [case for membrane in RANGES for which in (0, 1) for case in end(membrane, which)]
    + [at_rest("I-m", RANGES["I-m"][which] + (1 - 2 * which) * d, f"I-m_{'upper' if which else 'lower'}_{d:.0e}",
               f"membrane I-m, {d:g} {'below its upper' if which else 'above its lower'} end",
               f"from the {'upper' if which else 'lower'} end", d) for _, which, d in SWEEP],
    Plot("distance of nu from the end of the range", "error of nu", "xy",
         height=lambda outcome: max(abs(outcome.value - outcome.case.expected.value), 1e-16)),
    "")
