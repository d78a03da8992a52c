"""Faults of scenes, failed runs, failing plugins; memory over many runs."""
import ctypes
import gc
import json
import os
import subprocess
import unittest

import hyperlattice
from scenes import BUILD, PROGRAM, FolderTest, bar


def wrong():
    scene = bar()
    scene["pipeline"][0]["type"] = "lattices.cubik"
    scene["pipeline"][1]["young"] = "10 kg"
    scene["pipeline"][3]["end_tme"] = scene["pipeline"][3].pop("end_time")
    return scene


class Faults(FolderTest):
    def test_all_faults_at_once_as_the_program_prints_them(self):
        file = self.write(wrong())
        printed = subprocess.run([PROGRAM, "plan", file], capture_output=True, text=True, check=False)
        self.assertEqual(printed.returncode, 2)
        for call in (hyperlattice.plan, hyperlattice.run, hyperlattice.Simulation):
            for source in (wrong(), file):
                with self.assertRaises(hyperlattice.SceneError) as caught:
                    call(source)
                error = caught.exception
                self.assertIsInstance(error, ValueError)
                self.assertIn(str(error), printed.stderr)
                self.assertEqual("\n".join(fault.message for fault in error.faults), str(error))
                pointers = [fault.pointer for fault in error.faults]
                expected = {"/pipeline/0/type", "/pipeline/1/young", "/pipeline/3/end_tme"}
                self.assertTrue(expected <= set(pointers), pointers)
                kind = error.faults[pointers.index("/pipeline/0/type")]
                self.assertEqual(kind.value, '"lattices.cubik"')
                self.assertIn("lattices.cubic", kind.expected)
        self.assertEqual(list(self.folder.iterdir()), [file])

    def test_other_arguments(self):
        with self.assertRaises(hyperlattice.SceneError):
            hyperlattice.plan("missing.json")
        for threads in (0, 5000, 1.5, True):
            with self.assertRaisesRegex(ValueError, "threads"):
                hyperlattice.run(bar(), threads=threads)
        with self.assertRaisesRegex(TypeError, "dict or the name of a file"):
            hyperlattice.run(7)
        with self.assertRaisesRegex(TypeError, "settings"):
            hyperlattice.run(bar(), settings={"/title": "x"})
        with self.assertRaisesRegex(ValueError, "resume"):
            hyperlattice.run(bar(), resume=True)
        with self.assertRaises(hyperlattice.SceneError):
            hyperlattice.run(bar(), out="missing", resume=True)

    def test_a_failed_run_has_its_results(self):
        scene = bar()
        scene["pipeline"][2] = {"type": "loads.velocity", "on": "x_max", "value": ["9000 m/s", 0, 0], "rise": "1 us"}
        with self.assertRaises(hyperlattice.RunError) as caught:
            hyperlattice.run(scene)
        result = caught.exception.result
        self.assertEqual((result.status, result.summary["exit_code"]), ("failed", 3))
        self.assertEqual(result.summary["reason"], str(caught.exception))
        self.assertIn("history", result.tables)
        simulation = hyperlattice.Simulation(scene)
        with self.assertRaises(hyperlattice.RunError):
            simulation.run()
        self.assertTrue(simulation.done)
        self.assertEqual(simulation.state_hash, result.state_hash)
        self.assertEqual(simulation.result.status, "failed")

    def test_a_place_that_cannot_be_written(self):
        with self.assertRaises(hyperlattice.OutsideError) as caught:
            hyperlattice.run(bar(), out="/proc/hyperlattice")
        self.assertIsInstance(caught.exception, OSError)


class Plugins(FolderTest):
    def setUp(self):
        super().setUp()
        self.addCleanup(os.environ.pop, "HYPERLATTICE_TEST_FAULT", None)

    def scene(self):
        scene = bar()
        scene["plugins"] = [str(BUILD / "tests/bad_plugins/misbehaving")]
        scene["pipeline"].insert(2, {"type": "loads.misbehaving", "on": "x_min"})
        return scene

    def test_a_plugin_that_throws(self):
        os.environ["HYPERLATTICE_TEST_FAULT"] = "throw"
        for call in (hyperlattice.run, lambda scene: hyperlattice.Simulation(scene).run()):
            with self.assertRaisesRegex(hyperlattice.OutsideError, r"loads\.misbehaving \(.*\) failed in "):
                call(self.scene())
        self.assertEqual(hyperlattice.run(bar()).status, "done")  # the process is as before

    def test_a_library_that_is_refused(self):
        scene = bar()
        scene["plugins"] = [str(BUILD / "tests/bad_plugins")]
        scene["pipeline"][1]["failure"] = {"type": "failures.old_interface", "limit": 1}
        with self.assertRaises((hyperlattice.OutsideError, hyperlattice.SceneError)) as caught:
            hyperlattice.plan(scene)
        self.assertIn("old_interface", str(caught.exception))


