"""Every membrane at both ends of its range of Poisson ratios, and just beyond."""
from verification import cubes
from verification.case import Case, Error, Family, Number, Plot
from verification.run import Result
from verification.scenes import elastic, explicit, static, tag, told

# Lower and upper end of nu in the cubic lattice.
RANGES = {"I": (-25 / 118, 0.25), "II": (-0.5, 0.25), "I-m": (-0.2, 0.25), "III": (0, 4 / 15), "IV": (0, 1 / 3),
          "none": (0.25, 0.5)}
# Ends that belong to the range. At the others a case is NEAR the end.
CLOSED = {("I", "upper"), ("II", "upper"), ("I-m", "upper"), ("none", "lower")}
OF_NONE = {"lower": "expected poisson 0.25", "upper": "above -1 and below 0.5"}  # words of refusals
NEAR, BEYOND = 1e-4, 1e-3


def of(membrane, nu):
    return {"membrane": membrane, "poisson": nu}


def limit(membrane, side):
    """The end, and the direction into the range."""
    return RANGES[membrane][side == "upper"], -1 if side == "upper" else 1


def inside(membrane, side):
    value, inwards = limit(membrane, side)
    return value if (membrane, side) in CLOSED else value + inwards * NEAR


def at_rest(membrane, nu, name, what, series="", at=0):
    return Case(f"membranes/{name}", what, cubes.pulled(static(), of(membrane, nu), pressure=-1.0),
                Number(nu, 1e-6, "E and nu asked for hold along [100]"), cubes.poisson, series=series, at=at)


def beyond(membrane, side):
    value, inwards = limit(membrane, side)
    nu = value - inwards * BEYOND
    words = OF_NONE[side] if membrane == "none" else f"the reach of membrane {membrane};"
    return Case(f"membranes/{membrane}_{side}_beyond", f"membrane {membrane} beyond its {side} end, nu {nu:.6g}",
                cubes.pulled(static(), of(membrane, nu)),
                Error(2, words, "no such lattice, or an unstable one"))


def in_motion(membrane, side, **more):
    """A free block whose corner is hit, for more than a thousand steps."""
    nu = inside(membrane, side)
    return Case(f"membranes/{membrane}_{side}_motion" + tag(more),
                f"membrane {membrane}, nu {nu:.6g}, a block hit at its corner, 0.99 of the critical step{told(more)}",
                cubes.hit(elastic(**of(membrane, nu)), explicit(1e-3 if nu > -0.15 else 1e-4, safety=0.99), **more),
                Number(1, 1e-3 if more else 1e-6, "energy that central differences keep"), Result.energy_kept)


def approach(side, distance):
    value, inwards = limit("I-m", side)
    return at_rest("I-m", value + inwards * distance, f"I-m_{side}_{distance:.0e}",
                   f"membrane I-m, {distance:g} from its {side} end", f"from the {side} end", distance)


SIDES = ("lower", "upper")
FAMILY = Family(
    "membranes", "Membranes at the ends of their ranges",
    "At the lower end of its range a membrane becomes infinitely stiff (I, II, I-m, IV), or a spring of the lattice "
    "loses its stiffness (III, and IV at its upper end); at the upper end the fourth dimension has no stiffness left "
    "(I, II, I-m). A value beyond the range must be refused.",
    [at_rest(membrane, inside(membrane, side), f"{membrane}_{side}",
             f"membrane {membrane} at its {side} end, nu {inside(membrane, side):.6g}")
     for membrane in RANGES for side in SIDES]
    + [beyond(membrane, side) for membrane in RANGES for side in SIDES]
    + [in_motion(membrane, side) for membrane in RANGES for side in SIDES]
    + [in_motion("I-m", "lower", precision="float")]
    + [approach(side, 10.0**-n) for side in SIDES for n in (1, 2, 3, 5, 6, 7)],
    Plot("distance of nu from the end of the range of I-m", "error of nu", "xy",
         height=lambda outcome: outcome.distance),
    "The error of nu stays below 1e-8 up to a distance of 1e-7 from both ends, where lambda is 2.5e7 or 1.2e-6: the "
    "range ends where the program says, and not before.")
