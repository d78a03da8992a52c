# Writes the images of this page as raw voxels of one byte each, x fastest; 1: matrix, 2: stiff.
#   python3 grains.py FOLDER [COUNT]     COUNT voxels along an edge, default 24
# grains.raw holds balls that may overlap. Their places and sizes are the same for any COUNT.
# layers.raw holds plates along the load, each two voxels thick.
import pathlib
import random
import sys

EDGE, RADIUS, BALLS = 24.0, 4.0, 22  # mm


def grains(count):
    place = random.Random(2017)
    balls = [[place.uniform(0, EDGE) for _ in range(3)] for _ in range(BALLS)]
    at = [(n + 0.5) * EDGE / count for n in range(count)]
    inside = lambda x, y, z: any((x - a) ** 2 + (y - b) ** 2 + (z - c) ** 2 < RADIUS**2 for a, b, c in balls)
    return bytes(2 if inside(x, y, z) else 1 for z in at for y in at for x in at)


def layers(count):
    return bytes(1 + x // 2 % 2 for _ in range(count * count) for x in range(count))


if __name__ == "__main__":
    folder, count = pathlib.Path(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 24
    (folder / "grains.raw").write_bytes(grains(count))
    (folder / "layers.raw").write_bytes(layers(count))
