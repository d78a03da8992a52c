# Writes truth.csv: the displacement of a travelling wave at 80 us,
#   u(x, t) = I(t - x / c) / (rho c), I(t) the integral of the pressure from 0 to t.
# The bar cannot move sideways, so that c is the speed of pressure waves,
#   c^2 = E (1 - nu) / ((1 + nu) (1 - 2 nu) rho).
#   python3 truth.py
import math
import pathlib

young, poisson, density = 10e9, 0.25, 2500
pressure, rise, time = 0.1e6, 30e-6, 80e-6
speed = math.sqrt(young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson) * density))


def impulse(t):
    """Impulse per area: the integral of the pressure from 0 to t, Pa s."""
    return 0.0 if t <= 0 else pressure * (t * t / (2 * rise) if t <= rise else t - rise / 2)


lines = ["x,u"] + [f"{x / 1000:g},{impulse(time - x / 1000 / speed) / (density * speed):.12g}" for x in range(201)]
(pathlib.Path(__file__).parent / "truth.csv").write_text("\n".join(lines) + "\n")
