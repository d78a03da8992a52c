# The blasted sphere with cohesive cracks: what is cracked, and when, does not depend on the spacing.
#   cohesive_sphere.py PROGRAM FOLDER
import pathlib
import subprocess
import sys
import tempfile

program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
sys.path.append(str(folder))
from cracks import cracks

found = []
for spacing in ("1.25 mm", "1 mm"):
    with tempfile.TemporaryDirectory() as temporary:
        out = pathlib.Path(temporary) / "out"
        subprocess.run([program, "run", folder / "scene.json", "--set", f'/pipeline/0/spacing="{spacing}"', "--out", out, "--quiet"], check=True)
        found.append(cracks(out))
print(*found, sep="\n")
coarse, fine = found
allowed = {"dissipated, J": 0.02, "kinetic, J": 0.05, "cracked share": 0.02, "reach along (1, 0, 0), mm": 0.02, "reach along (1, 1, 0), mm": 0.02,
           "at the outer surface, us": 0.02}
wrong = [name for name, part in allowed.items() if not abs(coarse[name] / fine[name] - 1) < part]
if wrong:
    print("differ too much:", *wrong)
sys.exit(1 if wrong else 0)
