# Prints, for a run of this scene, what is cracked at the end and when cracks come to the outer surface.
#   python3 cracks.py OUT
import csv
import json
import math
import pathlib
import sys

SOFT = 0.5  # damage from which a particle counts as part of the cracked zone
OUTER = 0.0475  # m, radius from which a particle counts as part of the outer surface


def cracks(out):
    """Returns energies in J, the share of particles that are cracked, how far the zone reaches along
    (1, 0, 0) and (1, 1, 0), mm, and the time in us when the first crack is at the outer surface."""
    energy = json.loads((out / "summary.json").read_text())["energy"]
    file = next(file for file in (out / "cracks").iterdir() if "times" not in file.name)
    with open(file) as table:
        rows = [[float(row[name]) for name in ("x", "y", "z", "damage", "crack_time")] for row in csv.DictReader(table)]

    def reach(*axis):
        lengths = [math.hypot(x, y, z) for x, y, z, damage, _ in rows
                   if damage > SOFT and x * axis[0] + y * axis[1] + z * axis[2] > 0.995 * math.hypot(x, y, z) * math.hypot(*axis)]
        return 1e3 * max(lengths)

    at_surface = [time for x, y, z, _, time in rows if math.hypot(x, y, z) > OUTER and not math.isnan(time)]
    return {
        "dissipated, J": energy["dissipated_failure"],
        "kinetic, J": energy["kinetic"],
        "cracked share": sum(row[3] > SOFT for row in rows) / len(rows),
        "reach along (1, 0, 0), mm": reach(1, 0, 0),
        "reach along (1, 1, 0), mm": reach(1, 1, 0),
        "at the outer surface, us": 1e6 * min(at_surface) if at_surface else math.nan,
    }


if __name__ == "__main__":
    for name, value in cracks(pathlib.Path(sys.argv[1])).items():
        print(f"{name}: {value:.4g}")
