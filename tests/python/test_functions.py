"""Python functions as components: loads.python, failures.python, writers.python."""
import csv
import functools
import gc
import json
import subprocess
import threading
import traceback
import unittest
import weakref

import numpy as np
import hyperlattice
from scenes import PROGRAM, FolderTest

LIMIT = 2e-6  # m
EACH = (300.0, 20.0, -5.0)  # N


def pulled(load=None, failure=None, stages=(), solver=None, lattice=None, end="20 us"):
    """A bar that a force pulls at one end until springs break."""
    return {"format": "hyperlattice/1", "pipeline": [
        {**(lattice or {"type": "lattices.cubic", "boundary": "cells"}), "spacing": "1 mm",
         "shape": {"box": {"low": [0, 0, 0], "high": ["8 mm", "4 mm", "4 mm"]}}},
        {"type": "materials.elastic", "young": "10 GPa", "density": 2500,
         **({"membrane": "none"} if lattice else {"poisson": 0.2, "membrane": "I-m"}),
         **({"failure": failure} if failure else {})},
        load or {"type": "loads.expression", "on": "x_max", "expression": "1", "each": list(EACH)},
        solver or {"type": "solvers.explicit", "end_time": end, "energy_tolerance": 0}, *stages]}


def python_load(function, **options):
    return {"type": "loads.python", "on": "x_max", "function": function, **options}


def python_failure(function, **options):
    return {"type": "failures.python", "function": function, **options}


def push(state):
    return np.tile(EACH, (len(state.mass), 1))


def too_long(springs):
    return springs.elongation > LIMIT


def failures_of(result):
    with open(result.folder / "failures.csv", newline="") as table:
        return list(csv.reader(table))


class Loads(FolderTest):
    def test_has_the_bits_of_a_built_in_load(self):
        expected = hyperlattice.run(pulled(), threads=1)
        for threads in (1, 2, 3):
            result = hyperlattice.run(pulled(python_load(push)), threads=threads)
            self.assertEqual(result.state_hash, expected.state_hash)
            for key in ("kinetic", "stored", "injected", "error"):
                self.assertEqual(result.summary["energy"][key], expected.summary["energy"][key])
        self.assertGreater(expected.summary["energy"]["injected"], 0.1)

    def test_gets_the_state_of_its_particles(self):
        seen = []

        def rest(state):
            seen.append(state)
            return 1e5 * state.displacement - 0.5 * state.velocity + [1, 0, 0]

        with hyperlattice.Simulation(pulled(python_load(rest, stiffness=1e5, viscosity="0.5 N s/m"))) as simulation:
            ends = np.flatnonzero(simulation.positions[:, 0] == simulation.positions[:, 0].max())
            mass = simulation.field("mass")[ends]
            for step in range(5):
                before = [np.array(simulation.field(name))[ends] for name in ("displacement", "velocity")]
                time = simulation.time
                seen.clear()
                simulation.step()
                state = seen[0]
                self.assertEqual(state.time, time)
                np.testing.assert_array_equal(state.displacement, before[0])
                np.testing.assert_array_equal(state.velocity, before[1])
            np.testing.assert_array_equal(state.particles, ends)
            np.testing.assert_array_equal(state.positions, simulation.positions[ends])
            np.testing.assert_allclose(state.mass, mass, rtol=1e-12)
            self.assertGreater(abs(state.displacement).max(), 0)
            with self.assertRaises(ValueError):
                state.positions[0, 0] = 1

    def test_equals_a_floor(self):
        stiffness, spacing, depth = 1e6, 1e-3, 1e-7
        point = [8e-3 - depth, 0, 0]

        def floor(state):
            inside = state.positions[:, 0] - point[0] + state.displacement[:, 0]
            force = np.zeros_like(state.displacement)
            force[:, 0] = -stiffness * state.share * np.maximum(inside, 0)
            return force

        built_in = {"type": "loads.floor", "on": "x_max", "point": point, "normal": [-1, 0, 0],
                    "stiffness": stiffness, "damping": 0}
        solver = {"type": "solvers.explicit", "end_time": "20 us", "time_step": "0.25 us"}
        simulations = [hyperlattice.Simulation(pulled(load, solver=solver)) for load in
                       (built_in, python_load(floor, stiffness=stiffness))]
        for simulation in simulations:
            simulation.run()
        one, other = (simulation.field("displacement") for simulation in simulations)
        self.assertGreater(abs(one).max(), 1e-2 * depth)
        np.testing.assert_allclose(other, one, rtol=0, atol=1e-12 * abs(one).max())

    def test_solvers_at_rest_refuse_it(self):
        with self.assertRaisesRegex(hyperlattice.SceneError, "loads that do not answer to the motion"):
            hyperlattice.plan(pulled(python_load(push), solver={"type": "solvers.relaxation"}))


