# The program must accept every scene in the documents (JSON between fences) and run every study.
#   documented_scenes.py PROGRAM SOURCE
import pathlib
import re
import subprocess
import sys
import tempfile

program, source = sys.argv[1], pathlib.Path(sys.argv[2])
pages = [source / "README.md", *sorted((source / "docs" / "guide").glob("*.md"))]  # tutorials: page_commands.py
scenes = [(page, text) for page in pages for text in re.findall(r"^```json\n(.*?)^```", page.read_text(), re.M | re.S) if '"format"' in text]
# writers.render needs libraries that not every build has.
names = subprocess.run([program, "plugins", "--names"], check=True, capture_output=True, text=True).stdout.split()
if "writers.render" not in names:
    scenes = [(page, text) for page, text in scenes if '"writers.render"' not in text]
refused = 0
with tempfile.TemporaryDirectory() as folder:
    for page, text in scenes:
        file = pathlib.Path(folder) / "scene.json"
        file.write_text(text)
        command = ["study", file, "--out", f"{folder}/out"] if "hyperlattice-study/1" in text else ["plan", file]
        done = subprocess.run([program, *command], capture_output=True, text=True)
        if done.returncode:
            refused += 1
            print(f"{page}: {done.stderr}")
print(f"{len(scenes)} scenes, {refused} refused")
sys.exit(1 if refused or len(scenes) < 2 else 0)
