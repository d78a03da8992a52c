"""Closed forms that the cases are compared with. Nothing here comes from the program."""
import itertools
import math

import numpy as np


def confined(young, poisson):
    """C11: stress over strain of a body that cannot narrow, Pa."""
    return young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson))


class Chain:
    """Masses in a row, joined by springs and held at one end. A bar of cells whose sides are held is this chain.
    `compliances`: 1 / k of each spring from the held end on, m/N; `masses`: behind each spring, kg."""

    def __init__(self, compliances, masses):
        reach = np.cumsum(compliances)
        flexibility = np.minimum.outer(reach, reach)
        roots = np.sqrt(masses)
        # The flexibility gives slow motions to all digits, however stiff other springs are.
        squares, shapes = np.linalg.eigh(flexibility * np.outer(roots, roots))
        self.frequencies = 1 / np.sqrt(squares)
        self.ends = shapes[-1] / roots[-1]  # of each mode, scaled by mass, at the free end

    def sudden(self, force, time, turned):
        """Displacement of the free end under a force that begins at 0 and stays. `turned`: angle by which a motion of
        frequency w turns in a step, and the step."""
        angles, step = turned(self.frequencies)
        return force * np.sum(self.ends**2 / self.frequencies**2 * (1 - np.cos(angles * time / step)))


def central(step):
    """Central differences turn a motion of frequency w by 2 asin(w step / 2) in a step."""
    return lambda frequencies: (2 * np.arcsin(np.minimum(frequencies * step / 2, 1)), step)


def midpoint(step):
    """The implicit rule turns it by 2 atan(w step / 2)."""
    return lambda frequencies: (2 * np.arctan(frequencies * step / 2), step)


def stiffest_of_cell(young, density, spacing):
    """The largest frequency, 1/s, of a free cell of the cubic lattice without a membrane, nu 1/4. Its springs along
    edges count by a quarter and those along diagonals of its faces by a half; all have k = 2/5 E l."""
    corners = list(itertools.product((0, 1), repeat=3))
    stiffness = np.zeros((8, 3, 8, 3))
    for (i, one), (j, other) in itertools.combinations(enumerate(corners), 2):
        rest = np.subtract(other, one)
        square = rest @ rest
        if square > 2:
            continue
        spring = (1 / 4 if square == 1 else 1 / 2) * np.outer(rest, rest) / square
        for a, b, sign in ((i, i, 1), (j, j, 1), (i, j, -1), (j, i, -1)):
            stiffness[a, :, b, :] += sign * spring
    largest = np.linalg.eigvalsh(stiffness.reshape(24, 24))[-1]
    return math.sqrt(largest * 0.4 * young * spacing / (density * spacing**3 / 8))


class Homogeneous:
    """The cubic lattice under homogeneous stretches a, b, b and c, the stretch of the fourth dimension; k = l = 1.
    `membrane`: lambda of I-m (k_alpha = k_beta = lambda, k_gamma = 3/4 lambda), 0 for none."""

    def __init__(self, membrane=0.0):
        self.membrane = membrane

    def energy(self, a, b, c=1.0):
        """Per cell."""
        base = [(1, a, 1), (2, b, 1), (4, math.hypot(a, b) / math.sqrt(2), 2), (2, b, 2)]
        total = sum(n * (math.sqrt(r) * (s - 1))**2 / 2 for n, s, r in base)
        if not self.membrane:
            return total
        for n, s, r in base:  # a cross spring has the square r of its base spring and that of the thickness, 1
            stiffness = self.membrane * (1 if r == 1 else 0.75)
            # The cross springs of a pair are two for two layers: one for each.
            total += n * stiffness * (math.sqrt(r * s * s + c * c) - math.sqrt(r + 1))**2 / 2
        return total + self.membrane * (c - 1)**2 / 4

    def force(self, a, b=1.0, c=1.0):
        """Along x on a face of a cell, over k l."""
        return slope(lambda x: self.energy(x, b, c), a)

    def pulled(self, a):
        """Stretches b and c, and the force over k l on a cell, when the sides are free."""
        b = c = 1.0
        for _ in range(200):
            b = minimum(lambda x: self.energy(a, x, c), b)
            c = minimum(lambda x: self.energy(a, b, x), c) if self.membrane else 1.0
        return b, c, self.force(a, b, c)


def slope(function, x, h=1e-5):
    return (8 * (function(x + h) - function(x - h)) - function(x + 2 * h) + function(x - 2 * h)) / (12 * h)


def minimum(function, x, h=1e-4):
    """Newton's method from x on."""
    for _ in range(30):
        curvature = (function(x + h) - 2 * function(x) + function(x - h)) / h**2
        x -= slope(function, x, h) / curvature
    return x


def softest(stretch, cells):
    """The least eigenvalue, over k, of the stiffness of a cube of cells between frictionless planes whose end along x
    is held at a homogeneous stretch: below 0 the cube buckles. No membrane."""
    side = Homogeneous().pulled(stretch)[0]
    deformed = np.diag([stretch, side, side])
    sites = {site: n for n, site in enumerate(itertools.product(range(cells + 1), repeat=3))}
    stiffness = np.zeros((len(sites), 3, len(sites), 3))
    for cell in itertools.product(range(cells), repeat=3):
        corners = [tuple(np.add(cell, step)) for step in itertools.product((0, 1), repeat=3)]
        for one, other in itertools.combinations(corners, 2):
            rest = np.subtract(other, one)
            if rest @ rest > 2:
                continue
            share = 1 / 4 if rest @ rest == 1 else 1 / 2
            place = deformed @ rest
            length = np.linalg.norm(place)
            along = np.outer(place, place) / length**2
            spring = share * (along + (1 - np.sqrt(rest @ rest) / length) * (np.eye(3) - along))
            i, j = sites[one], sites[other]
            for a, b, sign in ((i, i, 1), (j, j, 1), (i, j, -1), (j, i, -1)):
                stiffness[a, :, b, :] += sign * spring
    free = [3 * n + axis for site, n in sites.items() for axis in range(3)
            if site[axis] > 0 and not (axis == 0 and site[0] == cells)]
    flat = stiffness.reshape(3 * len(sites), 3 * len(sites))
    return np.linalg.eigvalsh(flat[np.ix_(free, free)])[0]
