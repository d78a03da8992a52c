"""A bar of one cell across whose sides are held: a chain of masses, so that its motion is known in closed form."""
from verification.scenes import DENSITY, SPACING, YOUNG, cubic, elastic, fixed, mean, scene, stage
from verification.theory import Chain, confined

STRAIN = 1e-9  # of the softest part at rest; so small that the motion is linear to 1e-8


class Bar:
    """Parts from the held end on: cells, stiffness over YOUNG, density over DENSITY. The force at the free end would
    strain the softest part by `strain`."""

    def __init__(self, parts, spacing=SPACING, poisson=0.25, strain=STRAIN, young=YOUNG, density=DENSITY):
        self.parts, self.spacing, self.poisson = parts, spacing, poisson
        self.young, self.density = young, density
        self.area = spacing**2
        softest = min(k for _, k, _ in parts)
        self.force = strain * softest * confined(young, poisson) * self.area
        self.speed = (confined(young, poisson) / density)**0.5  # of waves in a part of 1 and 1
        self.cells = sum(cells for cells, _, _ in parts)

    def critical(self):
        """The critical step of each part alone: a wave passes a cell."""
        return min(self.spacing / self.speed * (rho / k)**0.5 for _, k, rho in self.parts)

    def stages(self):
        start, materials = 0, []
        for cells, k, rho in self.parts:
            region = {"half_space": {"point": [start * self.spacing, 0, 0], "normal": [-1, 0, 0]}}
            materials.append(elastic(young=self.young * k, density=self.density * rho, poisson=self.poisson,
                                     name=f"part{len(materials)}", **({"region": region} if start else {})))
            start += cells
        return [cubic([self.cells, 1, 1], spacing=self.spacing), *materials, fixed("all", "yz"), fixed("x_min", "x")]

    def scene(self, solver, **more):
        return scene(*self.stages(), stage("loads.force", on="x_max", total=[self.force, 0, 0]), solver,
                     mean("x_max", "end"), **more)

    def at_rest(self):
        """Displacement of the free end."""
        modulus = confined(self.young, self.poisson)
        return sum(self.force * cells * self.spacing / (modulus * k * self.area) for cells, k, _ in self.parts)

    def chain(self):
        modulus = confined(self.young, self.poisson)
        compliances = [self.spacing / (modulus * k * self.area) for cells, k, _ in self.parts for _ in range(cells)]
        cells = [rho * self.density * self.area * self.spacing for n, _, rho in self.parts for _ in range(n)]
        return Chain(compliances, [(here + there) / 2 for here, there in zip(cells, [*cells[1:], 0])])

    def moved(self, time, turned):
        """Displacement of the free end at `time` over that at rest."""
        return self.chain().sudden(self.force, time, turned) / self.at_rest()

    def measured(self, result):
        return result.last("probes/end", "displacement_x_mean") / self.at_rest()
