"""Simulations step by step: views, changes of the state, callbacks, Ctrl-C."""
import gc
import json
import os
import pickle
import signal
import subprocess
import sys
import textwrap
import unittest

import numpy as np
import hyperlattice
from scenes import FolderTest, bar, free_block


class Steps(FolderTest):
    def test_has_the_bits_of_a_run(self):
        expected = hyperlattice.run(bar())
        for stride in (1, 7, 1000):
            simulation = hyperlattice.Simulation(bar())
            taken = 0
            while (now := simulation.step(stride)) > 0:
                taken += now
            self.assertEqual(taken, expected.summary["steps"])
            self.assertTrue(simulation.done)
            self.assertEqual(simulation.state_hash, expected.state_hash)
            self.assertEqual(simulation.result.state_hash, expected.state_hash)
            self.assertEqual((simulation.result.folder / "history.csv").read_bytes(),
                             (expected.folder / "history.csv").read_bytes())

    def test_times(self):
        simulation = hyperlattice.Simulation(bar())
        self.assertEqual((simulation.time, simulation.steps, simulation.done), (0, 0, False))
        self.assertEqual(simulation.step(10), 10)
        self.assertAlmostEqual(simulation.time, 10 * simulation.time_step, places=20)
        self.assertGreaterEqual(simulation.run_until(10e-6), 10e-6 * (1 - 1e-12))
        self.assertLess(simulation.time, 10e-6 + simulation.time_step)
        self.assertFalse(simulation.done)
        self.assertAlmostEqual(simulation.run_until(1), 20e-6)
        self.assertTrue(simulation.done)

    def test_energy_is_that_of_the_history(self):
        with hyperlattice.Simulation(bar()) as simulation:
            result = simulation.run()
            energy = simulation.energy
        for name in ("kinetic", "stored", "injected"):
            self.assertEqual(energy[name], result.summary["energy"][name])
        self.assertLess(abs(energy["relative_error"]), 1e-3)

    def test_fields_are_those_of_the_frames(self):
        fields = ["displacement", "velocity", "stress", "principal_stress", "strain", "energy_density", "fragment"]
        scene = bar(stages=[{"type": "writers.vtu", "fields": fields, "precision": "double", "every": 0}])
        with hyperlattice.Simulation(scene) as simulation:
            result = simulation.run()
            for name in fields:
                np.testing.assert_array_equal(simulation.field(name), result.field(name))
            np.testing.assert_array_equal(simulation.positions, result.points())
            np.testing.assert_array_equal(simulation.field("stress_xx"), result.field("stress")[:, 0])
            np.testing.assert_array_equal(simulation.field("principal_stress_3"),
                                          result.field("principal_stress")[:, 2])
            self.assertTrue(set(fields) <= set(simulation.fields))
            with self.assertRaisesRegex(ValueError, "did you mean 'stress'"):
                simulation.field("strss")

    def test_two_at_once(self):
        expected = [hyperlattice.run(bar(end=end)).state_hash for end in ("20 us", "15 us")]
        one, other = hyperlattice.Simulation(bar(end="20 us")), hyperlattice.Simulation(bar(end="15 us"))
        while one.step(3) + other.step(2):
            pass
        self.assertEqual([one.state_hash, other.state_hash], expected)

    def test_static_solver(self):
        scene = bar(stages=[])
        scene["pipeline"][2:] = [
            {"type": "loads.fixed", "on": "x_min"},
            {"type": "loads.displacement", "on": "x_max", "value": ["1 um", 0, 0], "rise": "1 s"},
            {"type": "solvers.static", "load_steps": 4}]
        expected = hyperlattice.run(scene).state_hash
        simulation = hyperlattice.Simulation(scene)
        largest = []
        while simulation.step():
            largest.append(simulation.field("displacement_x").max())
            with self.assertRaisesRegex(RuntimeError, "between explicit steps only"):
                simulation.set_velocity(np.zeros((225, 3)))
        np.testing.assert_allclose(largest, [0.25e-6, 0.5e-6, 0.75e-6, 1e-6], rtol=1e-9)
        self.assertEqual(simulation.state_hash, expected)


