# Prints, for a run of this scene, when the crack passes, where it branches and where its branches go.
#   python3 branches.py OUT
# A place is cracked when a spring there has lost all of its stiffness. The crack branches where its
# axis ends.
import math
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from broken_springs import broken_springs

NOTCH, AXIS, EDGE = 0.05, 0.02, 0.1  # m


def branches(out):
    """Returns times and places in us and mm: when the crack has run 1 mm and 10 mm, where its axis
    ends and when, the half angle between the branches in degrees, how far from the axis they
    are at the edge, and when they reach it. None stands for what did not happen."""
    springs = list(broken_springs(out))
    found = dict.fromkeys(["1 mm, us", "10 mm, us", "axis ends, mm", "axis ends, us", "half angle", "at the edge, mm", "edge, us"])

    def first(distance):
        return next((1e6 * time for time, x, y in springs if x >= NOTCH + distance), None)

    found["1 mm, us"], found["10 mm, us"] = first(1e-3), first(10e-3)
    axis = [(x, time) for time, x, y in springs if abs(y - AXIS) < 0.75e-3]
    if axis:
        x, time = max(axis)
        found["axis ends, mm"], found["axis ends, us"] = 1e3 * (x - NOTCH), 1e6 * time
        far = [(x, abs(y - AXIS)) for _, x, y in springs if NOTCH + 25e-3 < x < EDGE - 5e-3]
        if far:  # least squares for a line through the branches
            mean_x, mean_y = (sum(values) / len(far) for values in zip(*far))
            slope = sum((x - mean_x) * (y - mean_y) for x, y in far) / sum((x - mean_x) ** 2 for x, _ in far)
            found["half angle"] = math.degrees(math.atan(slope))
    edge = [(time, abs(y - AXIS)) for time, x, y in springs if x > EDGE - 1e-3]
    if edge:
        found["edge, us"] = 1e6 * edge[0][0]
        found["at the edge, mm"] = 1e3 * max(y for _, y in edge)
    return found


if __name__ == "__main__":
    for name, value in branches(pathlib.Path(sys.argv[1])).items():
        print(f"{name}: {'-' if value is None else format(value, '.1f')}")
