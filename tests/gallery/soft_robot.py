# Runs the soft robot of the gallery at a spacing in mm with two time steps. No external force acts,
# so that the momentum must stay zero to round-off. The injected energy must equal kinetic plus
# stored energy, with an error that falls with the square of the step. The wings must move.
#   soft_robot.py PROGRAM SCENE SPACING
import csv
import json
import math
import subprocess
import sys
import tempfile

program, scene, spacing = sys.argv[1:4]
faults = []


def check(holds, what):
    if not holds:
        faults.append(what)


def run(safety, end_us, threads):
    force = 32e3 * (float(spacing) / 2) ** 2  # N, in proportion to the section of a spring
    with tempfile.TemporaryDirectory() as out:
        settings = [f'/pipeline/0/spacing="{spacing} mm"', f"/pipeline/4/force={force}", f"/pipeline/5/safety={safety}", f'/pipeline/5/end_time="{end_us} us"', "/pipeline/7/every=0"]
        command = [program, "run", scene, "--quiet", "--out", out, "--threads", str(threads)]
        for setting in settings:
            command += ["--set", setting]
        subprocess.run(command, check=True)
        with open(f"{out}/summary.json") as file:
            summary = json.load(file)
        with open(f"{out}/history.csv") as file:
            history = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
        with open(f"{out}/probes/tip.csv") as file:
            tip = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
    return summary, history, tip


coarse, history, tip = run(0.5, 90, 2)
fine, _, _ = run(0.25, 90, 2)
single, _, _ = run(0.5, 90, 1)
check(single["state_hash"] == coarse["state_hash"], "another thread, other bits")
errors = [s["energy"]["largest_relative_error"] for s in (coarse, fine)]
check(errors[0] < 0.02, f"balance: {errors[0]}")
check(3.2 < errors[0] / errors[1] < 5, f"half the step makes the balance {errors[0] / errors[1]:.2f} times as good, expected 4")
energy = coarse["energy"]
check(energy["dissipated"] == 0 and energy["injected"] > 0, f"energies {energy}")
mass = 1500 * (float(spacing) * 1e-3) ** 3 * coarse["particles"]
scale = math.sqrt(2 * mass * max(row["kinetic"] for row in history))
momentum = max(math.hypot(row["momentum_x"], row["momentum_y"], row["momentum_z"]) for row in history)
check(momentum < 1e-12 * scale, f"momentum {momentum / scale} of sqrt(2 m kinetic)")
moved = max(abs(row["displacement_y_mean"]) for row in tip)
check(moved > 5e-3, f"the wing's tip moves by {moved} m")

long_run, history, tip = run(0.5, 1000, 2)  # many oscillations
check(long_run["status"] == "done" and long_run["energy"]["largest_relative_error"] < 0.05, f"after a millisecond: {long_run['energy']}")
momentum = max(math.hypot(row["momentum_x"], row["momentum_y"], row["momentum_z"]) for row in history)
check(momentum < 1e-11 * scale, f"after a millisecond: momentum {momentum / scale}")

print("\n".join(faults) if faults else f"{coarse['particles']} particles: balance off by {errors[0]:.2e} and {errors[1]:.2e} with half the step, "
      f"momentum {momentum / scale:.1e}, tip moved by {1e3 * moved:.1f} mm in 90 us; after 1 ms the balance is off by "
      f"{long_run['energy']['largest_relative_error']:.1e}")
sys.exit(1 if faults else 0)
