# Runs the crawler of the gallery for one second. With bristles it must move forwards, with reversed
# bristles backwards, and without bristles almost nowhere.
#   crawler.py PROGRAM SCENE
import csv
import json
import subprocess
import sys
import tempfile

program, scene = sys.argv[1:3]
faults = []


def travelled(forward, back):
    with tempfile.TemporaryDirectory() as out:
        command = [program, "run", scene, "--quiet", "--out", out, "--set", "/pipeline/6/end_time=1", "--set", f"/pipeline/3/friction={forward}",
                   "--set", f"/pipeline/3/friction_back={back}", "--set", "/pipeline/8/every=0"]
        subprocess.run(command, check=True)
        with open(f"{out}/summary.json") as file:
            summary = json.load(file)
        with open(f"{out}/probes/body.csv") as file:
            rows = list(csv.DictReader(file))
    if abs(summary["energy"]["largest_relative_error"]) > 0.02:
        faults.append(f"balance: {summary['energy']}")
    return float(rows[-1]["displacement_x_mean"])


with_bristles, turned, without = travelled(0.2, 0.8), travelled(0.8, 0.2), travelled(0.5, 0.5)
if with_bristles < 0.015:
    faults.append(f"it crawls by {with_bristles} m in a second")
if turned > -0.015:
    faults.append(f"with its bristles turned round it crawls by {turned} m")
if abs(without) > 0.25 * with_bristles:
    faults.append(f"without bristles it crawls by {without} m")
print("\n".join(faults) if faults else f"in a second: {1e3 * with_bristles:.1f} mm with bristles, {1e3 * turned:.1f} mm with them turned round, "
      f"{1e3 * without:.1f} mm without")
sys.exit(1 if faults else 0)
