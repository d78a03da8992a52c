# A cube from an image of a matrix with stiff grains. Plates along the load have equal strains; with
# equal Poisson ratios, the modulus of the cube is therefore exactly the mean of both moduli
# (Voigt). The modulus of a cube with grains lies between the bounds of Hashin and Shtrikman; for a
# Poisson ratio of 0.2, these bounds hold for E as for K and G.
#   microstructure.py PROGRAM SOURCE
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

program, page = sys.argv[1], pathlib.Path(sys.argv[2]) / "docs" / "gallery" / "microstructure"
sys.path.append(str(page))
import grains as image

MATRIX, STIFF = 20e9, 80e9
STRETCHED = {"type": "loads.displacement", "on": "z_max", "axes": "z", "value": [0, 0, 1e-6], "rise": 1e-9}
faults = []


def check(holds, what):
    print(what)
    if not holds:
        faults.append(what)


def energy(folder, spacing, young):
    """Stored energy of the stretched cube, J."""
    settings = {"/pipeline/0/spacing": spacing, "/pipeline/2/young": young, "/pipeline/5": STRETCHED}
    words = [word for at, value in settings.items() for word in ("--set", f"{at}={json.dumps(value)}")]
    subprocess.run([program, "run", folder / "scene.json", "--quiet", "--out", folder / "out", *words], check=True, stderr=subprocess.DEVNULL)
    return json.loads((folder / "out" / "summary.json").read_text())["energy"]["stored"]


def modulus_ratio(folder, spacing):
    """Modulus of the cube with stiff grains over that of the cube with grains like the matrix."""
    return energy(folder, spacing, STIFF) / energy(folder, spacing, MATRIX)


def bounds(share):
    """Bounds of Hashin and Shtrikman over the modulus of the matrix."""
    contrast = STIFF / MATRIX
    lower = 1 + share / (1 / (contrast - 1) + (1 - share) / 2)
    upper = contrast * (1 + (1 - share) / (1 / (1 / contrast - 1) + share / 2))
    return lower, upper


check((page / "grains.raw").read_bytes() == image.grains(24), "grains.raw is what grains.py writes")
with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    shutil.copy(page / "scene.json", folder)
    (folder / "grains.raw").write_bytes(image.layers(24))
    coarse, fine = modulus_ratio(folder, 1e-3), modulus_ratio(folder, 0.5e-3)
    voigt = (1 + STIFF / MATRIX) / 2
    # Springs between the phases are softer than the mean of both: the error is of first order.
    limit = 2 * fine - coarse
    check(abs(limit / voigt - 1) < 0.01, f"plates: {coarse:.4f} at 1 mm, {fine:.4f} at 0.5 mm, limit {limit:.4f}, exact {voigt}")
    (folder / "grains.raw").write_bytes(image.grains(24))
    ratio = modulus_ratio(folder, 1e-3)
    lower, upper = bounds(image.grains(24).count(2) / 24**3)
    check(lower < ratio < upper, f"grains: {ratio:.4f} at 1 mm, between {lower:.4f} and {upper:.4f}")
sys.exit(1 if faults else 0)
