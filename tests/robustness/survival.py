"""Disturbs runs and resumes them: survival.py PROGRAM kills|checkpoints|full_disk|power_cuts
[COUNT].

Each trial ends a run at a random time, or damages its checkpoint, and resumes the run. The results
must be, byte for byte, those of a run without disturbance. A refusal must leave the folder as it
was. full_disk and power_cuts need root to mount a disk of their own, and power_cuts needs
mkfs.ext4; otherwise they are skipped (exit code 77).
"""
import hashlib
import json
import os
import random
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "support"))
from folders import contents  # noqa: E402

SCENE = {
    "format": "hyperlattice/1",
    "pipeline": [
        {"type": "lattices.cubic", "spacing": 1e-3, "shape": {"box": {"low": [0, 0, 0], "high": [0.006, 0.006, 0.01]}}},
        {"type": "materials.elastic", "young": "10 GPa", "poisson": 0.1, "density": 2500, "membrane": "I-m",
         "failure": {"type": "failures.elongation", "limit": "2e-3 mm"}},
        {"type": "loads.fixed", "on": "z_min"},
        {"type": "loads.velocity", "on": "z_max", "value": [0, 0, 1], "rise": "10 us"},
        {"type": "solvers.explicit", "end_time": "1 ms"},
        {"type": "writers.vtu", "every": "50 us"},
        {"type": "writers.csv", "every": "50 us", "name": "tables"},
        {"type": "writers.picture", "every": "100 us", "width": 160, "height": 160},
        {"type": "probes.point", "name": "top", "position": [0.003, 0.003, 0.01], "every": "10 us"},
    ],
}
CHECKPOINTS = ("checkpoint.bin", "checkpoint.previous.bin")


