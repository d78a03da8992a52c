"""Memory of ranks: memory.py PROGRAM CASE.

The memory that a body takes in a rank, which is the peak of the run's own account less that of a
small body on as many ranks, must fall with the number of ranks.
"""
import copy
import json
import os
import signal
import sys
import tempfile

import launch
from faults import children, expect, wait_for

RANKS = 4
SMALL, LARGE = 8, 128  # particles along an edge
SPACING = 1e-3
CUBE = {
    "format": "hyperlattice/1",
    "precision": "float",
    "pipeline": [
        {"type": "lattices.cubic", "spacing": SPACING},
        {"type": "materials.elastic", "young": "10 GPa", "poisson": 0.25, "density": 2500, "membrane": "none"},
        {"type": "loads.gravity", "acceleration": [0, 0, -9.81]},
        {"type": "solvers.explicit", "end_time": "1.4 us"},
    ],
}


def cube(side):
    scene = copy.deepcopy(CUBE)
    scene["pipeline"][0]["shape"] = {"box": {"low": [0, 0, 0], "high": [side * SPACING] * 3}}
    return scene


def box(scene):
    """The state alone."""


def start_velocity(scene):
    scene["pipeline"][2] = {"type": "loads.start_velocity", "linear": [0, 0, 1]}


def materials(scene):
    side = scene["pipeline"][0]["shape"]["box"]["high"][2]
    scene["regions"] = {"upper": {"box": {"low": [0, 0, side / 2], "high": [1, 1, 1]}}}
    scene["pipeline"].insert(2, {**scene["pipeline"][1], "young": "20 GPa", "region": "upper"})


def probe(scene):
    scene["pipeline"].append({"type": "probes.point", "position": [0, 0, 0], "every": "0.5 us"})


def frames(scene):
    scene["pipeline"].append({"type": "writers.vtu", "every": "0.5 us"})


def checkpoint(scene):
    """Saved by a run that is killed, and restored by another one."""
    scene["pipeline"][3]["end_time"] = "4 us"


class Trial:
    def __init__(self, program, folder, change):
        self.program, self.folder, self.change = program, folder, change

    def words(self, side, ranks):
        scene = cube(side)
        self.change(scene)
        path = os.path.join(self.folder, f"scene_{side}.json")
        with open(path, "w", encoding="utf-8") as file:
            json.dump(scene, file)
        out = os.path.join(self.folder, f"out_{side}_{ranks}")
        return [self.program, "run", path, "--out", out, "--threads", "1", "--quiet"], out

    def peaks(self, side, ranks):
        """The largest memory of each rank, MB."""
        words, out = self.words(side, ranks)
        if self.change is checkpoint:
            run = launch.start(ranks, *words, "--checkpoint-every", "1e-9")
            wait_for(lambda: os.path.exists(os.path.join(out, "checkpoint.previous.bin")) or run.poll() is not None,
                     "no checkpoint")
            if run.poll() is None:
                os.kill(children(run.pid)[-1] if ranks > 1 else run.pid, signal.SIGKILL)
            run.communicate(timeout=60)
            words.append("--resume" if os.path.exists(os.path.join(out, "checkpoint.bin")) else "--overwrite")
            words += ["--checkpoint-every", "1e-9"]
        end = launch.run(ranks, *words)
        expect(end.returncode == 0, f"{ranks} ranks: exit code {end.returncode}: {end.stderr}")
        with open(os.path.join(out, "summary.json"), encoding="utf-8") as file:
            summary = json.load(file)
        peaks = summary.get("peak_memory_bytes_of_ranks", [summary["peak_memory_bytes"]])
        expect(len(peaks) == ranks and min(peaks) > 0, f"the summary has the peaks {peaks}")
        return [peak / 1e6 for peak in peaks]

    def of_body(self, ranks):
        return [large - small for large, small in zip(self.peaks(LARGE, ranks), self.peaks(SMALL, ranks))]


# What a rank takes at most, as a part of what one process takes: of the first rank, and of the others. A quarter
# is the ideal of four ranks; the first one has the fields that its outputs show.
CASES = {box: (0.5, 0.5), start_velocity: (0.5, 0.5), materials: (0.6, 0.6), checkpoint: (0.6, 0.6), probe: (0.9, 0.4),
         frames: (1.0, 0.25)}


def main(program, name):
    change = next(case for case in CASES if case.__name__ == name)
    with tempfile.TemporaryDirectory() as folder:
        trial = Trial(program, folder, change)
        alone, shared = trial.of_body(1)[0], trial.of_body(RANKS)
        print(f"{name}: {alone:.1f} MB in one process, {', '.join(f'{one:.1f}' for one in shared)} MB in {RANKS} ranks")
        for rank, (found, most) in enumerate(zip(shared, [CASES[change][0]] + [CASES[change][1]] * (RANKS - 1))):
            expect(found < most * alone, f"rank {rank} takes {found:.1f} MB, more than {most} of {alone:.1f} MB")


if __name__ == "__main__":
    if sys.argv[1:] == ["cases"]:
        print(";".join(case.__name__ for case in CASES), end="")
    else:
        main(sys.argv[1], sys.argv[2])