class Criteria(FolderTest):
    def test_has_the_bits_of_a_built_in_criterion(self):
        expected = hyperlattice.run(pulled(failure={"type": "failures.elongation", "limit": LIMIT}), threads=1)
        self.assertGreater(len(failures_of(expected)), 20)
        for threads in (1, 2, 3):
            result = hyperlattice.run(pulled(failure=python_failure(too_long, above=LIMIT)), threads=threads)
            self.assertEqual(result.state_hash, expected.state_hash)
            self.assertEqual(failures_of(result), failures_of(expected))

    def test_is_asked_about_all_springs(self):
        expected = hyperlattice.run(pulled(failure={"type": "failures.elongation", "limit": LIMIT}))
        counts = []

        def all_springs(springs):
            counts.append(springs.elongation.size)
            self.assertTrue((springs.a < springs.b).all())
            np.testing.assert_array_equal(springs.strain, springs.elongation / springs.rest_length)
            return springs.elongation > LIMIT

        results = [hyperlattice.run(pulled(failure=python_failure(all_springs)), threads=threads)
                   for threads in (1, 2)]
        self.assertEqual(counts[0], results[0].summary["springs"])
        self.assertEqual(len(counts), 2 * results[0].summary["steps"])
        self.assertEqual(results[0].state_hash, results[1].state_hash)
        # The kernels round otherwise for springs above their alarm, so that the last digits differ.
        broken = [sorted(row[2:4] for row in failures_of(one)[1:]) for one in (expected, results[0])]
        self.assertEqual(*broken)

    def test_sees_whole_arrays_in_one_order(self):
        """One spring breaks in each step: the longest. Only a criterion that sees all springs can say which."""
        def longest(springs):
            broken = np.zeros(springs.elongation.size, dtype=bool)
            if springs.elongation.size:
                broken[np.argmax(springs.elongation)] = True
            arrays.append((springs.a, springs.b, springs.rate, springs.stiffness))
            return broken

        for lattice in (None, {"type": "lattices.random", "coordination": 8.4}):
            hashes, orders = [], []
            for threads in (1, 2, 3):
                arrays = []
                result = hyperlattice.run(pulled(failure=python_failure(longest, above=LIMIT), end="10 us",
                                                 lattice=lattice), threads=threads)
                hashes.append(result.state_hash)
                orders.append(arrays)
                steps = [row[0] for row in failures_of(result)[1:]]
                self.assertGreater(len(steps), 3)
                self.assertEqual(len(steps), len(set(steps)))
            self.assertEqual(len(set(hashes)), 1, lattice)
            for other in orders[1:]:
                for mine, theirs in zip(orders[0], other):
                    for one, two in zip(mine, theirs):
                        np.testing.assert_array_equal(one, two)

    def test_has_the_bits_of_the_same_criterion_in_cpp(self):
        (self.folder / "longest.cpp").write_text("""
#include <hyperlattice/array_failure.hpp>
using namespace hyperlattice;
struct Longest {
  struct Options { double above; };
  static Schema<Options> schema() {
    return Schema<Options>("failures.longest", "The longest spring breaks")
        .add<&Options::above>("above", "m", "elongation").example("\\"1 um\\"");
  }
  explicit Longest(const Options& o) : above(o.above) {}
  double alarm(const SpringFacts&) const { return above; }
  void breaks(const SpringArrays& springs, std::span<std::uint8_t> broken) const {
    const auto longest = std::max_element(springs.elongation.begin(), springs.elongation.end());
    if (!broken.empty()) broken[longest - springs.elongation.begin()] = 1;
  }
  double above;
};
HYPERLATTICE_PLUGIN("1.0") { plugin.add<Longest>(); }
""")
        cpp = pulled(failure={"type": "failures.longest", "above": LIMIT}, end="10 us")
        cpp["plugins"] = ["longest.cpp"]

        def longest(springs):
            return np.arange(springs.elongation.size) == np.argmax(springs.elongation)

        expected = hyperlattice.run(cpp)
        self.assertGreater(sum(expected.summary["broken_springs"].values()), 3)
        self.assertEqual(hyperlattice.run(pulled(failure=python_failure(longest, above=LIMIT), end="10 us")).state_hash,
                         expected.state_hash)

    def test_at_rest(self):
        def scene(failure):
            return pulled({"type": "loads.displacement", "on": "x_max", "value": ["20 um", 0, 0], "rise": "1 s"},
                          failure, [{"type": "loads.fixed", "on": "x_min"},
                                    {"type": "solvers.static", "load_steps": 4}])

        def without_steps(failure):
            made = scene(failure)
            made["pipeline"] = [stage for stage in made["pipeline"] if stage["type"] != "solvers.explicit"]
            return made

        one = hyperlattice.run(without_steps({"type": "failures.elongation", "limit": LIMIT}))
        other = hyperlattice.run(without_steps(python_failure(too_long, above=LIMIT)))
        self.assertGreater(sum(one.summary["broken_springs"].values()), 0)
        self.assertEqual(other.state_hash, one.state_hash)

    def test_one_of_several_criteria(self):
        both = [{"type": "failures.elongation", "limit": 1.2 * LIMIT},
                python_failure(lambda springs: (springs.elongation > LIMIT) & (springs.rate > 0), above=LIMIT)]
        hashes = {hyperlattice.run(pulled(failure=both), threads=threads).state_hash for threads in (1, 2)}
        self.assertEqual(len(hashes), 1)


