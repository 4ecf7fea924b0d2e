#!/usr/bin/python3
"""Reads files and runs command lines of an earlier viscard, and compares every number with what it printed then.

check_before.py VISCARD SOURCE_FOLDER [--record NAME]

before/commands.json lists the command lines; before/printed/NAME.json is what --json printed then. All keys of
then must still be there with the same numbers; new keys are welcome. "changed" of a command line names keys whose
numbers have changed for a reason that CHANGELOG.md gives under Numbers. --record writes the object of one new
command line, which must stand in commands.json.
"""
import gzip
import json
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

VISCARD, SOURCE = os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv[2]).resolve()
BEFORE = SOURCE / "tests/compatibility/before"
# What a run takes, where it ran and by what.
VOLATILE = {"version", "viscard", "wall_s", "cpu_s", "memory_B", "created_at", "created_by", "command", "sha256",
            "inputs", "file", "files", "out", "duration_s", "elapsed_s"}


def differences(then, now, where, relative, skipped=VOLATILE):
    """The places at which an object of then is not found again."""
    if isinstance(then, dict):
        if not isinstance(now, dict):
            yield f"{where}: was an object, is {now!r:.80}"
            return
        for key, value in then.items():
            if key in skipped:
                continue
            if key not in now:
                yield f"{where}/{key}: is gone"
            else:
                yield from differences(value, now[key], f"{where}/{key}", relative, skipped)
    elif isinstance(then, list):
        # New effects stand behind those of before.
        if where.endswith("/effects") and isinstance(now, list):
            now = now[:len(then)]
        if not isinstance(now, list) or len(then) != len(now):
            yield f"{where}: had {len(then)} entries, is {now!r:.80}"
            return
        for index, (one, other) in enumerate(zip(then, now)):
            yield from differences(one, other, f"{where}/{index}", relative, skipped)
    elif isinstance(then, bool) or then is None:
        if then != now:
            yield f"{where}: was {then}, is {now!r:.80}"
    elif isinstance(then, (int, float)):
        is_number = isinstance(now, (int, float)) and not isinstance(now, bool)
        if not is_number or not math.isclose(then, now, rel_tol=relative, abs_tol=1e-300):
            yield f"{where}: was {then}, is {now!r:.80}"
    # Texts are for people and may be worded anew.


def run(entry, folder):
    words = [word.replace("DATA", str(SOURCE / "data")) for word in entry["words"]]
    done = subprocess.run([VISCARD, *words, "--json"], capture_output=True, text=True, timeout=280, cwd=folder)
    return words, done


def main():
    entries = json.loads((BEFORE / "commands.json").read_text())
    recorded = sys.argv[sys.argv.index("--record") + 1] if "--record" in sys.argv else None
    mistakes, compared = [], 0
    with tempfile.TemporaryDirectory() as folder:
        shutil.copytree(BEFORE / "files", folder, dirs_exist_ok=True)
        for packed in pathlib.Path(folder).glob("*.gz"):
            packed.with_suffix("").write_bytes(gzip.decompress(packed.read_bytes()))
        for entry in entries:
            words, done = run(entry, folder)
            what = "viscard " + " ".join(words)
            printed = BEFORE / "printed" / f"{entry['name']}.json"
            if recorded in (entry["name"], "all"):
                printed.write_text(json.dumps(json.loads(done.stdout), separators=(",", ":")) + "\n")
                entry["status"] = done.returncode
            if done.returncode != entry["status"]:
                mistakes.append(f"{what}: exit status {done.returncode}, was {entry['status']}: {done.stderr[-300:]}")
                continue
            then = json.loads(printed.read_text())
            if "keys" in entry:  # the others depend on the time of the run
                then = {key: then[key] for key in entry["keys"]}
            found = list(differences(then, json.loads(done.stdout), entry["name"], entry.get("relative", 1e-6),
                                     VOLATILE | set(entry.get("changed", []))))
            mistakes += found[:5]
            compared += 1
    if recorded:
        (BEFORE / "commands.json").write_text("[\n" + ",\n".join(json.dumps(entry) for entry in entries) + "\n]\n")
    print(f"{compared} of {len(entries)} command lines compared")
    print("\n".join(mistakes), file=sys.stderr)
    return 1 if mistakes or compared != len(entries) else 0


sys.exit(main())
