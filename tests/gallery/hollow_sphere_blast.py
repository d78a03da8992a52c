# Runs the hollow sphere of the gallery at a spacing in mm. The run must be done, have as many
# particles and springs as this script counts, and keep its energy balance. Every spring must break
# in the same step as its 47 images under the symmetries of the cube.
#   hollow_sphere_blast.py PROGRAM SCENE SPACING
import csv
import itertools
import json
import subprocess
import sys
import tempfile

program, scene, spacing = sys.argv[1], sys.argv[2], int(sys.argv[3])
faults = []


def check(holds, what):
    if not holds:
        faults.append(what)


# Particles have odd integer coordinates, in units of half a spacing.
inner, outer = (2 * radius / spacing for radius in (20, 50))
reach = range(-int(outer) - 1 | 1, int(outer) + 2, 2)
sites = [(x, y, z) for z in reach for y in reach for x in reach if inner**2 < x * x + y * y + z * z < outer**2]
inside = set(sites)
forward = [(2, 0, 0), (-2, 2, 0), (0, 2, 0), (2, 2, 0), (0, -2, 2), (-2, 0, 2), (0, 0, 2), (2, 0, 2), (0, 2, 2)]
springs = sum((x + a, y + b, z + c) in inside for x, y, z in sites for a, b, c in forward)

with tempfile.TemporaryDirectory() as out:
    settings = {"/pipeline/0/spacing": f"{spacing} mm", "/pipeline/1/failure/limit": f"{3.5e-3 * spacing} mm"}
    command = [program, "run", scene, "--quiet", "--out", out]
    for pointer, value in settings.items():
        command += ["--set", f'{pointer}="{value}"']
    subprocess.run(command, check=True)
    with open(f"{out}/summary.json") as file:
        summary = json.load(file)
    with open(f"{out}/failures.csv") as file:
        events = [(int(e["step"]), int(e["particle_a"]), int(e["particle_b"])) for e in csv.DictReader(file)]

check(summary["status"] == "done", f"status {summary['status']}")
check(summary["particles"] == len(sites), f"{summary['particles']} particles, expected {len(sites)}")
check(summary["springs"] == springs, f"{summary['springs']} springs, expected {springs}")
check(spacing != 1 or (len(sites), springs) == (490432, 4309140), "not the paper's number of particles")
check(abs(summary["energy"]["largest_relative_error"]) < 0.01, f"energy balance: {summary['energy']}")
counted = summary["broken_springs"]["open"] + summary["broken_springs"]["closed"]
check(len(events) == counted > springs / 100, f"{len(events)} events, {counted} broken springs of {springs}")

# Mirrors at the coordinate planes, the exchange of two axes, and the rotation of all three axes
# generate all 48 symmetries.
symmetries = {
    "mirror x": lambda s: (-s[0], s[1], s[2]),
    "mirror y": lambda s: (s[0], -s[1], s[2]),
    "mirror z": lambda s: (s[0], s[1], -s[2]),
    "exchange x y": lambda s: (s[1], s[0], s[2]),
    "turn x y z": lambda s: (s[1], s[2], s[0]),
}
index = {site: number for number, site in enumerate(sites)}
broken = {(a, b): step for step, a, b in events}
check(len(broken) == len(events), "a spring broke twice")
for name, image in symmetries.items():
    moved = [index[image(site)] for site in sites]
    differing = sum(broken.get((min(moved[a], moved[b]), max(moved[a], moved[b]))) != step for (a, b), step in broken.items())
    check(differing == 0, f"{name}: {differing} of {len(broken)} springs break in another step than their image")

print("\n".join(faults) if faults else f"{len(sites)} particles, {len(broken)} broken springs of {springs}, each in the same step as its 47 images")
sys.exit(1 if faults else 0)
