# Finds when particles of a cohesive material crack in a run. The scene must write their damage:
#   { "type": "writers.csv", "name": "damage", "file": "damage", "every": "1 us", "fields": ["damage"] }
import csv

CRACKED = 0.9  # damage from which a particle counts as cracked


def cracked_particles(out):
    """Returns (time, x, y), s and m, of each particle that cracks, in the order of the frames; `out` is
    the folder of the run."""
    with open(out / "damage" / "damage_times.csv") as file:
        times = {row["file"]: float(row["time"]) for row in csv.DictReader(file)}
    cracked, found = set(), []
    for name, time in times.items():
        with open(out / "damage" / name) as file:
            for number, row in enumerate(csv.DictReader(file)):
                if float(row["damage"]) > CRACKED and number not in cracked:
                    cracked.add(number)
                    found.append((time, float(row["x"]), float(row["y"])))
    return found
