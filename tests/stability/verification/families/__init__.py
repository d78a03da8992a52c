"""The families of cases, in the order of the page."""
from verification.families import (breaking, cells, contrast, degenerate, implicit, membranes, negative, poisson,
                                   pulses, scales, spinning, stretch, thin)

FAMILIES = [module.FAMILY for module in (contrast, membranes, negative, poisson, stretch, cells, degenerate, spinning,
                                         scales, pulses, breaking, thin, implicit)]
