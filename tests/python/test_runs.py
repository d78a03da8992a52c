"""plan and run give what the program gives: the same bits, the same tables, the same frames."""
import io
import json
import logging
import pathlib
import sys
import threading
import time
import types
import unittest
import unittest.mock

import numpy as np
import hyperlattice
from hyperlattice import _waiting
from scenes import FolderTest, bar

PROBE = {"type": "probes.point", "name": "middle", "position": ["4 mm", "2 mm", "2 mm"], "field": "displacement"}
FRAMES = {"type": "writers.vtu", "every": "5 us", "fields": ["displacement", "stress", "material"]}


class Runs(FolderTest):
    def test_has_the_bits_of_the_program(self):
        scene = bar(stages=[PROBE])
        file = self.write(scene)
        self.program("run", file, "--out", "program", "--quiet")
        expected = json.loads((self.folder / "program/summary.json").read_text())
        for source in (scene, file, str(file)):
            result = hyperlattice.run(source)
            self.assertEqual(result.state_hash, expected["state_hash"])
            self.assertEqual(result.summary["state_hash"], expected["state_hash"])
            self.assertEqual(result.status, "done")
            for table in ("history.csv", "probes/middle.csv"):
                self.assertEqual((result.folder / table).read_bytes(), (self.folder / "program" / table).read_bytes())

    def test_threads_do_not_change_the_bits(self):
        hashes = {hyperlattice.run(bar(), threads=threads).state_hash for threads in (1, 2, 3)}
        self.assertEqual(len(hashes), 1)

    def test_settings_are_those_of_the_program(self):
        file = self.write(bar())
        self.program("run", file, "--out", "program", "--quiet", "--set", "/pipeline/1/poisson=0.1")
        result = hyperlattice.run(file, settings={"/pipeline/1/poisson": 0.1})
        expected = json.loads((self.folder / "program/summary.json").read_text())
        self.assertEqual(result.state_hash, expected["state_hash"])
        self.assertNotEqual(result.state_hash, hyperlattice.run(file).state_hash)

    def test_files_are_relative_to_the_scene_or_to_the_current_folder(self):
        data = self.folder / "data"
        data.mkdir()
        points = [(x, y, z) for z in range(4) for y in range(4) for x in range(4)]
        (data / "points.csv").write_text("x,y,z\n" + "".join(f"{x},{y},{z}\n" for x, y, z in points))
        scene = {"format": "hyperlattice/1", "pipeline": [
            {"type": "lattices.points", "points": "points.csv", "coordination": 5, "scale": "1 mm"},
            {"type": "materials.elastic", "young": "1 GPa", "lambda": 0.1, "density": 1000, "membrane": "I"},
            {"type": "solvers.explicit", "end_time": "1 us"}]}
        scene["allow_unstable"] = True
        self.write(scene, "data/scene.json")
        self.assertEqual(hyperlattice.plan("data/scene.json")["particles"], 64)
        with self.assertRaises(hyperlattice.SceneError) as caught:
            hyperlattice.plan(scene)
        self.assertIn("/pipeline/0/points", [fault.pointer for fault in caught.exception.faults])
        scene["pipeline"][0]["points"] = pathlib.Path("data") / "points.csv"
        self.assertEqual(hyperlattice.plan(scene)["particles"], 64)

    def test_dicts_may_hold_numbers_of_numpy(self):
        scene = bar()
        scene["pipeline"][0]["shape"]["box"]["high"] = np.array([8e-3, 4e-3, 4e-3])
        scene["pipeline"][1]["poisson"] = np.float64(0.2)
        self.assertEqual(hyperlattice.run(scene).state_hash, hyperlattice.run(bar()).state_hash)

    def test_plan_has_the_keys_of_the_program(self):
        file = self.write(bar(stages=[FRAMES]))
        expected = json.loads(self.program("plan", file, "--json"))
        plan = hyperlattice.plan(file)
        self.assertEqual(set(plan), set(expected))
        for key in ("particles", "springs", "steps", "time_step", "critical_time_step", "left_out"):
            self.assertEqual(plan[key], expected[key])
        self.assertIn("Loaded", str(plan))
        self.assertEqual(list(self.folder.iterdir()), [file])

    def test_a_temporary_folder_lives_as_long_as_the_result(self):
        result = hyperlattice.run(bar())
        folder = result.folder
        self.assertTrue((folder / "history.csv").is_file())
        del result
        self.assertFalse(folder.exists())

    def test_tables(self):
        failure = {"type": "failures.elongation", "limit": "1 um"}
        result = hyperlattice.run(bar(stages=[PROBE], material={"failure": failure}))
        self.assertEqual(result.tables, ["failures", "history", "middle"])
        history, failures = result.table("history"), result.table("failures")
        self.assertEqual(len(np.asarray(failures["step"])), sum(result.summary["broken_springs"].values()))
        self.assertAlmostEqual(np.asarray(history["time"])[-1], 20e-6)
        self.assertEqual(np.asarray(history["step"]).dtype, np.int64)
        with self.assertRaisesRegex(KeyError, "history, middle"):
            result.table("missing")

    def test_tables_with_and_without_pandas(self):
        """pandas may be installed here or not, so that a stand-in takes its place."""
        result = hyperlattice.run(bar())
        with unittest.mock.patch.dict(sys.modules, pandas=None):  # its import fails
            columns = result.table("history")
            self.assertIsInstance(columns, dict)
        stand_in = types.ModuleType("pandas")
        stand_in.DataFrame = lambda data: ("frame", data)
        with unittest.mock.patch.dict(sys.modules, pandas=stand_in):
            kind, data = result.table("history")
        self.assertEqual(kind, "frame")
        self.assertEqual(list(data), list(columns))
        for name, column in columns.items():
            np.testing.assert_array_equal(data[name], column)

    def test_a_second_run_in_a_folder_in_use_is_refused(self):
        with hyperlattice.Simulation(bar(), out="out") as first:
            first.step(3)
            with self.assertRaises((hyperlattice.OutsideError, hyperlattice.SceneError)):
                hyperlattice.run(bar(), out="out")
            self.assertEqual(first.run().status, "done")

    def test_other_threads_go_on_during_a_run(self):
        counts = []
        stop = threading.Event()

        def count():
            while not stop.is_set():
                counts.append(time.monotonic())
                time.sleep(0.001)

        thread = threading.Thread(target=count)
        thread.start()
        begin = time.monotonic()
        hyperlattice.run(bar(high=("40 mm", "20 mm", "20 mm"), end="200 us"), threads=1)
        end = time.monotonic()
        stop.set()
        thread.join()
        self.assertGreater(sum(begin < at < end for at in counts), 1)

    def test_log(self):
        with self.assertLogs("hyperlattice", logging.INFO) as log:
            hyperlattice.run(bar(), out="out")
        self.assertTrue(any("results in out" in line for line in log.output), log.output)

    def test_progress(self):
        class Job:
            now = (0, 0.0, 0.0, 0)

            def reached(self):
                return self.now

        with unittest.mock.patch.multiple(_waiting.Progress, PATIENCE=0, PAUSE=0), \
                unittest.mock.patch("sys.stderr", new_callable=io.StringIO) as shown:
            job = Job()
            line = _waiting.Progress(job, True)
            line.show()
            job.now = (50, 1e-6, 2e-8, 200)
            line.start -= 20
            line.show()
            line.close()
            _waiting.Progress(job, False).show()
            hyperlattice.run(bar())  # standard error is no terminal
        planning, steps = shown.getvalue().splitlines()
        self.assertEqual(planning, "planning the body")
        self.assertEqual(steps, "step 50/200 (25.0%)  t 1e-06 s  dt 2e-08 s  ETA 1:00")

    def test_progress_in_a_notebook(self):
        """A stand-in for IPython sees one display that is updated."""
        shown = []
        handle = types.SimpleNamespace(update=lambda data, raw: shown.append(("update", data, raw)))
        ipython, display = types.ModuleType("IPython"), types.ModuleType("IPython.display")

        def show(data, raw, display_id):
            shown.append(("display", data, raw))
            self.assertTrue(display_id)
            return handle

        display.display = show
        modules = {"ipykernel": types.ModuleType("ipykernel"), "IPython": ipython, "IPython.display": display}
        with unittest.mock.patch.dict(sys.modules, modules), \
                unittest.mock.patch.multiple(_waiting.Progress, PATIENCE=0, PAUSE=0):
            line = _waiting.Progress(types.SimpleNamespace(reached=lambda: (0, 0.0, 0.0, 0)), None)
            line.show()
            line.show()
            line.close()
        text = {"text/plain": "planning the body"}
        self.assertEqual(shown, [("display", text, True), ("update", text, True)])

    def test_html(self):
        scene = bar(stages=[PROBE])
        scene["title"] = "A <b>bar</b>"
        for page in (hyperlattice.plan(scene)._repr_html_(), hyperlattice.run(scene)._repr_html_()):
            self.assertIn("A &lt;b&gt;bar&lt;/b&gt;", page)
            self.assertNotIn("<b>bar", page)


