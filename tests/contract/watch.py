"""Checks `hyperlattice watch` as a person uses it: edits in place and by renaming, faults and their mending, changes of
included files, tables and source plugins, a folder of someone else, a round that is cut off, and Ctrl-C.
Arguments: the program and a working folder, which is deleted and made anew."""
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import time

CRITERION = """#include <hyperlattice/failure.hpp>
#include "limit.hpp"

namespace hyperlattice {
class MyLimit {
 public:
  struct Options { double limit = 0; };
  static Schema<Options> schema() {
    return Schema<Options>("failures.my_limit", "Breaks springs above an elongation")
        .add<&Options::limit>("limit", "m", "elongation").at_least(0).example("1e-6");
  }
  explicit MyLimit(const Options& options) : options_(options) {}
  double alarm(const SpringFacts&) const { return options_.limit * factor; }
  bool breaks(const SpringFacts&, double elongation) const { return elongation > options_.limit * factor; }
 private:
  Options options_;
};
}  // namespace hyperlattice
HYPERLATTICE_PLUGIN("1.0") { plugin.add<hyperlattice::MyLimit>(); }
"""
MATERIAL = {"type": "materials.elastic", "young": "10 GPa", "poisson": 0.1, "density": 2500, "membrane": "I-m"}
LATTICE = {"type": "lattices.cubic", "spacing": 1e-3,
           "shape": {"box": {"low": [0, 0, 0], "high": [0.004, 0.004, 0.004]}}}
REST = [{"type": "loads.force", "on": "x_max", "total": [1, 0, 0]}, {"type": "solvers.explicit", "end_time": "20 us"}]


def scene_of(*pipeline, **more):
    return json.dumps({"format": "hyperlattice/1", **more, "pipeline": pipeline})


ROUND = re.compile(r"watch: round (\d+) \(([^)]*)\), (plan|run): (.*), in [0-9.]+ s")


class Watch:
    """A watch in a process; `expect` waits for the line of the next round."""

    def __init__(self, program, folder, *words, **more):
        self.errors, self.number, self.read = folder / "errors", 0, 0
        self.process = subprocess.Popen([program, "watch", *words], cwd=folder, stderr=self.errors.open("w"),
                                        stdout=(folder / "output").open("w"), start_new_session=True, **more)

    def expect(self, why, outcome, command="plan", seconds=100):
        """Returns what was printed in the round."""
        self.number += 1
        until = time.monotonic() + seconds
        is_over = False
        while time.monotonic() < until and not is_over:
            is_over = self.process.poll() is not None
            text = self.errors.read_text()[self.read:]
            met = ROUND.search(text)
            if met is not None:
                self.read += met.end()
                found = (int(met[1]), met[2], met[3], met[4])
                if found != (self.number, why, command, outcome):
                    raise AssertionError(f"{found} in place of {(self.number, why, command, outcome)}: {text}")
                return text[:met.end()]
            time.sleep(0.02)
        raise AssertionError(f"no round {self.number} because of {why}: {self.errors.read_text()}")

    def expect_nothing(self, seconds=1.5):
        time.sleep(seconds)
        text = self.errors.read_text()[self.read:]
        if ROUND.search(text):
            raise AssertionError(f"a round without a reason: {text}")

    def stop(self):
        self.process.send_signal(signal.SIGINT)
        code = self.process.wait(60)
        if code != 130:
            raise AssertionError(f"exit code {code}: {self.errors.read_text()}")


def rename_into(path, text):
    """Writes a file as many editors do: under another name, which is then renamed."""
    temporary = path.with_name("." + path.name + ".swp")
    temporary.write_text(text)
    os.replace(temporary, path)


def check_plan(program, folder):
    (folder / "parts").mkdir()
    scene, part, table = folder / "scene.json", folder / "parts/body.json", folder / "places.csv"
    part.write_text(json.dumps({"pipeline": [LATTICE, MATERIAL]}))
    good = scene_of(*REST, include=["parts/body.json"])
    scene.write_text(good)
    watch = Watch(program, folder, "scene.json", "--set", "loads.force/rise=1 us")
    watch.expect("first round", "done")
    if "particles" not in (folder / "output").read_text():
        raise AssertionError("the plan is not shown")
    # An editor that writes in three steps makes one round; a touched file makes none.
    scene.write_text("")
    scene.write_text(good[:40])
    scene.write_text(good.replace("20 us", "21 us"))
    watch.expect("scene.json changed", "done")
    os.utime(scene)
    (folder / "other.txt").write_text("nothing that the scene names")
    watch.expect_nothing()
    rename_into(scene, good.replace("end_time", "edn_time"))
    said = watch.expect("scene.json changed", "wrong input")
    if "did you mean \"end_time\"" not in said:
        raise AssertionError(f"the fault is not shown: {said}")
    rename_into(scene, good[:-5])
    watch.expect("scene.json changed", "wrong input")
    rename_into(scene, good)
    watch.expect("scene.json changed", "done")
    rename_into(part, json.dumps({"pipeline": [LATTICE, {**MATERIAL, "poisson": 0.7}]}))
    watch.expect("body.json changed", "wrong input")
    part.unlink()
    watch.expect("body.json changed", "wrong input")
    part.write_text(json.dumps({"pipeline": [LATTICE, MATERIAL]}))
    watch.expect("body.json changed", "done")
    # A table that is named before it exists.
    listed = {"type": "lattices.points", "file": "places.csv", "spacing": 1e-3}
    scene.write_text(scene_of(listed, MATERIAL, *REST))
    watch.expect("scene.json changed", "wrong input")
    table.write_text("x,y,z\n0,0,0\n")
    watch.expect("places.csv changed", "wrong input")
    watch.stop()


