# Prints, for a run of this scene, where the front of the crack is and what energy it has taken.
#   python3 front.py OUT [SPACING_IN_M]
import csv
import math
import pathlib
import sys

RADIUS = 9e-3  # m, of the crack at the start


def front(out, spacing, times):
    """Returns for each time, s, the radii of the front, m, in sectors about 0, 22.5 and 45 degrees, the
    new area of the whole quarter, m2, and the dissipated energy, J."""
    with open(out / "history.csv") as file:
        history = [(float(row["time"]), float(row["dissipated_failure"])) for row in csv.DictReader(file)]
    file = next(file for file in (out / "cracks").iterdir() if "times" not in file.name)
    cracked = {}  # first time of each column of particles
    with open(file) as table:
        for row in csv.DictReader(table):
            time = float(row["crack_time"])
            if not math.isnan(time):
                column = round(float(row["x"]) / spacing), round(float(row["y"]) / spacing)
                cracked[column] = min(time, cracked.get(column, math.inf))

    def radius(time, degrees):
        radii = [math.hypot(*column) * spacing for column, when in cracked.items()
                 if when <= time and abs(math.degrees(math.atan2(column[1], column[0])) - degrees) < 3.5]
        return max(radii, default=0)

    def area(time):
        return sum((0.5 if x == 0 else 1) * (0.5 if y == 0 else 1) * spacing**2
                   for (x, y), when in cracked.items() if when <= time and math.hypot(x, y) * spacing > RADIUS)

    return [([radius(time, degrees) for degrees in (0, 22.5, 45)], area(time), [energy for when, energy in history if when <= time][-1])
            for time in times]


if __name__ == "__main__":
    spacing = float(sys.argv[2]) if len(sys.argv) > 2 else 1e-3
    for radii, area, energy in front(pathlib.Path(sys.argv[1]), spacing, [1e-4 * n for n in range(14, 25, 2)]):
        print("radii", *(f"{1e3 * radius:.1f}" for radius in radii), f"mm, area {1e6 * area:.0f} mm2, energy {1e3 * energy:.2f} mJ")
