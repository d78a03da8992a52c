# Prints, for a run of this scene, when the cracks start and the angle of the upper one with its
# notch.
#   python3 angle.py OUT
import math
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from damage_frames import cracked_particles

NOTCH = (0.05, 0.1255)  # m


def angle(out):
    """Returns when the upper crack starts (us), its angle with the notch from a line through its
    height of 3 to 75 mm (degrees), and how far ahead of the notch it is 30 and 60 mm up (mm)."""
    # The spall at the far edge is another crack.
    path = [(time, x - NOTCH[0], y - NOTCH[1]) for time, x, y in cracked_particles(out) if y > NOTCH[1] and 0.045 < x < 0.095]
    found = dict.fromkeys(["start, us", "angle", "30 mm up, mm", "60 mm up, mm"])
    if not path:
        return found
    found["start, us"] = 1e6 * path[0][0]
    line = [(x, y) for _, x, y in path if 3e-3 < y < 75e-3]
    if len(line) > 10:
        mean_x, mean_y = (sum(values) / len(line) for values in zip(*line))
        slope = sum((x - mean_x) * (y - mean_y) for x, y in line) / sum((y - mean_y) ** 2 for _, y in line)
        found["angle"] = 90 - math.degrees(math.atan(slope))
    for up in (30, 60):
        there = [1e3 * x for _, x, y in path if abs(1e3 * y - up) < 1.5]
        if there:
            found[f"{up} mm up, mm"] = sum(there) / len(there)
    return found


if __name__ == "__main__":
    for name, value in angle(pathlib.Path(sys.argv[1])).items():
        print(f"{name}: {'-' if value is None else format(value, '.1f')}")