def check_plugin(program, folder):
    scene, source, header = folder / "scene.json", folder / "my_limit.cpp", folder / "limit.hpp"
    header.write_text("constexpr double factor = 1;\n")
    source.write_text(CRITERION)
    material = {**MATERIAL, "failure": {"type": "failures.my_limit", "limit": 1e-6}}
    scene.write_text(scene_of(LATTICE, material, *REST, plugins=["my_limit.cpp"]))
    watch = Watch(program, folder, "scene.json", env={**os.environ, "XDG_CACHE_HOME": str(folder / "cache")})
    watch.expect("first round", "done", seconds=300)
    rename_into(source, CRITERION.replace("options_.limit * factor", "options_.limits * factor"))
    said = watch.expect("my_limit.cpp changed", "wrong input", seconds=300)
    if "my_limit.cpp" not in said or "limits" not in said:
        raise AssertionError(f"the compiler's complaint is not shown: {said}")
    rename_into(source, CRITERION)
    watch.expect("my_limit.cpp changed", "done", seconds=300)
    header.write_text("constexpr double factor = 2\n")
    watch.expect("limit.hpp changed", "wrong input", seconds=300)
    watch.stop()


def wait_for_long_run(folder):
    """Waits until the run of 1000 s is under way."""
    scene, history = folder / "scene_watch/scene.resolved.json", folder / "scene_watch/history.csv"
    until = time.monotonic() + 60
    while time.monotonic() < until:
        if scene.exists() and '"end_time": 1000' in scene.read_text() and history.exists():
            return
        time.sleep(0.02)
    raise AssertionError("the long run does not begin")


def check_runs(program, folder):
    scene = folder / "scene.json"
    text = scene_of(LATTICE, MATERIAL, *REST)
    scene.write_text(text)
    # The results of someone else stay.
    subprocess.run([program, "run", "scene.json", "--quiet", "--out", "mine"], cwd=folder, check=True,
                   capture_output=True)
    mine = (folder / "mine/summary.json").read_bytes()
    watch = Watch(program, folder, "scene.json", "--run", "--quiet", "--out", "mine")
    watch.expect("first round", "left out, because mine holds files that no watch wrote; move them, or name another "
                 "folder by --out", "run")
    watch.stop()
    if (folder / "mine/summary.json").read_bytes() != mine or (folder / "mine/watch.txt").exists():
        raise AssertionError("the folder of someone else has changed")

    def ended_at():
        return json.loads((folder / "scene_watch/summary.json").read_text())["end_time"]

    watch = Watch(program, folder, "scene.json", "--run", "--quiet")
    watch.expect("first round", "done", "run")
    if ended_at() != 20e-6:
        raise AssertionError("the first round is not that of the scene")
    rename_into(scene, text.replace("20 us", "30 us"))
    watch.expect("scene.json changed", "done", "run")
    if ended_at() != 30e-6:
        raise AssertionError("the second round is not that of the changed scene")
    # A long run is given up when the scene changes, and its folder is used again.
    rename_into(scene, text.replace("20 us", "1000 s"))
    wait_for_long_run(folder)
    rename_into(scene, text.replace("20 us", "25 us"))
    watch.expect("scene.json changed", "given up, because files changed", "run")
    watch.expect("scene.json changed", "done", "run")
    if ended_at() != 25e-6 or list((folder / "scene_watch").glob("checkpoint*")):
        raise AssertionError("the changed scene did not run")
    # Ctrl-C stops the run as it stops `run`, with a checkpoint.
    rename_into(scene, text.replace("20 us", "1000 s"))
    wait_for_long_run(folder)
    watch.process.send_signal(signal.SIGINT)
    watch.expect("scene.json changed", "interrupted", "run")
    if watch.process.wait(60) != 130 or not (folder / "scene_watch/checkpoint.bin").exists():
        raise AssertionError("an interruption leaves no checkpoint, or another exit code")


def main():
    program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    failed = 0
    for check in (check_plan, check_plugin, check_runs):
        place = folder / check.__name__
        shutil.rmtree(place, ignore_errors=True)
        place.mkdir(parents=True)
        try:
            check(program, place)
        except AssertionError as error:
            print(f"{check.__name__}: {error}")
            failed += 1
    print("failed" if failed else "the watch sees what changes")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