class Trial:
    def __init__(self, program, folder):
        self.program, self.folder = program, folder
        self.scene = os.path.join(folder, "scene.json")
        with open(self.scene, "w", encoding="utf-8") as file:
            json.dump(SCENE, file)
        self.whole = os.path.join(folder, "whole")
        start = time.monotonic()
        assert self.run(self.whole).returncode == 0
        self.seconds = time.monotonic() - start
        self.expected = results(self.whole)

    def command(self, out, *more):
        return [self.program, "run", self.scene, "--out", out, "--threads", "1", "--quiet", "--checkpoint-every", "0.005", *more]

    def run(self, out, *more):
        return subprocess.run(self.command(out, *more), capture_output=True, text=True, timeout=120, check=False)

    def start(self, out, *more):
        return subprocess.Popen(self.command(out, *more), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def finish(self, out, what):
        """Resumes the run, or starts it if no checkpoint exists, and compares its results."""
        resumable = any(os.path.exists(os.path.join(out, name)) for name in CHECKPOINTS)
        end = self.run(out, *(["--resume"] if resumable else []))
        if end.returncode != 0:
            sys.exit(f"{what}: exit code {end.returncode}: {end.stderr}")
        found = results(out)
        different = sorted(name for name in found.keys() | self.expected.keys() if found.get(name) != self.expected.get(name))
        if different:
            sys.exit(f"{what}: other than without: {different}")
        return resumable


def results(folder):
    """Hashes of all files, without times and memory of the run. Only the last entry of each file in
    files.csv counts."""
    files = contents(folder)
    summary = json.loads(files.pop("summary.json"))
    for key in ("wall_seconds", "nanoseconds_per_particle_step", "peak_memory_bytes"):
        summary.pop(key)
    listed = {}
    for line in files.pop("files.csv").decode().splitlines()[1:]:
        if line:
            size, content, name = line.split(",", 2)
            listed[name] = (size, content)
    listed.pop("summary.json")
    return {name: hashlib.sha256(data).hexdigest() for name, data in files.items()} | {"summary.json": summary, "files.csv": listed}


def kills(trial, count):
    resumed = 0
    for n in range(count):
        out = os.path.join(trial.folder, "killed")
        shutil.rmtree(out, ignore_errors=True)
        for _ in range(random.randint(1, 3)):  # the run may be killed several times
            resumable = any(os.path.exists(os.path.join(out, name)) for name in CHECKPOINTS)
            process = trial.start(out, *(["--resume"] if resumable else []))
            time.sleep(random.uniform(0, 1.2 * trial.seconds))
            process.kill()
            process.wait()
        resumed += trial.finish(out, f"kill {n}")
    print(f"{count} kills, {resumed} resumed from a checkpoint, all with the same bytes")


def killed_with_two_checkpoints(trial, out):
    for _ in range(100):
        shutil.rmtree(out, ignore_errors=True)
        process = trial.start(out)
        time.sleep(random.uniform(0.3, 0.9) * trial.seconds)
        process.kill()
        process.wait()
        if all(os.path.exists(os.path.join(out, name)) for name in CHECKPOINTS):
            return
    sys.exit("no run had two checkpoints when it was killed")


def records_of(data):
    """The records of a checkpoint, header first."""
    parts, place = [data[:16]], 16
    while place < len(data):
        size = struct.unpack_from("<I", data, place + 4)[0]
        parts.append(data[place:place + 24 + size])
        place += 24 + size
    return parts


def spoiled(data):
    kind = random.randrange(7)
    changed = bytearray(data)
    if kind == 0:
        changed[random.randrange(len(data))] ^= 1 << random.randrange(8)
    elif kind == 1:
        del changed[random.randrange(len(data)):]
    elif kind == 2:
        place = random.randrange(len(data))
        length = random.randint(1, 64)
        changed[place:place + length] = random.randbytes(length)
    elif kind == 3:
        changed += random.randbytes(random.randint(1, 100))
    elif kind == 4:  # records swapped, repeated or removed
        parts = records_of(data)
        a, b = random.randrange(1, len(parts)), random.randrange(1, len(parts))
        way = random.randrange(3)
        if way == 0:
            parts[a], parts[b] = parts[b], parts[a]
        elif way == 1:
            parts.insert(a, parts[b])
        else:
            del parts[a]
        changed = b"".join(parts)
    elif kind == 5:  # another size in a record
        parts = records_of(data)
        a = random.randrange(1, len(parts))
        part = bytearray(parts[a])
        struct.pack_into("<I", part, 4, random.choice([0, 1, len(part), 2**20, 2**31, 2**32 - 1]))
        parts[a] = bytes(part)
        changed = b"".join(parts)
    else:
        del changed[:random.randrange(len(data))]
    return bytes(changed)


def checkpoints(trial, count):
    base, out = os.path.join(trial.folder, "base"), os.path.join(trial.folder, "spoiled")
    killed_with_two_checkpoints(trial, base)
    good = {name: contents(base)[name] for name in CHECKPOINTS}
    refused = earlier = 0
    for n in range(count):
        shutil.rmtree(out, ignore_errors=True)
        shutil.copytree(base, out)
        both = n % 8 != 0  # a whole run takes longer than a refusal
        for name in CHECKPOINTS if both else CHECKPOINTS[:1]:
            data = spoiled(good[name])
            if data == good[name]:
                data = data[:-1]
            with open(os.path.join(out, name), "wb") as file:
                file.write(data)
        before = contents(out)
        if not both:
            trial.finish(out, f"checkpoint {n}")
            earlier += 1
            continue
        end = trial.run(out, "--resume")
        if end.returncode != 2:
            sys.exit(f"checkpoint {n}: exit code {end.returncode}: {end.stderr}")
        if contents(out) != before:
            sys.exit(f"checkpoint {n}: the refusal has changed the folder")
        refused += 1
    print(f"{count} checkpoints: {refused} refused with the folder as it was, {earlier} went on from the one before to the same bytes")


def need_root():
    if os.geteuid() != 0:
        print("skipped: this needs root")
        sys.exit(77)


def need_program(name):
    if shutil.which(name) is None:
        print(f"skipped: this needs {name}")
        sys.exit(77)


def mount(*arguments):
    if subprocess.run(["mount", *arguments], capture_output=True, check=False).returncode != 0:
        print("skipped: nothing can be mounted here")
        sys.exit(77)


def full_disk(trial, count):
    need_root()
    disk = os.path.join(trial.folder, "disk")
    os.mkdir(disk)
    needed = sum(len(data) for data in contents(trial.whole).values())
    stopped = 0
    for n in range(count):
        size = max(65536, int(needed * 1.3 * (n + 1) / count)) // 4096 * 4096
        mount("-t", "tmpfs", "-o", f"size={size}", "tmpfs", disk)
        try:
            out = os.path.join(disk, "out")
            end = trial.run(out)
            if end.returncode not in (0, 4):
                sys.exit(f"full disk {n}: exit code {end.returncode}: {end.stderr}")
            stopped += end.returncode == 4
            for name, data in contents(out).items():
                if name.endswith(".part") or (name.endswith(".csv") and data[-1:] != b"\n"):
                    sys.exit(f"full disk {n}: {name} is half written")
            subprocess.run(["mount", "-o", "remount,size=200m", disk], check=True)
            if end.returncode != 0:
                trial.finish(out, f"full disk {n}, {size} bytes")
        finally:
            subprocess.run(["umount", disk], check=False)
    print(f"{count} sizes of a disk, {stopped} full before the run was done; all went on to the same bytes")


def power_cuts(trial, count):
    need_root()
    need_program("mkfs.ext4")
    disk, after = os.path.join(trial.folder, "disk"), os.path.join(trial.folder, "after")
    image, copy = os.path.join(trial.folder, "image"), os.path.join(trial.folder, "copy")
    for folder in (disk, after):
        os.mkdir(folder)
    resumed = 0
    for n in range(count):
        with open(image, "wb") as file:
            file.truncate(64 << 20)
        subprocess.run(["mkfs.ext4", "-q", "-F", image], check=True)
        mount("-o", "loop", image, disk)
        try:
            process = trial.start(os.path.join(disk, "out"))
            time.sleep(random.uniform(0.1, 1) * trial.seconds)
            process.send_signal(signal.SIGSTOP)
            shutil.copyfile(image, copy)  # state of the disk; caches are lost
            process.kill()
            process.wait()
        finally:
            subprocess.run(["umount", disk], check=False)
        mount("-o", "loop", copy, after)  # the mount replays the journal
        try:
            out = os.path.join(after, "out")
            resumable = any(os.path.exists(os.path.join(out, name)) for name in CHECKPOINTS)
            if not resumable:
                shutil.rmtree(out, ignore_errors=True)
            resumed += trial.finish(out, f"power cut {n}")
        finally:
            subprocess.run(["umount", after], check=False)
    print(f"{count} power cuts, {resumed} resumed from a checkpoint, all with the same bytes")


def main():
    program, kind = sys.argv[1], sys.argv[2]
    ways = {"kills": (kills, 100), "checkpoints": (checkpoints, 1000), "full_disk": (full_disk, 20), "power_cuts": (power_cuts, 20)}
    way, count = ways[kind]
    count = int(sys.argv[3]) if len(sys.argv) > 3 else count
    seed = random.randrange(2**32)
    print(f"seed {seed}")
    random.seed(seed)
    with tempfile.TemporaryDirectory(prefix="hyperlattice_survival_") as folder:
        way(Trial(program, folder), count)


main()