class Tools(FolderTest):
    def json_of(self, *words):
        return json.loads(self.program(*words, "--json"))

    def test_analyze(self):
        self.assertEqual(hyperlattice.analyze("I-m", poisson=0.1),
                         self.json_of("analyze", "--membrane", "I-m", "--poisson", 0.1))
        self.assertEqual(hyperlattice.analyze("free", k_alpha="infinite", k_beta=0.1, k_gamma=0.2),
                         self.json_of("analyze", "--membrane", "free", "--k_alpha", "infinite", "--k_beta", 0.1,
                                      "--k_gamma", 0.2))
        (self.folder / "crystals.csv").write_text("name,C11_GPa,C12_GPa,C44_GPa\nAl,107.3,60.9,28.3\n")
        self.assertEqual(hyperlattice.analyze(crystals="crystals.csv"),
                         self.json_of("analyze", "--crystals", "crystals.csv"))
        with self.assertRaises(TypeError):
            hyperlattice.analyze()
        with self.assertRaises(hyperlattice.SceneError) as caught:
            hyperlattice.analyze("I-q", poisson=0.1)
        self.assertIn("I-m", caught.exception.faults[0].expected)

    def test_calibrate(self):
        self.assertEqual(hyperlattice.calibrate("I-m", young=10e9, poisson=0.1),
                         self.json_of("calibrate", "--membrane", "I-m", "--young", "10e9", "--poisson", 0.1))
        measured = hyperlattice.calibrate("I", lambda_=1, measure=5)["measured"]
        expected = self.json_of("calibrate", "--membrane", "I", "--lambda", 1, "--measure", 5)["measured"]
        for key in ("poisson", "modulus_ratio"):
            self.assertEqual(measured[key], expected[key])
        with self.assertRaises(hyperlattice.SceneError) as caught:
            hyperlattice.calibrate("I", lambda_=1, strain=0.2)
        self.assertEqual([fault.pointer for fault in caught.exception.faults], ["--strain", "--strain"])

    def test_curves(self):
        self.assertEqual(hyperlattice.calibrate("I", curve=(0, 4, 5)),
                         self.json_of("calibrate", "--membrane", "I", "--curve", 0, 4, 5))
        family = hyperlattice.calibrate("I", lattice="lattices.random", curve=(0, 2, 4),
                                        each=("coordination", [8.4, 13.2]))
        self.assertEqual(family, self.json_of("calibrate", "--membrane", "I", "--lattice", "lattices.random",
                                              "--curve", 0, 2, 4, "--each", "coordination=8.4,13.2"))

    def test_study(self):
        """A particle on a spring swings with the frequency of docs/guide/studies.md."""
        scene = {"format": "hyperlattice/1", "pipeline": [
            {"type": "lattices.cubic", "spacing": "1 mm",
             "shape": {"box": {"low": [0, 0, 0], "high": ["1 mm", "1 mm", "2 mm"]}}},
            {"type": "materials.elastic", "young": "10 GPa", "poisson": 0.25, "density": 2500},
            {"type": "loads.fixed", "on": "z_min"},
            {"type": "loads.start_velocity", "on": "z_max", "linear": [0, 0, "1 mm/s"]},
            {"type": "solvers.explicit", "end_time": "2 us"},
            {"type": "probes.point", "position": [0, 0, "2 mm"], "component": "z", "every": 0}]}
        self.write({"format": "hyperlattice-study/1", "scene": scene, "refine": "step", "repeats": 1,
                    "vary": {"step": {"/pipeline/4/time_step": ["0.2 us", "0.1 us"]}},
                    "truth": {"value": 4.54038063e-10},
                    "compare": {"end": {"probe": "point", "column": "displacement_z"}}}, "study.json")
        found = hyperlattice.study("study.json", target_error=0.01)
        self.assertEqual(len(found["rows"]), 2)
        self.assertEqual(json.loads((self.folder / "study_out/study.json").read_text())["rows"], found["rows"])
        again = hyperlattice.study("study.json")
        self.assertEqual([row["error"] for row in again["rows"]], [row["error"] for row in found["rows"]])


class Memory(FolderTest):
    def test_many_runs_take_no_more_memory(self):
        def resident():
            gc.collect()
            ctypes.CDLL(None).malloc_trim(0)
            with open("/proc/self/statm", encoding="ascii") as file:
                return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")

        scene = bar(end="1 us")

        def runs(count):
            for _ in range(count):
                hyperlattice.run(scene)
                with hyperlattice.Simulation(scene) as simulation:
                    simulation.step()
                    simulation.field("displacement_x")
                    simulation.field("stress")
                try:
                    hyperlattice.plan(wrong())
                except hyperlattice.SceneError:
                    pass

        runs(20)
        before = resident()
        runs(80)
        self.assertLess(resident() - before, 80 * 4000)  # components registered anew would take 8 kB for each scene


if __name__ == "__main__":
    unittest.main()
