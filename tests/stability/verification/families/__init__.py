"""The families of cases, in the order of the page."""
from verification.families import cells, contrast, degenerate, implicit, membranes, negative, poisson, scales, spinning, stretch, thin

FAMILIES = [module.FAMILY for module in (contrast, membranes, negative, poisson, stretch, cells, degenerate, spinning, scales, thin, implicit)]
