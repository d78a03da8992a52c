"""The families of cases, in the order of the page."""
from verification.families import (breaking, cells, contrast, degenerate, implicit, local, mass, membranes, negative,
                                   poisson, pulses, scales, spinning, stretch, tearing, thin)

FAMILIES = [module.FAMILY for module in (contrast, membranes, negative, poisson, stretch, cells, degenerate, spinning,
                                         scales, pulses, breaking, tearing, thin, implicit, local, mass)]
