"""Compares runs on several ranks with a run in one process: same_bits.py PROGRAM CASE.

All files must have the same bytes, except for times, and for the number of ranks in summary.json.
"""
import copy
import json
import os
import sys
import tempfile

import launch

LATTICE, MATERIAL = 0, 1
BLOCK = {
    "format": "hyperlattice/1",
    "pipeline": [
        {"type": "lattices.cubic", "spacing": 1e-3, "shape": {"box": {"low": [0, 0, 0], "high": [0.006, 0.007, 0.014]}}},
        {"type": "materials.elastic", "young": "10 GPa", "poisson": 0.1, "density": 2500, "membrane": "I-m",
         "failure": {"type": "failures.elongation", "limit": "5e-4 mm"}},
        {"type": "loads.fixed", "on": "z_min"},
        {"type": "loads.velocity", "on": "z_max", "value": [0.2, 0, 1], "rise": "2 us"},
        {"type": "solvers.explicit", "end_time": "40 us"},
        {"type": "writers.vtu", "every": "20 us"},
        {"type": "probes.point", "name": "top", "position": [0.003, 0.003, 0.012], "every": "5 us"},
        {"type": "probes.reaction", "on": "z_min", "every": "10 us"},
    ],
}
SOFT = {"type": "materials.elastic", "young": "10 GPa", "poisson": 0.25, "density": 2500, "membrane": "none"}

COHESIVE = {"type": "failures.cohesive", "strength": "2.5 MPa", "fracture_energy": "1.2 J/m2", "allow_coarse": True,
            "intact_near_supports": False}


def breaking(scene):
    """The block as it is."""


def intact(scene):
    del scene["pipeline"][MATERIAL]["failure"]


def floats(scene):
    scene["precision"] = "float"


def three_dimensions(scene):
    scene["pipeline"][MATERIAL] = {**SOFT, "failure": {"type": "failures.elongation", "limit": "5e-4 mm"}}


def partial_cells(scene):
    """Springs of mixtures, a body whose rows have gaps, and a volumetric energy."""
    scene["pipeline"][LATTICE].update(boundary="partial_cells", shape={
        "hollow_sphere": {"inner_radius": "2.3 mm", "outer_radius": "6.2 mm"}})
    scene["pipeline"][MATERIAL] = {**SOFT, "poisson": 0.4}
    scene["pipeline"][2:4] = [{"type": "loads.blast", "on": "inner_surface", "peak": "20 MPa", "rise": "5 us", "fall": "15 us"}]
    scene["pipeline"][-2:] = [{"type": "probes.point", "position": [0.005, 0, 0], "every": "5 us"}]


def volumetric_breaking(scene):
    scene["pipeline"][MATERIAL] = {**SOFT, "poisson": 0.4, "failure": {"type": "failures.elongation", "limit": "5e-4 mm"}}


def plastic(scene):
    scene["pipeline"][MATERIAL] = {"type": "materials.plastic", "young": "10 GPa", "density": 2500, "membrane": "none",
                                   "yield": "5 MPa"}


def softening(scene):
    scene["pipeline"][MATERIAL] = {"type": "materials.softening", "young": "10 GPa", "density": 2500, "membrane": "none",
                                   "strength": "6 MPa", "fracture_energy": "8 J/m2"}


def rates(scene):
    """A criterion that asks for rates, and one with a memory."""
    scene["pipeline"][MATERIAL]["failure"] = [
        {"type": "failures.rate", "limit": 1e-3, "reference": "1e5 1/s"},
        {"type": "failures.tuler_butcher", "threshold": 5e-4, "impulse": 1e-11}]


def two_laws(scene):
    scene["regions"] = {"upper": {"box": {"low": [0, 0, 0.0065], "high": [1, 1, 1]}}}
    scene["pipeline"][MATERIAL] = SOFT
    scene["pipeline"].insert(2, {"type": "materials.plastic", "young": "20 GPa", "density": 2500, "membrane": "none",
                                 "yield": "5 MPa", "region": "upper"})


