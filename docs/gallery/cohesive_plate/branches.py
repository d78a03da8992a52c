# Prints, for a run of this scene, when the crack passes, where it branches and where its branches go.
#   python3 branches.py OUT
# The crack branches where its axis ends.
import math
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from damage_frames import cracked_particles

NOTCH, AXIS, EDGE = 0.05, 0.02, 0.1  # m


def branches(out):
    """Returns times in us, lengths in mm and an angle in degrees: when the crack has run 1 mm and
    10 mm, how far its axis goes, the half angle between the branches, how far from the axis they
    are at the edge, and when they come there. None stands for what did not happen."""
    cracked = [place for place in cracked_particles(out) if place[1] > NOTCH - 1e-3]

    def first(distance):
        return next((1e6 * time for time, x, _ in cracked if x >= NOTCH + distance), None)

    found = {"1 mm, us": first(1e-3), "10 mm, us": first(10e-3), "branches at, mm": None, "half angle": None,
             "from the axis at the edge, mm": None, "at the edge, us": first(EDGE - NOTCH - 0.5e-3)}
    axis = [x for _, x, y in cracked if abs(y - AXIS) < 0.5e-3]
    if axis:
        found["branches at, mm"] = 1e3 * (max(axis) - NOTCH)
    far = [(x, abs(y - AXIS)) for _, x, y in cracked if NOTCH + 30e-3 < x < EDGE - 5e-3]
    if far:  # least squares for a line through the branches
        mean_x, mean_y = (sum(values) / len(far) for values in zip(*far))
        slope = sum((x - mean_x) * (y - mean_y) for x, y in far) / sum((x - mean_x) ** 2 for x, _ in far)
        found["half angle"] = math.degrees(math.atan(slope))
    edge = [abs(y - AXIS) for _, x, y in cracked if x > EDGE - 1e-3]
    if edge:
        found["from the axis at the edge, mm"] = 1e3 * max(edge)
    return found


if __name__ == "__main__":
    for name, value in branches(pathlib.Path(sys.argv[1])).items():
        print(f"{name}: {'-' if value is None else format(value, '.1f')}")
