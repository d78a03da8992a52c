# Prints, for a run of this scene, the start of the crack at the upper notch, its path, and its
# distance from the edge.
#   python3 cracks.py OUT
# The tip of the crack is the broken spring farthest from the middle of the plate. Springs that
# break behind the tip do not count.
import math
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from broken_springs import broken_springs

NOTCH, EDGE = (0.05, 0.1255), 0.2  # m


def crack(out):
    """List of (time, x, y), s and m, whenever the tip of the crack has advanced."""
    path, highest = [], NOTCH[1]
    for time, x, y in broken_springs(out):
        if 0.045 < x < 0.095 and y > highest:
            highest = y
            path.append((time, x, y))
    return path


def angle(place):
    """Angle between the notch and the line from its tip to `place`, degrees."""
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
