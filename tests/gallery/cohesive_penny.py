# The penny crack that a wedge opens: its front stays a circle, and it takes its fracture energy.
#   cohesive_penny.py PROGRAM FOLDER
import pathlib
import subprocess
import sys
import tempfile

program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
sys.path.append(str(folder))
from front import front

with tempfile.TemporaryDirectory() as temporary:
    out = pathlib.Path(temporary) / "out"
    subprocess.run([program, "run", folder / "scene.json", "--out", out, "--quiet"], check=True)
    early, *_, late = found = front(out, 1e-3, [1.4e-3, 1.8e-3, 2.0e-3, 2.2e-3, 2.399e-3])
taken = (late[2] - early[2]) / (late[1] - early[1]) / 45
spread = max(max(radii) / min(radii) - 1 for radii, *_ in found[1:])
print(f"energy over G_c {taken:.3f}, radii differ by {spread:.3f}")
sys.exit(0 if abs(taken - 1) < 0.08 and spread < 0.06 and late[0][0] > 25e-3 else 1)
