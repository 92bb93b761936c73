"""The program for another system answers as this one's: other_system.py PROGRAM OTHER...

OTHER starts it, as in: /usr/lib/wine/wine64 contensou.exe. Words are the same, numbers to 1e-10 of them (the functions of
C round in other ways), and so are the statuses; files are written whole, replaced and refused as here.
"""

import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

here, other = sys.argv[1:2], sys.argv[2:]
number = re.compile(r"(-?\d+\.?\d*(?:e[+-]?\d+)?)")
noise = 1e-10  # below it numbers are errors of rounding themselves, as those that `check` prints

COMMANDS = """
stop --ball pool --slip 2 --format json
stop --mu 0.3 --u0 1 --v0 1 --law exact,pade,uniform,pressure:2 --format csv --gradient
stop --ball puck --slip 5 --spin 100 --uncertainty slip=1%,friction=5% --format json
aim --ball puck --distance 20m --turns 3 --format json
bounce --ball rubber --spin 200 --drop 1 --restitution 0.8 --format json
orbit --mu 0.1 --u0 1 --v0 1 --samples 50
roll --ball gel --slip 0.5 --spin 300 --format json
roll --ball pool --velocity 1,0 --angular-velocity 40,35,-50 --format csv
sweep --mu 0.1 --u0 0:2:21 --v0 0:2:21 --format csv
terminal --law uniform --body disc --format json
law --law exact --k 0,0.5,1,2,inf --format csv
check --mu 0.1 --u0 1 --v0 1 --format json
literature --format csv
paper --format csv
reduce --mu 0.3 --u0 1 --v0 1 --format json
reduce --system "u' = -u/hypot(u,v); v' = -v/hypot(u,v) - a" --param a=0.2 --u0 1 --v0 1
balls pool -o -
engine mujoco --ball pool --format json
fit --plan --ball pool --fps 240 --noise slip=0.01,spin=1
portrait --mu 0.3 -o portrait.csv
portrait --ball pool -o portrait.json
help units
stop --ball pol
stop --mu 0.3 --u0 -
portrait --mu 0.3 -o nowhere/portrait.csv
"""


def run(program, words, folder):
    """Status, output and messages, as text."""
    ended = subprocess.run(program + words, cwd=folder, capture_output=True, env=os.environ | {"LC_ALL": "C.UTF-8"})
    return ended.returncode, ended.stdout.decode(), ended.stderr.decode()


def differences(ours, theirs):
    """What stands in one text and not in the other."""
    ours, theirs = number.split(ours), number.split(theirs)
    if ours[::2] != theirs[::2]:
        return [pair for pair in zip(ours[::2], theirs[::2]) if pair[0] != pair[1]][:3] or ["one is longer"]
    pairs = zip(map(float, ours[1::2]), map(float, theirs[1::2]))
    return [(a, b) for a, b in pairs if abs(a - b) > noise * (1 + abs(a))][:3]


wrong = []
with tempfile.TemporaryDirectory() as folder:
    written = pathlib.Path(folder)
    for line in COMMANDS.strip().splitlines():
        words = shlex.split(line)
        answers = []
        for program in here, other:
            answer = run(program, words, folder)
            files = {path.name: path.read_text() for path in sorted(written.iterdir())}
            for path in written.iterdir():
                path.unlink()
            answers.append((answer, files))
        (ours, our_files), (theirs, their_files) = answers
        found = differences(" ".join(map(str, ours)), " ".join(map(str, theirs)))
        found += [f"status {ours[0]} and {theirs[0]}"] * (ours[0] != theirs[0])
        found += [name for name in our_files.keys() ^ their_files.keys()]
        for name in our_files.keys() & their_files.keys():
            found += differences(our_files[name], their_files[name])
        print("differs" if found else "same   ", line, *found)
        wrong += found

    name = "file.csv"
    one, two = written / name, ["portrait", "--mu", "0.3", "-o", name]
    run(other, two, folder)
    first = one.read_text()
    run(other, ["portrait", "--mu", "0.6", "-o", name], folder)
    if first == one.read_text() or [path.name for path in written.iterdir()] != [name]:
        wrong.append("a file is not replaced whole")
    one.chmod(0o444)
    status, _, messages = run(other, two, folder)
    if status != 4 or name not in messages or first == one.read_text():
        wrong.append(f"a file that may not be written to: {status} {messages}")

print(f"{len(wrong)} differences")
sys.exit(bool(wrong))
