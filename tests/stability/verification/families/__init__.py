"""The families of cases, in the order of the page."""
from verification.families import contrast, membranes, poisson, stretch

FAMILIES = [module.FAMILY for module in (contrast, membranes, poisson, stretch)]