def bcc(scene):
    scene["pipeline"][LATTICE]["type"] = "lattices.bcc"
    scene["pipeline"][MATERIAL] = {**SOFT, "failure": {"type": "failures.elongation", "limit": "5e-4 mm"}}


def random_lattice(scene):
    scene["pipeline"][LATTICE]["type"] = "lattices.random"
    scene["pipeline"][MATERIAL]["membrane"] = "I"


def random_softening(scene):
    """Laws with memory and a load that watches the body, on a list."""
    softening(scene)
    scene["pipeline"][LATTICE]["type"] = "lattices.random"
    scene["pipeline"].insert(3, {"type": "loads.contact"})


def random_rates(scene):
    rates(scene)
    scene["pipeline"][LATTICE]["type"] = "lattices.random"


def random_volumes(scene):
    three_dimensions(scene)
    scene["pipeline"][LATTICE]["type"] = "lattices.random"
    scene["pipeline"][MATERIAL]["poisson"] = 0.4


def contact(scene):
    """Pieces meet again: a load that watches the body."""
    scene["pipeline"][MATERIAL]["failure"]["limit"] = "2e-4 mm"
    scene["pipeline"][2:4] = [{"type": "loads.start_velocity", "on": "z_max", "linear": [0, 0, -20]},
                              {"type": "loads.gravity", "acceleration": [0, 0, -9.81]}, {"type": "loads.contact"},
                              {"type": "loads.floor", "point": [0, 0, -0.0002], "normal": [0, 0, 1], "stiffness": "1 MN/m"}]
    scene["pipeline"] = [stage for stage in scene["pipeline"] if stage["type"] != "probes.reaction"]


def cohesive(scene):
    scene["pipeline"][LATTICE]["boundary"] = "cells"
    scene["pipeline"][MATERIAL]["failure"] = {**COHESIVE}


def cohesive_cells(scene):
    """Damage in cells with a volumetric energy, and a criterion that breaks springs beside it."""
    scene["pipeline"][MATERIAL] = {**SOFT, "poisson": 0.35, "failure": [
        COHESIVE,
        {"type": "failures.elongation", "limit": "8e-4 mm"}]}


def crushed(scene):
    """Damage that grows under pressure, in floats, with its fields in the frames and forces through a crack."""
    cohesive(scene)
    scene["precision"] = "float"
    scene["pipeline"][MATERIAL]["failure"].update(compressive_strength="10 MPa", friction_angle="30 degrees")
    scene["pipeline"][3]["value"] = [0, 0, -3]
    scene["pipeline"] += [{"type": "writers.cracks", "every": "20 us"},
                          {"type": "probes.section", "point": [0, 0, 0.0071], "normal": [0, 0, 1], "every": "5 us"}]
    scene["pipeline"][5]["fields"] = ["damage", "crack_opening", "crack_time", "stress"]


def cohesive_implicit(scene):
    """Damage in explicit steps, in implicit ones, and in explicit ones again."""
    cohesive(scene)
    scene["pipeline"][MATERIAL]["failure"]["fracture_energy"] = "20 J/m2"
    first = scene["pipeline"][4]
    scene["pipeline"][4:5] = [{**first, "end_time": "4 us"}, {"type": "solvers.implicit", "end_time": "6 us", "time_step": "0.5 us"},
                              {**first, "end_time": "30 us"}]


def local_steps(scene):
    scene["regions"] = {"stiff": {"box": {"low": [0, 0, 0.006], "high": [1, 1, 0.008]}}}
    scene["pipeline"][MATERIAL] = SOFT
    scene["pipeline"].insert(2, {**SOFT, "young": "1 TPa", "region": "stiff"})
    for stage in scene["pipeline"]:
        if stage["type"] == "solvers.explicit":
            stage["local_steps"] = 8


def added_mass(scene):
    """Two stages, of which the second adds mass to stiff particles."""
    local_steps(scene)
    scene["pipeline"][MATERIAL]["failure"] = {"type": "failures.rate", "limit": 1e-3, "reference": "1e5 1/s"}
    first = next(stage for stage in scene["pipeline"] if stage["type"] == "solvers.explicit")
    del first["local_steps"]
    second = {**first, "end_time": "80 us", "mass_scaling": "0.2 us"}
    scene["pipeline"].insert(scene["pipeline"].index(first) + 1, second)