class Views(FolderTest):
    def test_a_view_is_the_state(self):
        simulation = hyperlattice.Simulation(free_block(), threads=1)
        particles = simulation.plan["particles"]
        rng = np.random.default_rng(1)
        simulation.set_velocity(rng.normal(size=(particles, 3)))
        for name in ("displacement", "velocity", "displacement_x", "displacement_y", "displacement_z", "velocity_z"):
            self.assertTrue(simulation.is_view(name), name)
            view = simulation.field(name)
            address = view.__array_interface__["data"][0]
            self.assertEqual(view.shape, (particles,) if "_" in name else (particles, 3))
            self.assertFalse(view.flags.owndata)
            self.assertFalse(view.flags.writeable)
            self.assertTrue(np.shares_memory(view, simulation.field(name)))
            before = view.copy()
            simulation.step(2)
            self.assertFalse(np.array_equal(view, before))
            self.assertEqual(simulation.field(name).__array_interface__["data"][0], address)
            whole = simulation._job.field_copy(name.split("_")[0])
            np.testing.assert_array_equal(view, whole[:, "xyz".index(name[-1])] if "_" in name else whole)
        self.assertTrue(np.shares_memory(simulation.field("velocity"), simulation.field("velocity_y")))
        self.assertFalse(np.shares_memory(simulation.field("velocity"), simulation.field("displacement")))
        self.assertFalse(simulation.is_view("stress"))

    def test_of_a_list(self):
        points = [(x, y, z) for z in range(5) for y in range(3) for x in range(3)]
        (self.folder / "points.csv").write_text("x,y,z\n" + "".join(f"{x},{y},{z}\n" for x, y, z in points))
        simulation = hyperlattice.Simulation({"format": "hyperlattice/1", "allow_unstable": True, "pipeline": [
            {"type": "lattices.points", "points": "points.csv", "coordination": 5, "scale": "1 mm"},
            {"type": "materials.elastic", "young": "1 GPa", "lambda": 0.1, "density": 1000, "membrane": "I"},
            {"type": "solvers.explicit", "end_time": "20 us"}]})
        velocity = np.random.default_rng(2).normal(size=(45, 3))
        simulation.set_velocity(velocity)
        self.assertTrue(simulation.is_view("velocity"))
        np.testing.assert_array_equal(simulation.field("velocity"), velocity)

    def test_the_height_is_a_view(self):
        simulation = hyperlattice.Simulation(free_block(), threads=1)
        height = simulation.field("height")
        self.assertTrue(np.shares_memory(height, simulation.field("height")))

    def test_single_precision(self):
        scene = free_block(shape={"box": {"low": [0, 0, 0], "high": ["16 mm", "4 mm", "3 mm"]}})
        scene["precision"] = "float"
        simulation = hyperlattice.Simulation(scene, threads=1)
        self.assertEqual(simulation.field("displacement_x").dtype, np.float32)
        self.assertTrue(simulation.is_view("displacement_x"))

    def test_copies_where_the_state_is_not_one_array(self):
        for scene, threads in ((bar(), 1), (free_block(), 2)):
            simulation = hyperlattice.Simulation(scene, threads=threads)
            simulation.step(2)
            self.assertFalse(simulation.is_view("displacement"))
            self.assertFalse(simulation.is_view("displacement_x"))
            field = simulation.field("displacement_x")
            self.assertTrue(field.flags.owndata or field.flags.writeable)
            np.testing.assert_array_equal(field, simulation.field("displacement")[:, 0])

    def test_a_view_outlives_its_simulation(self):
        simulation = hyperlattice.Simulation(free_block(), threads=1)
        simulation.set_velocity(np.ones((simulation.plan["particles"], 3)))
        simulation.step(5)
        view = simulation.field("velocity_y")
        simulation.close()
        del simulation
        gc.collect()
        np.testing.assert_allclose(view, 1, rtol=1e-12)


