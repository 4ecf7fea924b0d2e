#!/usr/bin/python3
"""Blocks of the READMEs that show what the program prints are what it prints.

check_readme.py VISCARD SOURCE_FOLDER

A block under `<!-- printed by: viscard ... -->` must stand line by line in what that command prints, in a
folder that holds data/ only. Blocks with times or machines say so in the text and have no such line.
"""
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

VISCARD, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
MARK = re.compile(r"<!-- printed by: (viscard .*?) -->\n```\n(.*?)\n```", re.DOTALL)

mistakes, blocks = [], 0
for path in [SOURCE / "README.md", *sorted(SOURCE.glob("[fimrd]*/**/README.md"))]:
    for line, block in MARK.findall(path.read_text()):
        blocks += 1
        with tempfile.TemporaryDirectory() as folder:
            os.symlink(SOURCE / "data", pathlib.Path(folder, "data"))
            done = subprocess.run([VISCARD, *shlex.split(line)[1:]], cwd=folder, capture_output=True, text=True)
        if block not in done.stdout:
            mistakes.append(f"{path}: `{line}` no longer prints this block, but\n{done.stdout[-3000:]}{done.stderr[-500:]}")
for mistake in mistakes:
    print(mistake)
print(f"{blocks} blocks, {len(mistakes)} mistakes")
sys.exit(1 if mistakes or blocks == 0 else 0)
