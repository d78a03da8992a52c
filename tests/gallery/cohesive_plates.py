# The crack of a cohesive plate branches where an independent program of the same model says, and
# the cracks of a struck plate take the angle that it says. Its results at other spacings are the bounds.
#   cohesive_plates.py PROGRAM GALLERY SCENE
import pathlib
import subprocess
import sys
import tempfile

program, gallery, scene = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3]
sys.path.append(str(gallery / scene))


def run(*options):
    out = pathlib.Path(tempfile.mkdtemp(prefix="hyperlattice_" + scene)) / "out"
    subprocess.run([program, "run", gallery / scene / "scene.json", "--out", out, *options], check=True, stdout=subprocess.DEVNULL)
    return out


failures = 0


def expect(name, value, low, high):
    global failures
    good = value is not None and low <= value <= high
    failures += not good
    print(f"{'' if good else 'FAILED: '}{name} {value}, expected {low} to {high}")


if scene == "cohesive_plate":
    from branches import branches

    found = branches(run())
    expect("1 mm, us", found["1 mm, us"], 16.5, 19)
    expect("10 mm, us", found["10 mm, us"], 28, 30.5)
    expect("branches at, mm", found["branches at, mm"], 18, 20)
    expect("from the axis at the edge, mm", found["from the axis at the edge, mm"], 14.5, 17)
    expect("at the edge, us", found["at the edge, us"], 76, 80)
else:
    from angle import angle

    expect("angle", angle(run())["angle"], 64.7, 70.7)
    weaker = angle(run("--set", '/pipeline/1/failure/strength="1.0593 GPa"'))
    expect("angle of a strength less 1 %", weaker["angle"], 64.7, 70.7)
    slow = angle(run("--set", '/pipeline/2/value=["4.125 m/s", 0, 0]'))
    if slow["start, us"] is not None:
        failures += 1
        print("FAILED: a crack at a quarter of the speed")
sys.exit(failures != 0)
