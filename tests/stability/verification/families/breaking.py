"""All springs of a body break in one step."""
from verification.case import Case, Family, Number, Plot, near
from verification.scenes import DENSITY, SPACING, YOUNG, cubic, elastic, explicit, mean, scene, stage

SIDE = 4  # particles along an edge
STEP, RATE = 4e-7, 1.0  # s, 1/s
ALONG = 3 * SIDE**2 * (SIDE - 1)  # springs along the axes
ACROSS = 6 * SIDE * (SIDE - 1)**2  # diagonals
GROWN = RATE * SPACING * STEP  # elongation of a spring along an axis in one step


def expanding():
    """Start velocities RATE x, one load for each particle."""
    loads = []
    for i in range(SIDE):
        for j in range(SIDE):
            for k in range(SIDE):
                site = {"box": {"low": [(n + 0.1) * SPACING for n in (i, j, k)],
                                "high": [(n + 0.9) * SPACING for n in (i, j, k)]}}
                loads.append(stage("loads.start_velocity", name=f"v{i}{j}{k}", on=site,
                                   linear=[RATE * (n + 0.5) * SPACING for n in (i, j, k)]))
    return loads


def burst(limit, steps, **more):
    material = {key: more.pop(key) for key in ("poisson", "membrane") if key in more}
    failure = {"type": "failures.elongation", "limit": limit * GROWN}
    return scene(cubic([SIDE] * 3, "particles"), elastic(failure=failure, **material), *expanding(),
                 explicit(steps * STEP, time_step=STEP * (1 + 1e-9)), **more)


def broken(result):
    return sum(result.summary["broken_springs"].values())


def count(limit, expected, truth):
    """After the step in which springs have grown once."""
    return Case(f"breaking/limit_{limit:g}", f"limit {limit:g} of the elongation in the first step: broken springs",
                burst(limit, 2), Number(expected, 0, truth), broken, series="springs", at=limit)


def flown(name, what, kick, tolerance=1e-6, **more):
    """The springs act in the step that finds them too long, and never again. The corner of the cube then flies
    freely with what is left of its velocity. `kick`: stiffness against the expansion over m / STEP^2, of the corner."""
    last = [(SIDE - 1) * SPACING] * 3
    scene_of = burst(0.5, 1000, **more)
    scene_of["pipeline"].append(mean({"box": {"low": last, "high": [1, 1, 1]}}, "corner", field="velocity"))
    return Case(f"breaking/{name}", what, scene_of,
                near((SIDE - 0.5) - kick, tolerance, "velocity of the corner, free after one step of all springs"),
                lambda result: result.last("probes/corner", "velocity_x_mean") / (RATE * SPACING))


def springs(poisson=0.25, eta=1.0, cross=0.0):
    """Along each axis the three springs and the diagonals of the corner pull like three springs."""
    k = 0.4 * YOUNG * SPACING / eta if poisson <= 0.25 else YOUNG * SPACING / (2 * (1 + poisson))
    return 3 * k * (1 + cross / 2) * STEP**2 / (DENSITY * SPACING**3)


def volume(poisson):
    """The corner has one cell, whose tension 3 K_v x strain acts on a quarter of each of its faces."""
    bulk = YOUNG / (2 * (1 + poisson)) * (4 * poisson - 1) / (1 - 2 * poisson)
    return 3 * bulk / 4 * STEP**2 / (DENSITY * SPACING**2)


FAMILY = Family(
    "breaking", "All springs broken in one step",
    f"A cube of {SIDE}^3 particles expands evenly, so that its {ALONG} springs along the axes grow alike, and its "
    f"{ACROSS} diagonals "
    "1.41 times as much. With a small limit all break at once: the body is a cloud of single particles from then on.",
    [count(0.5, ALONG + ACROSS, "all springs"), count(0.99, ALONG + ACROSS, "all springs"),
     count(1.01, ACROSS, "the diagonals"), count(1.4, ACROSS, "the diagonals"), count(1.43, 0, "none"),
     count(1.9, 0, "none")]
    + [flown("cloud", "1000 steps after all springs broke", springs()),
       flown("cloud_I-m", "the same, membrane I-m, nu 0.1", springs(eta=2.112, cross=2.8), poisson=0.1, membrane="I-m"),
       flown("cloud_volumetric", "the same, nu 0.45", springs(0.45) + volume(0.45), poisson=0.45),
       flown("cloud_float", "the same, precision float", springs(), 1e-5, precision="float")],
    Plot("limit over the elongation in the first step", "broken springs", height=lambda outcome: outcome.value,
         curves={"theory": [(0.4, ALONG + ACROSS), (1, ALONG + ACROSS), (1, ACROSS), (2**0.5, ACROSS), (2**0.5, 0),
                            (2, 0)]}),
    "The count of broken springs falls at 1 and at sqrt(2), where theory has its steps: the limits 0.99 and 1.01 are "
    "told apart.")