class Changes(FolderTest):
    def test_a_free_body_flies_on(self):
        """A uniform velocity moves a free body without strain: u = v t."""
        simulation = hyperlattice.Simulation(free_block())
        velocity = np.array([1.0, -2.0, 0.5])
        simulation.set_velocity(np.tile(velocity, (simulation.plan["particles"], 1)))
        simulation.step(20)
        moved = simulation.field("displacement")
        np.testing.assert_allclose(moved, np.broadcast_to(velocity * simulation.time, moved.shape), rtol=1e-9)
        np.testing.assert_allclose(simulation.field("stress"), 0, atol=1)  # of 1e10 Pa
        mass = simulation.field("mass").sum()
        energy = simulation.energy
        self.assertAlmostEqual(energy["kinetic"] / (0.5 * mass * velocity @ velocity), 1, places=9)
        self.assertLess(abs(energy["error"]), 1e-9 * energy["kinetic"])
        self.assertEqual(simulation.run().status, "done")

    def test_a_stretched_body_has_the_energy_of_its_strain(self):
        """A small uniform strain e stores (lame / 2 + mu) e^2 in each volume."""
        scene = free_block(boundary="cells")
        scene["pipeline"][1].update(membrane="none", poisson=0.25)
        simulation = hyperlattice.Simulation(scene)
        strain = 1e-6
        rows = np.zeros_like(simulation.positions)
        rows[:, 0] = strain * simulation.positions[:, 0]
        simulation.set_displacement(rows)
        young, poisson = 10e9, 0.25
        lame, shear = young * poisson / (1 + poisson) / (1 - 2 * poisson), young / 2 / (1 + poisson)
        volume = simulation.field("volume").sum()
        self.assertAlmostEqual(volume, 8e-3 * 4e-3 * 3e-3, places=15)
        self.assertAlmostEqual(simulation.energy["stored"] / ((lame / 2 + shear) * strain**2 * volume), 1, delta=1e-5)
        simulation.run()
        self.assertEqual(simulation.result.status, "done")

    def test_a_force_from_python(self):
        """A constant acceleration g, given step by step. In central differences u = g dt^2 n (n + 1) / 2 exactly."""
        simulation = hyperlattice.Simulation(free_block())
        step = simulation.plan["time_step"]
        gravity = np.array([0, 0, -1000.0])
        for _ in range(25):
            simulation.set_velocity(simulation.field("velocity") + step * gravity)
            simulation.step()
        moved = simulation.field("displacement")
        np.testing.assert_allclose(moved, np.broadcast_to(gravity * step**2 * 25 * 26 / 2, moved.shape), rtol=1e-9)
        self.assertEqual(simulation.run().status, "done")

    def test_wrong_arrays(self):
        simulation = hyperlattice.Simulation(free_block())
        particles = simulation.plan["particles"]
        for rows in (np.zeros((particles, 2)), np.zeros(3 * particles), np.zeros((particles - 1, 3))):
            with self.assertRaisesRegex(ValueError, f"{particles} x 3"):
                simulation.set_velocity(rows)
        with self.assertRaisesRegex(ValueError, "not finite"):
            simulation.set_displacement(np.full((particles, 3), np.nan))
        simulation.run()
        with self.assertRaises(RuntimeError):
            simulation.set_velocity(np.zeros((particles, 3)))


class Callbacks(FolderTest):
    def test_called_after_each_nth_step(self):
        simulation = hyperlattice.Simulation(bar())
        fives, sevens = [], []
        end_fives = simulation.every(5, lambda s: fives.append(s.steps))
        simulation.every(7, lambda s: sevens.append(s.steps))
        simulation.step(23)
        end_fives()
        simulation.step(12)
        self.assertEqual((fives, sevens), ([5, 10, 15, 20], [7, 14, 21, 28, 35]))

    def test_an_exception_passes_through_and_the_run_waits(self):
        expected = hyperlattice.run(bar()).state_hash
        simulation = hyperlattice.Simulation(bar())

        def fail(of):
            raise ZeroDivisionError(f"at step {of.steps}")

        end = simulation.every(10, fail)
        with self.assertRaisesRegex(ZeroDivisionError, "at step 10"):
            simulation.run()
        self.assertEqual((simulation.steps, simulation.done), (10, False))
        end()
        self.assertEqual(simulation.run().state_hash, expected)


class Ends(FolderTest):
    def test_stop_leaves_a_checkpoint(self):
        expected = hyperlattice.run(bar()).state_hash
        simulation = hyperlattice.Simulation(bar(), out="out")
        simulation.step(30)
        result = simulation.stop()
        self.assertEqual((result.status, result.summary["steps"]), ("interrupted", 30))
        resumed = hyperlattice.Simulation(bar(), out="out", resume=True)
        self.assertEqual(resumed.steps, 30)
        self.assertEqual(resumed.run().state_hash, expected)

    def test_closing(self):
        with hyperlattice.Simulation(bar()) as simulation:
            simulation.step(5)
            folder = simulation._folder.path
        self.assertTrue(simulation.done)
        self.assertEqual(simulation.step(3), 0)
        self.assertEqual(len(simulation.field("velocity")), 225)
        del simulation
        gc.collect()
        self.assertFalse(folder.exists())

    def test_closing_leaves_a_checkpoint_in_a_folder_of_the_user(self):
        with hyperlattice.Simulation(bar(), out="out") as simulation:
            simulation.step(5)
        self.assertEqual(hyperlattice.run(bar(), out="out", resume=True).state_hash, hyperlattice.run(bar()).state_hash)

    def test_simulations_that_wait_do_not_hold_the_end_of_python(self):
        script = textwrap.dedent("""
            import hyperlattice
            from scenes import bar
            one, other = hyperlattice.Simulation(bar()), hyperlattice.Simulation(bar())
            one.step(3)
            print(one._folder.path)
            """)
        done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=100, check=True,
                              cwd=os.path.dirname(__file__))
        self.assertEqual(done.stderr, "")
        self.assertFalse(os.path.exists(done.stdout.strip()))