class Writers(FolderTest):
    def test_gets_the_fields_of_a_built_in_writer(self):
        frames = []
        stages = [{"type": "writers.python", "function": frames.append, "every": "5 us",
                   "fields": ["displacement", "stress", "mass"]},
                  {"type": "writers.vtu", "every": "5 us", "fields": ["displacement", "stress"], "precision": "double"}]
        result = hyperlattice.run(pulled(stages=stages))
        self.assertEqual([frame.number for frame in frames], list(range(5)))
        np.testing.assert_array_equal([frame.time for frame in frames], result.times())
        for number, frame in enumerate(frames):
            self.assertEqual(list(frame), ["displacement", "stress", "mass"])
            np.testing.assert_array_equal(frame.positions, result.points(number))
            for name in ("displacement", "stress"):
                np.testing.assert_array_equal(frame[name], result.field(name, number))
            self.assertEqual(frame["mass"].shape, (len(frame.particles),))

    def test_region_and_files(self):
        def save(frame):
            np.save(frame.file(f"end_{frame.number}.npy"), frame["displacement"])
            kept.append(frame)

        kept = []
        writer = {"type": "writers.python", "function": save, "every": "10 us", "region": "x_max",
                  "fields": ["displacement"]}
        result = hyperlattice.run(pulled(stages=[writer]), out="saved")
        x = kept[-1].positions[:, 0]
        self.assertEqual(x.min(), x.max())
        np.testing.assert_array_equal(np.load(result.folder / "end_2.npy"), kept[-1]["displacement"])
        with self.assertRaisesRegex(RuntimeError, "the frame is over"):
            kept[-1].file("late.npy")
        hyperlattice.run(pulled(stages=[writer]), out="saved", overwrite=True)

    def test_writer_and_load_take_turns(self):
        """The writer runs in a thread of its own, beside a load that needs Python too."""
        frames = []
        stages = [{"type": "writers.python", "function": frames.append, "every": "0.5 us"}]
        result = hyperlattice.run(pulled(python_load(push), stages=stages), threads=2)
        self.assertEqual(len(frames), 41)
        self.assertEqual(result.state_hash, hyperlattice.run(pulled()).state_hash)


