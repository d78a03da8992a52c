# Runs the notched plate and the plate of Kalthoff and Winkler. Cracks must be slower than surface
# waves, symmetric, and branch or turn as expected. Under a small load no crack may run.
#   plates.py PROGRAM GALLERY
import collections
import json
import pathlib
import subprocess
import sys
import tempfile

program, gallery = sys.argv[1], pathlib.Path(sys.argv[2])
sys.path += [str(gallery), str(gallery / "notched_plate"), str(gallery / "kalthoff_winkler")]
import crack as notched
import cracks as struck
from broken_springs import broken_springs

faults = []


def check(good, text):
    print(text)
    if not good:
        faults.append(text)


def run(name, out, *sets):
    command = [program, "run", gallery / name / "scene.json", "--quiet", "--out", out, *(word for text in sets for word in ("--set", text))]
    subprocess.run(command, check=True)
    energy = json.loads((out / "summary.json").read_text())["energy"]
    check(abs(energy["largest_relative_error"]) < 1e-3, f"{name}: balance error {energy['largest_relative_error']:.1e}")
    return out


def mirrored(out, height):
    """Do springs break in pairs that are mirror images across the middle of the plate?"""
    places = collections.Counter((f"{time:.4e}", round(1e6 * x), round(1e6 * y)) for time, x, y in broken_springs(out))
    return all(places[time, x, round(1e6 * height) - y] == number for (time, x, y), number in places.items())


with tempfile.TemporaryDirectory() as folder:
    folder = pathlib.Path(folder)
    out = run("notched_plate", folder / "plate")
    passed, branched = notched.crack(out)
    fastest = max(notched.speed(passed, first, first + 10) for first in range(1, len(passed) - 9))
    check(9e-6 < passed[0] < 14e-6, f"the crack has run 1 mm at {1e6 * passed[0]:.1f} us")
    check(branched is not None and 22e-6 < branched[0] < 38e-6, f"it branches at {branched}")
    check(fastest < 0.6 * notched.SURFACE_WAVES, f"its speed is at most {fastest:.0f} m/s")
    check(mirrored(out, 0.0405), "it breaks symmetrically")
    weak = [f"/pipeline/{n}/pressure=\"-0.2 MPa\"" for n in (2, 3)]
    passed, branched = notched.crack(run("notched_plate", folder / "weak", *weak))
    check(branched is None and len(passed) < 10, f"a fifth of the traction: {len(passed)} mm")

    out = run("kalthoff_winkler", folder / "struck")
    path = struck.crack(out)
    check(10e-6 < path[0][0] < 30e-6, f"struck: the first spring breaks at {1e6 * path[0][0]:.1f} us")
    check(50 < struck.angle(path[-1]) < 75, f"the crack turns by {struck.angle(path[-1]):.0f} degrees")
    check(path[-1][2] > 0.17, f"it comes to {1e3 * path[-1][2]:.0f} mm")
    check(mirrored(out, 0.2), "both notches alike")
    slow = run("kalthoff_winkler", folder / "slow", "/pipeline/2/value=[\"4 m/s\", 0, 0]")
    check(not struck.crack(slow), "a quarter of the speed: no crack")
print("\n".join(["", *faults]))
sys.exit(1 if faults else 0)
