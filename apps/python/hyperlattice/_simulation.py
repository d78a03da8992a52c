"""A run that waits after steps, so that Python can look at its state and change it."""
from __future__ import annotations

import atexit
import json
import math
import os
import weakref
from collections.abc import Mapping
from typing import Any, Callable

import numpy as np

from . import _core
from ._errors import OutsideError, RunError
from ._functions import check_unchanged, notes_of
from ._plan import Plan
from ._result import Result
from ._run import Folder, conclude
from ._scenes import Scene, scene_arguments
from ._waiting import pass_on_log, wait_for, wait_to_the_end

_living: weakref.WeakSet[Simulation] = weakref.WeakSet()


class Simulation:
    """A run of a scene, step by step.

        with hyperlattice.Simulation(scene) as simulation:
            while simulation.step(100):
                print(simulation.time, simulation.energy["kinetic"])

    The run is the one of `hyperlattice.run`, with its bits, checks, history, probes and frames. It executes in a thread
    of its own and waits before the first step. After the end its state can still be read.

    scene, out, threads, settings, resume, overwrite, checkpoint_every: as for `run`.
    Raises SceneError with all faults of the scene, and OutsideError if something outside failed.
    """

    def __init__(self, scene: Scene, out: str | os.PathLike[str] | None = None, threads: int | None = None, *,
                 settings: Mapping[str, Any] | None = None, resume: bool = False, overwrite: bool = False,
                 checkpoint_every: float = 600):
        arguments = scene_arguments(scene, settings, threads)
        self._calls = arguments["functions"]
        self._folder = Folder(out)
        if resume:
            check_unchanged(self._calls, self._folder.path)
        self._is_temporary = out is None
        self._callbacks: list[tuple[int, Callable[[Simulation], Any]]] = []
        self._result: Result | None = None
        self._job = _core.Job(**arguments, out=self._folder.path, resume=resume, overwrite=overwrite,
                              checkpoint_every=checkpoint_every, stays=True)
        wait_for(self._job)
        if self._job.has_ended():
            self._conclude()
        pass_on_log(self._job)
        _living.add(self)
        self._process = os.getpid()

    # the course of the run

    def step(self, n: int = 1) -> int:
        """Takes n steps, fewer at the end of the run. Returns the number of steps taken; 0: the run has ended.

        Calls the functions given to every() on the way. An exception in one of them passes through, and the run waits.
        Ctrl-C lets the run wait after its present step and raises KeyboardInterrupt. Raises RunError if the run fails.
        """
        if n < 0 or n != int(n):
            raise ValueError(f"step({n!r}): expected a whole number from 0 on")
        first = self.steps
        self._advance(first + int(n), math.inf)
        return self.steps - first

    def run_until(self, time: float) -> float:
        """Takes steps until the time, s, is reached or passed, or the run ends. Returns the time."""
        self._advance(None, time)
        return self.time

    def run(self) -> Result:
        """Runs to the end and returns the results."""
        self._advance(None, math.inf)
        return self.result

    def _advance(self, last_step: int | None, time: float) -> None:
        while not self.done and (last_step is None or self.steps < last_step) and self.time < time:
            stops = [every - self.steps % every for every, _ in self._callbacks]
            if last_step is not None:
                stops.append(last_step - self.steps)
            before = self.steps
            self._go_on(min(stops, default=None), time)
            if self.steps > before:
                for every, call in list(self._callbacks):
                    if self.steps % every == 0:
                        call(self)

    def _go_on(self, steps: int | None, time: float) -> None:
        wishes = {} if steps is None else {"steps": steps}
        if not self._job.go_on(time=time, **wishes):
            return
        try:
            wait_for(self._job)
        except BaseException:
            self._job.pause()
            wait_to_the_end(self._job)
            pass_on_log(self._job)
            raise
        if self._job.has_ended():
            self._conclude()
        pass_on_log(self._job)

    def _conclude(self) -> None:
        try:
            self._result = conclude(self._job, self._folder, self._calls)
        except (RunError, OutsideError) as error:
            self._result = error.result
            raise

    def every(self, n: int, call: Callable[[Simulation], Any]) -> Callable[[], None]:
        """Calls `call(simulation)` after each n-th step of the run. Returns a function that ends this."""
        if n < 1 or n != int(n):
            raise ValueError(f"every({n!r}, ...): expected a whole number from 1 on")
        entry = (int(n), call)
        self._callbacks.append(entry)
        return lambda: self._callbacks.remove(entry) if entry in self._callbacks else None

    def stop(self) -> Result:
        """Ends the run after its present step, as Ctrl-C ends `run`: with a checkpoint in its folder."""
        if not self.done:
            self._job.stop()
            wait_to_the_end(self._job)
            self._conclude()
        return self.result

    def close(self) -> None:
        """Ends the run. With a folder of the user's it leaves a checkpoint, else nothing. The state can be read yet."""
        if self._job.has_ended() or self._process != os.getpid():
            return
        if self._is_temporary:
            self._job.give_up()
            wait_to_the_end(self._job)
            self._job.take_log()
        else:
            self.stop()

    def __enter__(self) -> Simulation:
        return self

    def __exit__(self, *error: object) -> None:
        self.close()

    # the state

    @property
    def done(self) -> bool:
        """Whether the run has ended."""
        return self._job.has_ended()

    @property
    def result(self) -> Result:
        """The results of the ended run."""
        if self._result is None:
            raise RuntimeError("the run has no results: it has not ended, or it was given up")
        return self._result

    @property
    def plan(self) -> Plan:
        """The plan of the run."""
        text = self._job.plan_text()
        return Plan(json.loads(text), text, notes_of(self._calls))

    @property
    def time(self) -> float:
        """Time of the state, s."""
        return self._job.reached()[1]

    @property
    def steps(self) -> int:
        """Number of steps so far."""
        return self._job.reached()[0]

    @property
    def time_step(self) -> float:
        """Length of the last step, s; 0 before the first one."""
        return self._job.reached()[2]

    @property
    def state_hash(self) -> str:
        """Hash of the state, as in summary.json. Equal hashes mean equal bits."""
        return self._job.state_hash()

    @property
    def energy(self) -> dict[str, float]:
        """Energies of the body, J: kinetic, stored, dissipated, injected, and the error of their balance."""
        return self._job.energy()

    @property
    def broken_springs(self) -> int:
        """Number of springs that have failed."""
        return self._job.broken_springs()

    @property
    def positions(self) -> np.ndarray:
        """Places of the particles at rest, m: a row of each, in the order z, y, x."""
        return self._job.positions()

    @property
    def fields(self) -> list[str]:
        """Names of the fields that this run has."""
        return self._job.fields()

    def field(self, name: str) -> np.ndarray:
        """Returns a field of the present state: all that `writers.vtu` can write, or one component, as "stress_xx".

        The array has a number for each particle, or a row of its components. It is a view of the state without a copy,
        which cannot be written and which changes with each step, for "displacement", "velocity", their components, and
        "height", where the motion is one array in memory (see is_view). Otherwise it is a copy in float64.
        Raises ValueError if the run has no such field.
        """
        view = self._job.field_view(name) if self._may_be_view(name) else None
        return self._job.field_copy(name) if view is None else view

    @staticmethod
    def _may_be_view(name: str) -> bool:
        return name in ("displacement", "velocity", "height") or name[:-2] in ("displacement", "velocity")

    def is_view(self, name: str) -> bool:
        """Whether field(name) is a view: the body is in one block (one thread) whose rows have no gaps between them.

        Rows have no gaps in listed bodies, and in grids whose rows all have a multiple of 8 particles (16 in single
        precision).
        """
        return self._may_be_view(name) and self._job.field_view(name) is not None

    def set_displacement(self, rows: np.ndarray) -> None:
        """Sets the displacements, m, a row of each particle. The energy balance begins anew with the new state.

        Only before the first step and between explicit steps; RuntimeError otherwise.
        """
        self._job.set_motion(False, np.asarray(rows))

    def set_velocity(self, rows: np.ndarray) -> None:
        """Sets the velocities, m/s, half a step before the time. As set_displacement."""
        self._job.set_motion(True, np.asarray(rows))

    def __repr__(self) -> str:
        state = "done" if self.done else "waiting"
        return f"<Simulation {state}: step {self.steps}, t = {self.time:.6g} s>"


@atexit.register
def _close_all() -> None:
    for simulation in list(_living):
        simulation.close()