def rest_then_motion(scene):
    """A state of rest by Newton's method, implicit steps, then explicit ones."""
    del scene["pipeline"][MATERIAL]["failure"]
    scene["pipeline"][3:5] = [
        {"type": "loads.force", "on": "z_max", "total": [5, 0, 200], "rise": "10 us"}, {"type": "solvers.static"},
        {"type": "solvers.implicit", "end_time": "20 us", "time_step": "2 us"},
        {"type": "solvers.explicit", "end_time": "30 us", "damping": 0.1}]


def relaxation(scene):
    del scene["pipeline"][MATERIAL]["failure"]
    scene["pipeline"][3:5] = [{"type": "loads.force", "on": "z_max", "total": [5, 0, 200]},
                              {"type": "solvers.relaxation", "tolerance": 1e-4}]


def pictures(scene):
    """Pictures of a body that breaks, with its cracks and broken springs."""
    scene["pipeline"].append({"type": "writers.render", "every": "20 us", "cracks": True, "springs": True, "opacity": 0.5,
                              "clip": [0.003, 0, 0, 1, 0, 0], "colour_by": "von_mises", "width": 160, "height": 120})


def shown_motion(scene):
    """Outputs to which the first rank shows fields that it has of the other ranks, without their state."""
    scene["pipeline"][-1:] = [{"type": "probes.gauge", "from": "z_min", "to": "z_max", "every": "10 us"}]
    scene["pipeline"][-3] = {"type": "writers.csv", "every": "20 us",
                             "fields": ["height", "velocity", "displacement", "material"]}


CASES = [breaking, intact, floats, three_dimensions, partial_cells, volumetric_breaking, plastic, softening, rates, two_laws,
         bcc, random_lattice, random_softening, random_rates, random_volumes, contact, cohesive, cohesive_cells, crushed,
         cohesive_implicit, local_steps, added_mass, rest_then_motion, relaxation, pictures, shown_motion]
TIMES = ("wall_seconds", "nanoseconds_per_particle_step", "peak_memory_bytes", "peak_memory_bytes_of_ranks",
         "expected_seconds", "expected_seconds_at_most")


def comparable(folder, ranks):
    files = launch.contents(folder)
    summary = json.loads(files["summary.json"])
    assert summary["ranks"] == ranks, f"the summary says {summary['ranks']} ranks, not {ranks}"
    for key in (*TIMES, "ranks", "threads", "memory_bytes", "bytes_per_particle"):
        summary.pop(key, None)
    files.update({f"summary.json, {key}": value for key, value in summary.items()})
    del files["summary.json"]
    del files["files.csv"]  # has the hash of the summary
    return files, summary


def main(program, name):
    scene = copy.deepcopy(BLOCK)
    next(case for case in CASES if case.__name__ == name)(scene)
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "scene.json")
        with open(path, "w", encoding="utf-8") as file:
            json.dump(scene, file)
        expected = None
        for ranks in (1, 2, 3):
            out = os.path.join(folder, f"ranks_{ranks}")
            end = launch.run(ranks, program, "run", path, "--out", out, "--threads", "2" if ranks == 2 else "1", "--quiet")
            if end.returncode != 0:
                sys.exit(f"{ranks} ranks: exit code {end.returncode}: {end.stderr}")
            found, summary = comparable(out, ranks)
            if expected is None:
                expected = found
                print(f"{summary['particles']} particles, {summary['steps']} steps, {summary['broken_springs']}, {summary['state_hash']}")
            different = sorted(file for file in found.keys() | expected.keys() if found.get(file) != expected.get(file))
            if different:
                sys.exit(f"{ranks} ranks: other than one process: {different}")


if __name__ == "__main__":
    if sys.argv[1:] == ["cases"]:
        print(";".join(case.__name__ for case in CASES), end="")
    else:
        main(sys.argv[1], sys.argv[2])
