# The springs that broke in a run, for scenes that keep where their particles are at rest:
#   { "type": "writers.csv", "name": "particles", "file": "particles", "every": 0, "last": false, "fields": [] }
import csv


def broken_springs(out):
    """Time and middle (x, y) of each broken spring of the run in the folder `out`, in the order of breaking; s and m."""
    with open(out / "particles" / "particles_000000.csv") as file:
        places = [(float(row["x"]), float(row["y"])) for row in csv.DictReader(file)]
    with open(out / "failures.csv") as file:
        for row in csv.DictReader(file):
            a, b = places[int(row["particle_a"])], places[int(row["particle_b"])]
            yield float(row["time"]), (a[0] + b[0]) / 2, (a[1] + b[1]) / 2
