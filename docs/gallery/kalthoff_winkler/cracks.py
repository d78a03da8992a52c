# Reads a run of this scene: when the upper notch's crack starts, where it goes, when it comes near the edge.
#   python3 cracks.py OUT
# The crack's tip is the broken spring farthest from the middle of the plate; what breaks elsewhere is behind it.
import math
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from broken_springs import broken_springs

NOTCH, EDGE = (0.05, 0.1255), 0.2  # m


def crack(out):
    """(time, x, y) of the tip each time that it has come farther; s and m."""
    path, highest = [], NOTCH[1]
    for time, x, y in broken_springs(out):
        if 0.045 < x < 0.095 and y > highest:
            highest = y
            path.append((time, x, y))
    return path


def angle(place):
    """Of the line from the notch's tip, against the notch, degrees."""
    return math.degrees(math.atan2(place[2] - NOTCH[1], place[1] - NOTCH[0]))


if __name__ == "__main__":
    path = crack(pathlib.Path(sys.argv[1]))
    if not path:
        sys.exit("no crack starts")
    print(f"starts at {1e6 * path[0][0]:.1f} us")
    for far in range(10, 75, 10):
        place = next((place for place in path if place[2] > NOTCH[1] + 1e-3 * far), None)
        if place:
            print(f"{far} mm up at {1e6 * place[0]:.1f} us: {angle(place):.0f} degrees from the notch")
    print(f"{1e3 * (EDGE - path[-1][2]):.0f} mm from the edge at {1e6 * path[-1][0]:.1f} us")
