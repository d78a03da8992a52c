"""Loads and bodies many orders of magnitude small or large."""
from verification.bars import Bar
from verification.case import Case, Error, Family, Plot, near
from verification.scenes import explicit, static
from verification.theory import central

STEPS = 300
SAME = "chain of masses under central differences, in proportion"
REST = "force x length / (C11 x area)"


def moving(name, what, tolerance=1e-6, series="", at=0, precision=None, **of):
    bar = Bar([(8, 1, 1)], **of)
    step = bar.critical() / 2
    return Case(f"scales/{name}", what,
                bar.scene(explicit(STEPS * step, time_step=step * (1 + 1e-9)),
                          **({"precision": precision} if precision else {})),
                near(bar.moved(STEPS * step, central(step)), tolerance, SAME), bar.measured, series=series, at=at)


def resting(name, what, tolerance=1e-6, series="", at=0, **of):
    bar = Bar([(8, 1, 1)], **of)
    return Case(f"scales/{name}", what, bar.scene(static()), near(1, tolerance, REST), bar.measured, series=series,
                at=at)


def torn():
    bar = Bar([(8, 1, 1)], strain=1e12)
    return Case("scales/load_1e+12", "load for a strain of 1e12, in motion", bar.scene(explicit(100 * bar.critical())),
                Error(3, "more than 100 lattice spacings in one step", "no step follows such a motion"))


def taut():
    """All springs but those across point along the bar, so that five act in place of the three of C11."""
    bar = Bar([(8, 1, 1)], strain=1e12)
    return Case("scales/load_1e+12_rest", "load for a strain of 1e12, at rest", bar.scene(static()),
                near(0.6, 1e-6, "springs along the bar: stiffness 5 k in place of 3 k"), bar.measured)


SIZES = [1e-9, 1e-6, 1.0, 1e3, 1e6]
STRAINS = [1e-12, 1e-100, 1e-200, 1e-280, 1e-300]
FAMILY = Family(
    "scales", "Scales of loads and of bodies",
    "Loads are given as the strain that they would cause. The dimensionless answer of small strains is the same for "
    "all loads, sizes, stiffnesses and densities. Small loads get lost where a length is the difference of two "
    "places; very small ones become denormal numbers, which have fewer digits. A load 1e12 times the stiffness of the "
    "body moves it faster than any step can follow, and that must be said.",
    [moving(f"load_{e:.0e}", f"load for a strain of {e:g}, in motion", series="load, in motion", at=e,
            strain=e) for e in STRAINS]
    + [resting(f"load_{e:.0e}_rest", f"load for a strain of {e:g}, at rest", series="load, at rest", at=e, strain=e)
       for e in STRAINS]
    + [moving("denormal", "displacements of 1e-315 m, denormal, in motion", 2e-5, strain=1e-312),
       moving("denormal_float", "displacements of 1e-40 m, denormal in floats, in motion", 3e-2, strain=1e-37,
              precision="float"),
       torn(),
       taut()]
    + [moving(f"size_{size:.0e}", f"spacing {size:g} m, in motion", spacing=size) for size in SIZES]
    + [resting(f"size_{size:.0e}_rest", f"spacing {size:g} m, at rest", spacing=size) for size in (1e-9, 1e6)]
    + [moving(f"size_{size:.0e}_float", f"spacing {size:g} m, precision float", 1e-3, spacing=size, precision="float")
       for size in (1e-9, 1e6)]
    + [moving("young_1e15", "E 1e15 Pa", young=1e15), moving("young_1", "E 1 Pa", young=1.0),
       moving("density_1e-6", "density 1e-6 kg/m3", density=1e-6),
       moving("density_1e12", "density 1e12 kg/m3", density=1e12)],
    Plot("strain that the load would cause", "error of the displacement", "xy"),
    "The answer has ten digits or more for loads over 288 decades. The border is that of the numbers: below 1e-308 "
    "digits get lost, and with displacements of 1e-315 m five are left.")
