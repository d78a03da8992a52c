# Finds the springs that broke in a run. The scene must write the rest positions of its particles:
#   { "type": "writers.csv", "name": "particles", "file": "particles",
#     "every": 0, "last": false, "fields": [] }
import csv


def broken_springs(out):
    """Yields time (s) and middle (x, y) (m) of each broken spring in the order of breaking; `out`
    is the folder of the run."""
    with open(out / "particles" / "particles_000000.csv") as file:
        places = [(float(row["x"]), float(row["y"])) for row in csv.DictReader(file)]
    with open(out / "failures.csv") as file:
        for row in csv.DictReader(file):
            a, b = places[int(row["particle_a"])], places[int(row["particle_b"])]
            yield float(row["time"]), (a[0] + b[0]) / 2, (a[1] + b[1]) / 2