class Failing(FolderTest):
    def check_fails(self, scene, cause, words, **options):
        with self.assertRaisesRegex(hyperlattice.FunctionError, words) as caught:
            hyperlattice.run(scene, **options)
        self.assertIsInstance(caught.exception.__cause__, cause)
        self.assertEqual(caught.exception.result.status, "failed")
        self.assertIsInstance(caught.exception, hyperlattice.OutsideError)
        return caught.exception

    def test_exceptions_end_the_run_and_are_chained(self):
        def broken_code(_):
            return {}["key"]

        for scene in (pulled(python_load(broken_code)), pulled(failure=python_failure(broken_code)),
                      pulled(stages=[{"type": "writers.python", "function": broken_code}])):
            for threads in (1, 2):
                error = self.check_fails(scene, KeyError, "broken_code: KeyError: 'key'", threads=threads)
                text = "".join(traceback.format_exception(type(error), error, error.__traceback__))
                self.assertIn("direct cause", text)
                self.assertIn('return {}["key"]', text)

    def test_an_exception_in_the_middle(self):
        def until(state):
            if state.time > 10e-6:
                raise SystemExit("enough")
            return push(state)

        error = self.check_fails(pulled(python_load(until)), SystemExit, "SystemExit: enough")
        self.assertGreater(error.result.summary["steps"], 20)
        simulation = hyperlattice.Simulation(pulled(python_load(until)))
        with self.assertRaises(hyperlattice.FunctionError) as caught:
            simulation.run()
        self.assertIsInstance(caught.exception.__cause__, SystemExit)
        self.assertGreater(simulation.steps, 20)

    def test_wrong_forces(self):
        cases = {
            "shape": (lambda state: np.zeros(3), ValueError, r"forces of the shape \(25, 3\), not \(3,\)"),
            "none": (lambda state: None, ValueError, r"not \(\)"),
            "complex": (lambda state: 1j * state.displacement, TypeError, "real numbers, not of complex128"),
            "text": (lambda state: state.displacement.astype(str), TypeError, "real numbers"),
            "bool": (lambda state: state.displacement > 0, TypeError, "real numbers, not of bool"),
            "nan": (lambda state: state.displacement * np.nan, ValueError, "particle .* expected finite numbers"),
            "infinite": (lambda state: state.displacement + np.inf, ValueError, "expected finite numbers"),
            "ragged": (lambda state: [[1, 2, 3], [1]], ValueError, "."),
        }
        for name, (function, cause, words) in cases.items():
            with self.subTest(name):
                self.check_fails(pulled(python_load(function)), cause, words)

    def test_wrong_answers_about_springs(self):
        cases = {
            "shape": (lambda springs: np.zeros(3, dtype=bool), ValueError, "a boolean for each spring"),
            "scalar": (lambda springs: False, ValueError, "a boolean for each spring"),
            "numbers": (lambda springs: springs.elongation, TypeError, "an array of bool, not of float64"),
        }
        for name, (function, cause, words) in cases.items():
            with self.subTest(name):
                self.check_fails(pulled(failure=python_failure(function)), cause, words)

    def test_faults_of_the_scene(self):
        def faults(scene):
            with self.assertRaises(hyperlattice.SceneError) as caught:
                hyperlattice.plan(scene)
            return {fault.pointer: fault.expected for fault in caught.exception.faults}

        self.assertIn("a Python function that this process has",
                      faults(pulled(python_load("push")))["/pipeline/2/function"])
        self.assertIn("/pipeline/2/function", faults(pulled(python_load(7))))
        self.assertIn("/pipeline/2/stifness", faults(pulled(python_load(push, stifness=1))))
        self.assertIn("/pipeline/1/failure/above",
                      faults(pulled(failure=python_failure(too_long, above=0, above_strain=0))))
        self.assertIn("/pipeline/4/fields/0",
                      faults(pulled(stages=[{"type": "writers.python", "function": print, "fields": ["strss"]}])))
        with self.assertRaisesRegex(TypeError, "cannot hold a function"):
            hyperlattice.plan(pulled({"type": "loads.force", "on": "x_max", "each": push}))

    def test_the_program_says_why_it_cannot_run_it(self):
        result = hyperlattice.run(pulled(python_load(push)), out="first")
        resolved = json.loads((result.folder / "scene.resolved.json").read_text())
        self.assertEqual(resolved["pipeline"][2]["function"], f"{__name__}.push")
        for words in (["run", "first/scene.resolved.json", "--out", "second"], ["plan", "first/scene.resolved.json"]):
            done = subprocess.run([PROGRAM, *words], capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(f'/pipeline/2/function: "{__name__}.push"', done.stderr)
            self.assertIn("runs only in Python", done.stderr)
        self.assertFalse((self.folder / "second").exists())


class Runs(FolderTest):
    def test_a_plan_names_the_functions_and_calls_none(self):
        def never(_):
            raise AssertionError("called")

        scene = pulled(python_load(never), python_failure(never), [{"type": "writers.python", "function": never}])
        plan = hyperlattice.plan(scene)
        self.assertEqual([one["pointer"] for one in plan["python_functions"]],
                         ["/pipeline/1/failure", "/pipeline/2", "/pipeline/4"])
        self.assertIn("slow", str(plan))
        self.assertIn("/pipeline/2 loads.python calls", str(plan))
        self.assertIn("in each step", str(plan))
        self.assertNotIn("python_functions", hyperlattice.plan(pulled()))
        simulation = hyperlattice.Simulation(pulled(python_load(push)))
        self.assertEqual(len(simulation.plan["python_functions"]), 1)
        simulation.close()

    def interrupted(self, load, out, failure=None):
        with hyperlattice.Simulation(pulled(load, failure), out=out) as simulation:
            simulation.step(30)
        self.assertEqual(simulation.result.status, "interrupted")

    def test_resumes(self):
        failure = python_failure(too_long, above=LIMIT)
        expected = hyperlattice.run(pulled(python_load(push), failure)).state_hash
        self.interrupted(python_load(push), "out", failure)
        self.assertEqual(hyperlattice.run(pulled(python_load(push), failure), out="out", resume=True).state_hash,
                         expected)

    def test_refuses_to_resume_with_another_function(self):
        def scaled(factor):
            return lambda state: factor * push(state)

        scale = functools.partial(lambda factor, state: factor * push(state), 2.0)
        self.interrupted(python_load(scaled(2)), "closure")
        self.interrupted(python_load(scale), "partial")
        for out, other in (("closure", scaled(3)), ("closure", scale),
                           ("partial", functools.partial(scale.func, 3.0))):
            for make in (hyperlattice.run, hyperlattice.Simulation):
                with self.assertRaises(hyperlattice.SceneError) as caught:
                    make(pulled(python_load(other)), out=out, resume=True)
                self.assertRegex(str(caught.exception), "/pipeline/2")
        with self.assertRaisesRegex(hyperlattice.SceneError, "/pipeline/2/function: .* another one now"):
            hyperlattice.run(pulled(python_load(scaled(3))), out="closure", resume=True)
        hyperlattice.run(pulled(python_load(scaled(2))), out="closure", resume=True)
        hyperlattice.run(pulled(python_load(scale)), out="partial", resume=True)

    def test_two_loads_with_one_function(self):
        scene = pulled(python_load(push), stages=[{**python_load(push), "on": "x_min"}])
        other = pulled(stages=[{"type": "loads.expression", "on": "x_min", "expression": "1", "each": list(EACH)}])
        self.assertEqual(hyperlattice.run(scene).state_hash, hyperlattice.run(other).state_hash)
        self.assertEqual(len(hyperlattice.plan(scene)["python_functions"]), 2)

    def test_several_runs_at_once(self):
        expected = hyperlattice.run(pulled()).state_hash
        hashes = []
        threads = [threading.Thread(target=lambda: hashes.append(
            hyperlattice.run(pulled(python_load(push)), threads=2).state_hash)) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(hashes, [expected] * 4)

    def test_a_function_may_run_a_scene(self):
        def nested(frame):
            hashes.append(hyperlattice.run(pulled(python_load(push))).state_hash)

        hashes = []
        result = hyperlattice.run(pulled(stages=[{"type": "writers.python", "function": nested, "every": 0}]))
        self.assertEqual(hashes, [result.state_hash] * 2)

    def test_releases_the_functions(self):
        def own(state):
            return push(state)

        alive = weakref.ref(own)
        scene = pulled(python_load(own))
        hyperlattice.run(scene)
        del own, scene
        gc.collect()
        self.assertIsNone(alive())

    def test_objects_and_methods(self):
        class Push:
            def __init__(self, each):
                self.each = each

            def __call__(self, state):
                return np.tile(self.each, (len(state.mass), 1))

            method = __call__

        expected = hyperlattice.run(pulled()).state_hash
        for function in (Push(EACH), Push(EACH).method):
            self.assertEqual(hyperlattice.run(pulled(python_load(function))).state_hash, expected)


if __name__ == "__main__":
    unittest.main()
