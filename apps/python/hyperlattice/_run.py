"""A whole run."""
from __future__ import annotations

import os
import pathlib
import shutil
import tempfile
import weakref
from collections.abc import Mapping
from typing import Any

from . import _core
from ._errors import FunctionError, OutsideError, RunError
from ._functions import Call, check_unchanged, raised_in
from ._result import Result
from ._scenes import Scene, scene_arguments
from ._waiting import Progress, pass_on_log, wait_for, wait_to_the_end

EXIT_DONE, EXIT_RUN, EXIT_OUTSIDE, EXIT_INTERRUPTED = 0, 3, 4, 130


def _remove(folder: pathlib.Path, owner: int) -> None:
    """Removes a temporary folder, unless this is a process that fork() made of its owner."""
    if os.getpid() == owner:
        shutil.rmtree(folder, ignore_errors=True)


class Folder:
    """The folder of a run: the user's, or a temporary one that lives as long as this object."""

    def __init__(self, out: str | os.PathLike[str] | None):
        self.path = pathlib.Path(tempfile.mkdtemp(prefix="hyperlattice_") if out is None else out)
        if out is None:
            weakref.finalize(self, _remove, self.path, os.getpid())

    def result(self) -> Result | None:
        """The results, or None if the run left no summary."""
        if not (self.path / "summary.json").is_file():
            return None
        return Result(self.path, _keep=self)


def conclude(job: Any, folder: Folder, calls: Mapping[str, Call]) -> Result:
    """Returns the results of a run that has ended, or raises what the program would report.

    calls: the Python functions of the scene.
    """
    try:
        code = job.exit_code()
    except Exception as error:
        pass_on_log(job, without=str(error))
        raise
    result = folder.result()
    reason = result.summary.get("reason", "") if result else ""
    pass_on_log(job, without=reason)
    if code in (EXIT_RUN, EXIT_OUTSIDE) and (error := raised_in(calls)) is not None:
        raise FunctionError(reason, result) from error
    if code == EXIT_RUN:
        raise RunError(reason, result)
    if code == EXIT_OUTSIDE or result is None:
        raise OutsideError(reason or "the run left no summary", result)
    return result


def run(scene: Scene, out: str | os.PathLike[str] | None = None, threads: int | None = None, *,
        settings: Mapping[str, Any] | None = None, resume: bool = False, overwrite: bool = False,
        checkpoint_every: float = 600, progress: bool | None = None) -> Result:
    """Runs a scene, as `hyperlattice run` does, with the same bits.

    scene: a dict, whose relative file names count from the current folder, or the name of a scene file.
    out: folder of the results; None: a temporary folder that lives as long as the result.
    threads: number of threads; results do not depend on it. None: as the program chooses.
    settings: values to replace in a scene file, {"/pipeline/1/poisson": 0.1}.
    resume: goes on from the checkpoint in `out`.
    overwrite: gives up an interrupted run in `out`.
    checkpoint_every: most seconds between checkpoints; 0: only when interrupted.
    progress: shows a progress line; None: in a notebook and on a terminal.

    Other threads of Python go on during the run. Ctrl-C stops the run with a checkpoint and raises KeyboardInterrupt.
    Raises SceneError with all faults, RunError if the run failed, OutsideError if something outside failed, and its
    subclass FunctionError if a Python function of the scene failed.
    """
    if resume and overwrite:
        raise ValueError("either resume or overwrite: one keeps the run in the folder, the other gives it up")
    if resume and out is None:
        raise ValueError("resume needs the folder of the run: out")
    arguments = scene_arguments(scene, settings, threads)
    folder = Folder(out)
    if resume:
        check_unchanged(arguments["functions"], folder.path)
    job = _core.Job(**arguments, out=folder.path, resume=resume, overwrite=overwrite,
                    checkpoint_every=checkpoint_every, stays=False)
    line = Progress(job, progress)
    try:
        wait_for(job, line.show)
    except BaseException:  # KeyboardInterrupt, or an exception of another signal handler
        job.stop()
        wait_to_the_end(job)
        pass_on_log(job, without="asked to stop")
        raise
    finally:
        line.close()
    return conclude(job, folder, arguments["functions"])
