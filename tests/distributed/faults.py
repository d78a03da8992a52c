"""What happens if a rank fails: faults.py PROGRAM FAULT.

All ranks must end, with the usual exit code and one message, and no checkpoint may be lost.
"""
import json
import os
import signal
import subprocess
import sys
import tempfile
import time

import launch
from same_bits import BLOCK, contents

RANKS = 3


class Trial:
    def __init__(self, program, folder):
        self.program, self.folder = program, folder
        self.out = os.path.join(folder, "out")
        self.scene = self.write(BLOCK)

    def write(self, scene):
        path = os.path.join(self.folder, "scene.json")
        with open(path, "w", encoding="utf-8") as file:
            json.dump(scene, file)
        return path

    def words(self, *more, out=None):
        return [self.program, "run", self.scene, "--out", out or self.out, "--threads", "1", *more]

    def run(self, ranks, *more, out=None, **environment):
        return launch.run(ranks, *self.words(*more, out=out), **environment)

    def hash_of(self, out):
        with open(os.path.join(out, "summary.json"), encoding="utf-8") as file:
            return json.load(file)["state_hash"]


def expect(condition, what):
    if not condition:
        sys.exit(what)


def expect_end(end, code, words, times=1):
    expect(end.returncode == code, f"exit code {end.returncode}, not {code}: {end.stderr}")
    expect(end.stderr.count(words) == times, f"'{words}' {times} times was expected in: {end.stderr}")


def wrong_scene(trial):
    """One message, though every rank finds the fault."""
    scene = json.loads(json.dumps(BLOCK))
    scene["pipeline"][0]["spacing"] = "-1 mm"
    trial.scene = trial.write(scene)
    expect_end(trial.run(RANKS), 2, "/pipeline/0/spacing")
    expect(not os.path.exists(trial.out), "something was written")


def folder_in_use(trial):
    """Only the first rank opens the folder; the others end with it."""
    os.makedirs(trial.out)
    with open(os.path.join(trial.out, "history.csv"), "w", encoding="utf-8") as file:
        file.write("mine\n")
    expect_end(trial.run(RANKS), 2, "history.csv")
    expect(sorted(os.listdir(trial.out)) == ["history.csv"], "the folder has changed")


def unstable(trial):
    """All ranks find it at the same step."""
    scene = json.loads(json.dumps(BLOCK))
    scene["pipeline"][3]["value"] = [0, 0, 1e5]
    del scene["pipeline"][1]["failure"]
    trial.scene = trial.write(scene)
    end = trial.run(RANKS)
    expect(end.returncode == 3, f"exit code {end.returncode}: {end.stderr}")
    with open(os.path.join(trial.out, "summary.json"), encoding="utf-8") as file:
        summary = json.load(file)
    expect(summary["status"] == "failed" and summary["exit_code"] == 3, "the summary does not say so")


def bad_plugins(trial):
    return os.path.join(os.path.dirname(os.path.dirname(trial.program)), "tests", "bad_plugins", "misbehaving")


def one_law_fails(trial):
    """A criterion throws in the rank whose springs reach their alarm first."""
    scene = json.loads(json.dumps(BLOCK))
    scene["plugins"] = [bad_plugins(trial)]
    scene["pipeline"][1]["failure"] = {"type": "failures.misbehaving", "limit": 1e-4}
    trial.scene = trial.write(scene)
    expect_end(trial.run(RANKS, "--quiet", HYPERLATTICE_TEST_FAULT="throw in breaks"), 4, "oops")
    with open(os.path.join(trial.out, "summary.json"), encoding="utf-8") as file:
        summary = json.load(file)
    expect(summary["status"] == "failed" and "oops" in summary["reason"], "the summary does not say so")


def one_writer_fails(trial):
    """Only the first rank writes."""
    scene = json.loads(json.dumps(BLOCK))
    scene["plugins"] = [bad_plugins(trial)]
    scene["pipeline"].append({"type": "writers.misbehaving", "every": "1 us"})
    trial.scene = trial.write(scene)
    expect_end(trial.run(RANKS, "--quiet", HYPERLATTICE_TEST_FAULT="throw in frame"), 4, "oops")


def no_engine(trial):
    """N copies of a run would write the same files."""
    end = trial.run(RANKS, "--engine", "nothing")
    expect(end.returncode == 4 and "engines.nothing" in end.stderr, end.stderr)
    expect("would run the whole scene" in end.stderr, end.stderr)
    expect(not os.path.exists(trial.out), "something was written")


def alone_on_request(trial):
    end = launch.run(1, *trial.words("--quiet"), OMPI_COMM_WORLD_SIZE="4")  # nobody else is there
    expect(end.returncode == 0, end.stderr)
    end = launch.run(1, *trial.words("--quiet", "--overwrite", "--engine", "none"), OMPI_COMM_WORLD_SIZE="4")
    expect(end.returncode == 0, end.stderr)