class Frames(FolderTest):
    """The reader of frames agrees with VTK's own."""

    def test_agrees_with_vtk(self):
        import vtk
        from vtk.util.numpy_support import vtk_to_numpy
        for codec in ("lz4", "zlib", "none"):
            for precision, dtype in (("single", np.float32), ("double", np.float64)):
                scene = bar(stages=[{**FRAMES, "codec": codec, "precision": precision, "deformed": True}])
                result = hyperlattice.run(scene, out=f"{codec}_{precision}")
                np.testing.assert_allclose(result.times(), [0, 5e-6, 10e-6, 15e-6, 20e-6], rtol=1e-12)
                self.assertEqual(result.fields(), FRAMES["fields"])
                files = sorted(result.folder.rglob("*.vtu"))
                self.assertEqual(len(files), 5)
                for number in (0, 3):
                    reader = vtk.vtkXMLUnstructuredGridReader()
                    reader.SetFileName(str(files[number]))
                    reader.Update()
                    grid = reader.GetOutput()
                    np.testing.assert_array_equal(result.points(number), vtk_to_numpy(grid.GetPoints().GetData()))
                    for name in FRAMES["fields"]:
                        field = result.field(name, number)
                        self.assertEqual(field.dtype, dtype)
                        np.testing.assert_array_equal(field, vtk_to_numpy(grid.GetPointData().GetArray(name)))

    def test_blocks(self):
        """Arrays of more than one block, the last of which is shorter."""
        frames = {**FRAMES, "precision": "double", "every": 0}
        scene = bar(high=("60 mm", "20 mm", "20 mm"), end="1 us", stages=[frames])
        simulation = hyperlattice.Simulation(scene)
        result = simulation.run()
        self.assertGreater(3 * 8 * result.summary["particles"], 1 << 19)
        np.testing.assert_array_equal(result.field("displacement"), simulation.field("displacement"))

    def test_faults(self):
        result = hyperlattice.run(bar(stages=[FRAMES]))
        with self.assertRaisesRegex(IndexError, "has 5 frames"):
            result.field("stress", 5)
        with self.assertRaisesRegex(KeyError, "it has displacement, stress, material"):
            result.field("velocity")
        with self.assertRaisesRegex(KeyError, "writers.vtu"):
            hyperlattice.run(bar()).field("stress")


if __name__ == "__main__":
    unittest.main()
