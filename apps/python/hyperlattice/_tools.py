"""The commands study, analyze and calibrate, which return what the program prints with --json."""
from __future__ import annotations

import json
import os
import pathlib
from collections.abc import Iterable, Mapping
from typing import Any

from . import _core
from ._scenes import as_json, settings_list, thread_number
from ._waiting import pass_on_log, wait_for, wait_to_the_end


def _done(work: Any) -> dict[str, Any]:
    wait_for(work)
    try:
        return json.loads(work.result())
    finally:
        pass_on_log(work)


def study(file: str | os.PathLike[str], out: str | os.PathLike[str] | None = None, threads: int | None = None, *,
          settings: Mapping[str, Any] | None = None, target_error: float | None = None,
          peers: Iterable[str | os.PathLike[str]] = (), fresh: bool = False) -> dict[str, Any]:
    """Runs a study: error against run time of a scene over a grid of settings.

    file: the study file. out: folder of the results, by default <file>_out here; runs in it are not run again unless
    `fresh`. settings: values to replace in the study file. target_error: 0.01 finds the cheapest setting with an error
    of at most 1 %. peers: CSV files of other programs' errors and times.

    Returns the JSON of `hyperlattice study --json`. Ctrl-C stops the present run, and every other run of the process,
    with a checkpoint; the same call goes on from there. Raises SceneError with all faults.
    """
    name = pathlib.Path(os.fspath(file))
    if target_error is not None and not target_error > 0:
        raise ValueError(f"target_error: {target_error!r}: expected a number above 0")
    work = _core.study(file=name, settings=settings_list(settings), out=pathlib.Path(out or f"{name.stem}_out"),
                       target_error=target_error, peers=[pathlib.Path(peer) for peer in peers], fresh=fresh,
                       threads=thread_number(threads))
    try:
        found = _done(work)
    except KeyboardInterrupt:
        _core.request_stop()
        wait_to_the_end(work)
        _core.forget_stop()
        raise
    return found["study"]


def _membrane(membrane: str, poisson, lambda_, k_alpha, k_beta, k_gamma) -> dict[str, Any]:
    return {"membrane": membrane, "poisson": poisson, "lambda": lambda_, "k_beta": k_beta, "k_gamma": k_gamma,
            "k_alpha": None if k_alpha is None else str(k_alpha)}


def _options(options: Mapping[str, Any] | None) -> list[str]:
    return [f"{name}={value if isinstance(value, str) else as_json(value)}" for name, value in (options or {}).items()]


def analyze(membrane: str = "", *, lattice: str = "lattices.cubic", options: Mapping[str, Any] | None = None,
            poisson: float | None = None, lambda_: float | None = None, k_alpha: float | str | None = None,
            k_beta: float | None = None, k_gamma: float | None = None,
            crystals: str | os.PathLike[str] | None = None) -> dict[str, Any]:
    """Analyses an infinite lattice: elasticity, stability over the Brillouin zone, critical time step.

    membrane: "none", "I", "II", "III", "IV", "I-m" or "free" with k_alpha (a number or "infinite"), k_beta, k_gamma.
    options: options of the lattice component, {"coordination": 13.2}.
    crystals: a CSV file of cubic crystals; finds the lattices with their elastic constants.
    Returns the JSON of `hyperlattice analyze --json`. Raises SceneError with all faults.
    """
    if not membrane and crystals is None:
        raise TypeError("analyze needs a membrane or a file of crystals")
    return _done(_core.analyze(
        membrane=_membrane(membrane, poisson, lambda_, k_alpha, k_beta, k_gamma), lattice=lattice,
        options=_options(options),
        crystals="" if crystals is None else os.fspath(crystals)))


def calibrate(membrane: str, *, lattice: str = "lattices.cubic", options: Mapping[str, Any] | None = None,
              young: float | None = None, poisson: float | None = None, lambda_: float | None = None,
              k_alpha: float | str | None = None, k_beta: float | None = None, k_gamma: float | None = None,
              spacing: float | None = None, parameters: str = "closed_form", measure: int | None = None,
              strain: float | None = None, curve: tuple[float, float, int] | None = None,
              each: tuple[str, Iterable[Any]] | None = None, threads: int | None = None) -> dict[str, Any]:
    """Computes the springs that have Young's modulus (Pa) and Poisson's ratio, or these from the springs.

    parameters: "closed_form" or "paper". measure: also measures them on a cube of N^3 particles, with `strain`.
    curve: (first, last, points) of many lambda in place of one. each: ("coordination", [8.4, 13.2]), a curve for each
    value of an option of the lattice.
    Returns the JSON of `hyperlattice calibrate --json`. Raises SceneError with all faults, which have the names of the
    program's arguments.
    """
    family = "" if each is None else f"{each[0]}={','.join(map(str, each[1]))}"
    return _done(_core.calibrate(
        membrane=_membrane(membrane, poisson, lambda_, k_alpha, k_beta, k_gamma), lattice=lattice,
        options=_options(options),
        young=young, spacing=spacing, parameters=parameters, measure=measure, strain=strain, curve=curve, each=family,
        threads=thread_number(threads)))