def study(trial):
    """Each process would write the same files."""
    out = os.path.join(trial.folder, "study_out")
    end = launch.run(RANKS, trial.program, "study", trial.scene, "--out", out)
    expect(end.returncode == 4 and "runs in one process" in end.stderr, end.stderr)
    expect(not os.path.exists(out), "something was written")


def other_instructions(trial):
    """A rank that would give other bits."""
    words = trial.words("--quiet")
    both = [*launch.command(2, *words), ":", "-n", "1", "-x", "HYPERLATTICE_INSTRUCTIONS=baseline", *words]
    both[both.index("-n") + 1] = "1"
    end = subprocess.run(both, capture_output=True, text=True, timeout=120, check=False, env=launch.environment())
    expect_end(end, 4, "rank 1: this rank must do the same as rank 0, but the instruction set is baseline")
    expect(not os.path.exists(trial.out), "something was written")


def children(pid):
    with open(f"/proc/{pid}/task/{pid}/children", encoding="utf-8") as file:
        return [int(word) for word in file.read().split()]


def long_scene(trial):
    scene = json.loads(json.dumps(BLOCK))
    scene["pipeline"][4]["end_time"] = "0.5 ms"
    trial.scene = trial.write(scene)
    whole = os.path.join(trial.folder, "whole")
    expect(trial.run(1, "--quiet", out=whole).returncode == 0, "the run in one process failed")
    return whole


def wait_for(condition, what):
    for _ in range(2000):
        if condition():
            return
        time.sleep(0.01)
    sys.exit(f"timed out: {what}")


def resumes(trial, whole, ranks):
    end = trial.run(ranks, "--resume", "--quiet")
    expect(end.returncode == 0, f"resumed on {ranks} ranks: exit code {end.returncode}: {end.stderr}")
    expect(trial.hash_of(trial.out) == trial.hash_of(whole), f"resumed on {ranks} ranks: other bits")
    for name in ("history.csv", "failures.csv", "probes/top.csv"):
        expect(contents(trial.out)[name] == contents(whole)[name], f"resumed on {ranks} ranks: other {name}")


def killed(trial):
    """One of three ranks is killed; the run goes on with 1, 2 and 4 ranks."""
    whole = long_scene(trial)
    for ranks in (1, 2, 4):
        trial.out = os.path.join(trial.folder, f"killed_{ranks}")
        run = launch.start(RANKS, *trial.words("--quiet", "--checkpoint-every", "0.001"))
        wait_for(lambda: os.path.exists(os.path.join(trial.out, "checkpoint.previous.bin")), "no checkpoint")
        os.kill(children(run.pid)[-1], signal.SIGKILL)
        run.communicate(timeout=60)
        expect(run.returncode != 0, "the launcher reports success")
        resumes(trial, whole, ranks)


def interrupted(trial):
    """A signal to one rank stops all, with a checkpoint."""
    whole = long_scene(trial)
    run = launch.start(RANKS, *trial.words("--quiet"))
    history = os.path.join(trial.out, "history.csv")
    wait_for(lambda: os.path.exists(history) and os.path.getsize(history) > 2000, "no history")
    os.kill(children(run.pid)[-1], signal.SIGINT)
    _, errors = run.communicate(timeout=60)
    expect(run.returncode == 130, f"exit code {run.returncode}: {errors}")
    expect(os.path.exists(os.path.join(trial.out, "checkpoint.bin")), "no checkpoint")
    resumes(trial, whole, 2)


def links_no_mpi(trial):
    """Nobody but the engine links MPI."""
    plugins = os.path.join(os.path.dirname(os.path.dirname(trial.program)), "lib", "hyperlattice")
    libraries = [os.path.join(plugins, name) for name in os.listdir(plugins) if name.endswith(".so")]
    for path in [trial.program, *libraries]:
        needs = subprocess.run(["ldd", path], capture_output=True, text=True, check=True).stdout
        expect(("libmpi" in needs) == path.endswith("engines.mpi.so"), f"{path}: {needs}")


CASES = [wrong_scene, folder_in_use, unstable, one_law_fails, one_writer_fails, no_engine, alone_on_request, study, other_instructions, killed, interrupted, links_no_mpi]


def main(program, name):
    with tempfile.TemporaryDirectory() as folder:
        next(case for case in CASES if case.__name__ == name)(Trial(program, folder))


if __name__ == "__main__":
    if sys.argv[1:] == ["cases"]:
        print(";".join(case.__name__ for case in CASES), end="")
    else:
        main(sys.argv[1], sys.argv[2])
