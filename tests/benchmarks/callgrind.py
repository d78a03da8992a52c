"""Counts instructions of parts of a run, per particle-step, by valgrind's callgrind. Instructions do not depend on what else the machine does.
valgrind has no AVX-512, so the kernels are those of AVX2."""
import json
import re
import subprocess


def instructions(profile, parts):
    """Returns the instructions of each part; parts are names and patterns of functions, each counted with all that it calls."""
    command = ["callgrind_annotate", "--inclusive=yes", "--threshold=100", "--auto=no", profile]
    text = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    counts = dict.fromkeys(parts, 0)
    for count, function in re.findall(r"^ *([\d,]+) \(.*?%\)\s+\S*?:(hyperlattice::.*)$", text, re.MULTILINE):
        for part, pattern in parts.items():
            if re.match(pattern, function):
                counts[part] = max(counts[part], int(count.replace(",", "")))
    return counts


def measure(program, scene, folder, name, parts):
    """Runs a scene on one thread. Returns the instructions of each part per particle-step, and the summary of the run."""
    file, profile, out = (folder / f"{name}{end}" for end in (".json", ".callgrind", ""))
    file.write_text(json.dumps(scene))
    run = [program, "run", file, "--threads", "1", "--quiet", "--out", out]
    subprocess.run(["valgrind", "--tool=callgrind", f"--callgrind-out-file={profile}", *run], check=True, capture_output=True)
    summary = json.loads((out / "summary.json").read_text())
    each = summary["particles"] * summary["steps"]
    return {part: count / each for part, count in instructions(profile, parts).items()}, summary
