# Prints, for a run of this scene, the times of the crack, its speed, and its branching.
#   python3 crack.py OUT
# The tip of the crack is the farthest broken spring. The crack has branched when springs
# within 3 mm of the tip have broken on lines more than 4 mm apart.
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from broken_springs import broken_springs

NOTCH, SURFACE_WAVES = 0.05, 2125.0  # m, m/s


def crack(out):
    """Returns the times (s) at which the tip has advanced by each further millimetre, and the time
    (s) and place (m) of branching, or None."""
    branched, tip, near_tip, passed = None, NOTCH, [], []
    for time, x, y in broken_springs(out):
        tip = max(tip, x)
        while NOTCH + 1e-3 * (len(passed) + 1) <= tip:
            passed.append(time)
        near_tip = [place for place in near_tip + [(x, y)] if place[0] > tip - 3e-3]
        heights = [height for _, height in near_tip]
        if branched is None and max(heights) - min(heights) > 4e-3:
            branched = time, tip
    return passed, branched


def speed(passed, first, last):
    """Mean speed between two millimetres of the path, m/s."""
    return 1e-3 * (last - first) / (passed[last - 1] - passed[first - 1])


if __name__ == "__main__":
    passed, branched = crack(pathlib.Path(sys.argv[1]))
    if not passed:
        sys.exit("the crack does not run")
    print(f"has run 1 mm at {1e6 * passed[0]:.1f} us, {len(passed)} mm at {1e6 * passed[-1]:.1f} us")
    print("does not branch" if branched is None else f"branches at {1e6 * branched[0]:.1f} us, {1e3 * branched[1]:.1f} mm along the plate")
    for first in range(1, len(passed) - 9, 5):
        v = speed(passed, first, first + 10)
        print(f"{first:3} to {first + 10:3} mm: {v:5.0f} m/s, {v / SURFACE_WAVES:.2f} of the surface waves'")
