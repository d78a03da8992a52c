# The page docs/verification.md has a row for each case that `verify --list` names, in the same order, and a plot for
# each family.
#   verification_page.py SOURCE
import pathlib
import re
import subprocess
import sys

source = pathlib.Path(sys.argv[1])
command = [sys.executable, source / "tests/stability/verify", "--list"]
cases = subprocess.run(command, check=True, capture_output=True, text=True).stdout.split()
page = (source / "docs/verification.md").read_text(encoding="utf-8")
rows = re.findall(r"^\| `([^`]+/[^`]+)` \|", page, re.M)
pictures = {f"verification/{case.split('/')[0]}.svg" for case in cases}
faults = [f"{name}: not on the page" for name in cases if name not in rows]
faults += [f"{name}: on the page, but no case" for name in rows if name not in cases]
faults += [f"docs/{picture}: missing" for picture in pictures
           if f"]({picture})" not in page or not (source / "docs" / picture).is_file()]
if not faults and rows != cases:
    faults = ["the order of the cases differs"]
print("\n".join(faults) if faults else f"{len(cases)} cases")
sys.exit(1 if faults or not cases else 0)
