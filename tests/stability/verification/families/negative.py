"""Springs of negative stiffness: stable, refused, or allowed and told."""
from verification import cubes
from verification.case import Case, Error, Family, Number, Plot
from verification.run import Result
from verification.scenes import cubic, explicit, fixed, scene, stage, static, tag, told

RULE = "k_beta > -2 and k_gamma > -3/2: closed rule of clamped membranes"
# Ratios around the corner of the region in which a clamped membrane is stable.
STABLE = [(-1.99, 0.0), (0.0, -1.49), (-1.9, -1.4), (-1.0, 2.0), (3.0, -1.4)]
UNSTABLE = [(-2.01, 0.0), (0.0, -1.51), (-2.1, -1.4), (-2.5, 3.0), (3.0, -1.6)]


# k_gamma of these cases, for the plot.
SHARES = {f"{verdict}_{beta:g}_{gamma:g}": gamma for verdict,
          of in (("stable", STABLE), ("unstable", UNSTABLE)) for beta, gamma in of}


def free(**ratios):
    return {"young": 1e9, "density": 1000, "membrane": "free", **ratios}


def ratio(beta, gamma):
    """nu along [100] of springs k (1 + beta / 2) along the axes and k (1 + 2 gamma / 3) along the diagonals."""
    axes, diagonals = 1 + beta / 2, 1 + 2 * gamma / 3
    return diagonals / (axes + 3 * diagonals)


def pulled(material, **more):
    return scene(cubic([2, 2, 2]), stage("materials.elastic", **material),
                 *(fixed(f"{axis}_min", axis) for axis in "xyz"),
                 stage("loads.pressure", on="x_max", pressure=-1.0), static(),
                 stage("probes.region", region="x_max", name="end", every=0),
                 stage("probes.region", region="y_max", name="side", every=0), **more)


def stable(beta, gamma):
    return Case(f"negative/stable_{beta:g}_{gamma:g}", f"clamped, k_beta {beta:g}, k_gamma {gamma:g}, at rest",
                pulled(free(k_alpha="infinite", k_beta=beta, k_gamma=gamma)),
                Number(ratio(beta, gamma), 1e-6, "nu of a lattice of two springs, closed form"), cubes.poisson,
                series="accepted", at=beta)


def swinging(beta, gamma, **more):
    """A free block whose corner is hit, for about 2000 steps."""
    return Case(f"negative/motion_{beta:g}_{gamma:g}" + tag(more),
                f"clamped, k_beta {beta:g}, k_gamma {gamma:g}, a block hit at its corner{told(more)}",
                cubes.hit(stage("materials.elastic", **free(k_alpha="infinite", k_beta=beta, k_gamma=gamma)),
                          explicit(1e-3), **more),
                Number(1, 1e-3 if more else 1e-6, "energy that central differences keep"), Result.energy_kept)


def refused(name, what, words, **material):
    return Case(f"negative/{name}", what, pulled(free(**material)), Error(2, words, "a motion that releases energy"))


def unstable(beta, gamma):
    return Case(f"negative/unstable_{beta:g}_{gamma:g}", f"clamped, k_beta {beta:g}, k_gamma {gamma:g}",
                pulled(free(k_alpha="infinite", k_beta=beta, k_gamma=gamma)), Error(2, "allow_unstable", RULE),
                series="refused", at=beta)


def allowed(name, what, **material):
    return Case(f"negative/{name}", what,
                scene(cubic([3, 3, 3], "particles"), stage("materials.elastic", young=1e9, density=1000, **material),
                      stage("loads.start_velocity", on="x_min", linear=[1e-6, 2e-6, 3e-6]),
                      explicit(1e-2), allow_unstable=True),
                Error(3, "failed", "the motion grows without bound"))


FAMILY = Family(
    "negative", "Negative stiffness",
    "Springs of negative stiffness are stable as long as the others outweigh them. The border is known in closed form "
    "for the cubic lattice. Beyond it some motion releases energy, and the program must refuse the scene and name "
    "this motion; if the scene allows it, the run must end with an error when the motion has grown.",
    [stable(*of) for of in STABLE] + [unstable(*of) for of in UNSTABLE]
    + [swinging(-1.9, -1.4), swinging(-1.9, -1.4, precision="float")]
    + [refused("k_alpha", "k_alpha -1, alone", "allow_unstable", k_alpha=-1),
       refused("k_alpha_outweighed_too_little", "k_alpha -9, k_beta 1, k_gamma 1", "allow_unstable", k_alpha=-9,
               k_beta=1, k_gamma=1),
       refused("wave", "free, k_alpha 3, k_beta -2.5, k_gamma 2", "wave with vector", k_alpha=3, k_beta=-2.5,
               k_gamma=2),
       refused("lambda_I-m", "membrane I-m, lambda -0.1", "at least 0", membrane="I-m", **{"lambda": -0.1}),
       refused("lambda_III", "membrane III, lambda -1.55", "above -1.5", membrane="III", **{"lambda": -1.55}),
       refused("lambda_IV", "membrane IV, lambda -2.1", "above -2", membrane="IV", **{"lambda": -2.1}),
       allowed("allowed_IV", "membrane IV, lambda -3, allowed, in motion", membrane="IV", poisson=0.4),
       allowed("allowed_wave", "free, k_alpha 3, k_beta -2.5, k_gamma 2, allowed, in motion", membrane="free",
               k_alpha=3, k_beta=-2.5, k_gamma=2)],
    Plot("k_beta", "k_gamma", height=lambda outcome: SHARES[outcome.case.name.split("/")[1]],
         curves={"border, closed form": [(-2, 4), (-2, -1.5), (4, -1.5)]}),
    "All points inside of the border are accepted, and all points outside of it are refused, at distances of 0.01 to "
    "0.1.")
