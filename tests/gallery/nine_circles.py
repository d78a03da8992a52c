# Glass in indirect tension and in bending, and in torsion with `long`: strengths against the surface
# of strength and the theory of elasticity.
#   nine_circles.py PROGRAM FOLDER short|long
import csv
import math
import pathlib
import subprocess
import sys
import tempfile

program, folder, kind = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3]
TENSION, SHEAR = 40e6, 44.4e6  # Pa
failures = 0


def largest(scene, probe, column, *options):
    """Runs a scene without its picture and returns the largest value of a column of a probe."""
    with tempfile.TemporaryDirectory() as temporary:
        out = pathlib.Path(temporary) / "out"
        subprocess.run([program, "run", folder / scene, "--out", out, "--quiet", *options], check=True)
        with open(out / "probes" / f"{probe}.csv") as file:
            return max(abs(float(row[column])) for row in csv.DictReader(file))


def expect(name, value, low, high):
    global failures
    good = low <= value <= high
    failures += not good
    print(f"{'' if good else 'FAILED: '}{name} {value:.4g}, expected {low:.4g} to {high:.4g}")


if kind == "short":
    # The centre has the stresses s, 0 and -3 s; the force acts over 0.62 mm of the edge.
    expect("disc, Pa", largest("disc.json", "stress", "stress"), 0.97 * 44.81e6, 1.03 * 44.81e6)
    # A section all of whose lower half bears the strength would have 1.5 to 3 times the elastic moment.
    low, high = (largest("beam.json", "stress", "stress", "--set", f'/variables/height="{height} mm"',
                         "--set", f'/variables/pressed="{pressed} um"') for height, pressed in ((0.9, -15), (1.8, -7)))
    expect("beam of 1.8 mm over the strength", high / TENSION, 1.05, 1.2)
    expect("effect of size of half the height", (low / TENSION - 1) / (high / TENSION - 1), 1.5, 3)
else:
    outer, inner = 1.2e-3, 0.8e-3
    elastic = SHEAR * math.pi / 2 * (outer**4 - inner**4) / outer
    uniform = SHEAR * 2 * math.pi / 3 * (outer**3 - inner**3)
    expect("torque of the tube, N m", largest("tube.json", "middle", "moment_z"), 0.97 * elastic, uniform)
sys.exit(failures != 0)
