# Writes truth.csv: the radial displacement of the elastic hollow sphere of study.json over time, in closed form.
# The displacement is that of the static pressure p(t) (Lame) and free vibrations (modes):
#   u(r, t) = p(t) s(r) + sum over n of q_n(t) f_n(r),     q_n'' + w_n^2 q_n = -p''(t) <s, f_n> / <f_n, f_n>
# f = j1(k r) + B y1(k r), the spherical Bessel functions; w = k c; <f, g> the integral of f g r^2. Both surfaces of a mode are free: this gives k and B.
# By the theorem of Betti, rho w^2 <s, f> = a^2 f(a). p'' consists of pulses where the slope of p changes. The terms fall as 1 / n^3.
#   python3 truth.py
import math
import pathlib

young, poisson, density = 10e9, 0.23, 2500
inner, outer = 0.02, 0.05
peak, rise, fall = 10e6, 10e-6, 20e-6
times = [n * 0.4e-6 for n in range(301)]
# Mean radii of the shells lie in these ranges.
radii = [n * 0.5e-3 for first, last in ((40, 46), (68, 72), (94, 100)) for n in range(first, last + 1)]
modes = 400

lame = young * poisson / ((1 + poisson) * (1 - 2 * poisson))
shear = young / (2 * (1 + poisson))
speed = math.sqrt((lame + 2 * shear) / density)


def regular(x):
    """j1(x)"""
    return math.sin(x) / x**2 - math.cos(x) / x


def singular(x):
    """y1(x)"""
    return -math.cos(x) / x**2 - math.sin(x) / x


def traction(wave, radius, bessel):
    """The radial stress (lame + 2 shear) u' + 2 lame u / r of u = bessel(k r); j1' = j0 - 2 j1 / x, and y1' likewise."""
    x = wave * radius
    zeroth = math.sin(x) / x if bessel is regular else -math.cos(x) / x
    return (lame + 2 * shear) * wave * (zeroth - 2 * bessel(x) / x) + 2 * lame * bessel(x) / radius


def frequency(wave):
    return traction(wave, inner, regular) * traction(wave, outer, singular) - traction(wave, outer, regular) * traction(wave, inner, singular)


def root(low, high):
    sign = frequency(low) > 0
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if (frequency(middle) > 0) == sign else (low, middle)
    return (low + high) / 2


def waves():
    """The wave numbers of the lowest modes. At high wave numbers they are pi / (outer - inner) apart."""
    step = math.pi / (outer - inner) / 20
    low, found = step, []
    while len(found) < modes:
        if (frequency(low) > 0) != (frequency(low + step) > 0):
            found.append(root(low, low + step))
        low += step
    return found


def static(radius):
    """The displacement under the pressure 1 Pa at rest."""
    scale = inner**3 / (outer**3 - inner**3) / young
    return scale * ((1 - 2 * poisson) * radius + (1 + poisson) * outer**3 / (2 * radius**2))


def square(wave, part):
    """The integral of f^2 r^2 = [r^3 (f^2 - f0 f2) / 2], with f0, f1 = f, f2 the orders 0, 1, 2; f0 + f2 = 3 f1 / x."""

    def antiderivative(radius):
        x = wave * radius
        first = regular(x) + part * singular(x)
        zeroth = math.sin(x) / x - part * math.cos(x) / x
        return radius**3 / 2 * (first**2 - zeroth * (3 * first / x - zeroth))

    return antiderivative(outer) - antiderivative(inner)


def pressure(time):
    return peak * max(0.0, min(time / rise, (rise + fall - time) / fall))


corners = [(0.0, peak / rise), (rise, -peak / rise - peak / fall), (rise + fall, peak / fall)]
displacement = [[pressure(t) * static(r) for r in radii] for t in times]
for wave in waves():
    part = -traction(wave, inner, regular) / traction(wave, inner, singular)
    shape = [regular(wave * r) + part * singular(wave * r) for r in radii]
    omega = wave * speed
    weight = inner**2 * (regular(wave * inner) + part * singular(wave * inner)) / (density * omega**2 * square(wave, part))
    for row, t in zip(displacement, times):
        motion = -weight * sum(jump * math.sin(omega * (t - corner)) / omega for corner, jump in corners if t > corner)
        for n, f in enumerate(shape):
            row[n] += motion * f

lines = ["t," + ",".join(f"u_r@{r:g}" for r in radii)]
lines += [f"{t:.4g}," + ",".join(f"{u:.5e}" for u in row) for t, row in zip(times, displacement)]
(pathlib.Path(__file__).parent / "truth.csv").write_text("\n".join(lines) + "\n")