class Processes(FolderTest):
    def test_fork(self):
        """A copy of the process leaves simulations and folders of the original alone, and may run scenes itself."""
        simulation = hyperlattice.Simulation(bar())
        simulation.step(3)
        expected = hyperlattice.run(bar()).state_hash
        child = os.fork()
        if child == 0:
            try:
                del simulation
                gc.collect()
                code = 0 if hyperlattice.run(bar()).state_hash == expected else 1
            except BaseException:
                code = 2
            os._exit(code)
        self.assertEqual(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), 0)
        self.assertEqual(simulation.run().state_hash, expected)

    def test_errors_pass_between_processes(self):
        with self.assertRaises(hyperlattice.SceneError) as caught:
            hyperlattice.plan({"format": "hyperlattice/1"})
        copy = pickle.loads(pickle.dumps(caught.exception))
        self.assertEqual((str(copy), copy.faults), (str(caught.exception), caught.exception.faults))


class Interrupts(FolderTest):
    SCENE = bar(high=("20 mm", "20 mm", "20 mm"), end="50 ms")  # minutes

    def interrupted(self, lines):
        """Runs a script and interrupts it when it says that it is about to run."""
        begin = "import json, sys, threading, time, hyperlattice\nscene = json.loads(sys.argv[1])\n"
        process = subprocess.Popen([sys.executable, "-c", begin + textwrap.dedent(lines), json.dumps(self.SCENE)],
                                   stdout=subprocess.PIPE, text=True)
        try:
            self.assertEqual(process.stdout.readline(), "runs\n")
            process.send_signal(signal.SIGINT)
            return json.loads(process.communicate(timeout=100)[0])
        finally:
            process.kill()

    def test_run(self):
        """The run has begun when its history is there."""
        found = self.interrupted("""
            import pathlib
            def say():
                while not pathlib.Path("out/history.csv").exists():
                    time.sleep(0.01)
                print("runs", flush=True)
            threading.Thread(target=say).start()
            try:
                hyperlattice.run(scene, out="out")
            except KeyboardInterrupt:
                print(json.dumps({"interrupted": True}))
            """)
        self.assertEqual(found, {"interrupted": True})
        summary = json.loads((self.folder / "out/summary.json").read_text())
        self.assertEqual(summary["status"], "interrupted")
        with hyperlattice.Simulation(self.SCENE, out="out", resume=True) as resumed:
            self.assertEqual(resumed.steps, summary["steps"])

    def test_study(self):
        scene = dict(self.SCENE)
        scene["pipeline"] = [*scene["pipeline"], {"type": "probes.point", "position": [0, 0, 0], "component": "x"}]
        self.write({"format": "hyperlattice-study/1", "scene": scene, "repeats": 1,
                    "vary": {"nu": {"/pipeline/1/poisson": [0.1, 0.2]}}, "truth": {"value": 1e-3},
                    "compare": {"end": {"probe": "point", "column": "displacement_x"}}}, "study.json")
        found = self.interrupted("""
            import pathlib
            def say():
                while not list(pathlib.Path("out").rglob("history.csv")):
                    time.sleep(0.01)
                print("runs", flush=True)
            threading.Thread(target=say).start()
            try:
                hyperlattice.study("study.json", out="out")
            except KeyboardInterrupt:
                scene["pipeline"][3]["end_time"] = "1 us"
                print(json.dumps({"then": hyperlattice.run(scene).status}))
            """)
        self.assertEqual(found, {"then": "done"})
        summaries = [json.loads(file.read_text()) for file in self.folder.rglob("summary.json")]
        self.assertEqual([summary["status"] for summary in summaries], ["interrupted"])

    def test_step(self):
        found = self.interrupted("""
            simulation = hyperlattice.Simulation(scene)
            simulation.step(2)
            def say():
                while simulation.steps < 5:
                    time.sleep(0.01)
                print("runs", flush=True)
            threading.Thread(target=say).start()
            try:
                simulation.step(10**9)
            except KeyboardInterrupt:
                steps = simulation.steps
                goes_on = simulation.step(3) == 3 and simulation.steps == steps + 3
                print(json.dumps({"waits": goes_on and not simulation.done}))
            """)
        self.assertEqual(found, {"waits": True})


if __name__ == "__main__":
    unittest.main()
