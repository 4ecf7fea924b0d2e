#!/usr/bin/python3
"""What a person at a terminal meets: examples that run in order, manual pages, completion.

check_terminal.py VISCARD SOURCE_FOLDER [--slow]
"""
import json
import os
import pathlib
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile

VISCARD, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
IS_SLOW = "--slow" in sys.argv
LONG = ("cost", "demo")  # their examples take half a minute
mistakes = []


def output(*words):
    return subprocess.run([VISCARD, *words], capture_output=True, text=True, check=True).stdout


def names():
    return [one["name"] for one in json.loads(output("help", "--json"))["commands"]]


def run_examples():
    """Each example as printed, in the order of the commands, in a folder that holds data/ only."""
    os.symlink(SOURCE / "data", "data")
    for name in names():
        if name in LONG and not IS_SLOW:
            continue
        example = json.loads(output(name, "--help", "--json"))["example"]
        words = [VISCARD, *shlex.split(example)[1:]]
        if name in ("serve", "desk"):  # until Ctrl-C
            page = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
            page.stdout.readline()
            page.send_signal(signal.SIGINT)
            status = page.wait(60)
            message = ""
        else:
            done = subprocess.run(words, capture_output=True, text=True, timeout=280)
            status, message = done.returncode, done.stderr[-300:]
        if status != 0:
            mistakes.append(f"{example}: exit status {status}: {message}")


def check_manual():
    if shutil.which("man") is None:
        print("man is not here; manual pages are not checked")
        return
    for name in ["", *names()]:
        page = output("help", "--man", *([name] if name else []))
        pathlib.Path("page.1").write_text(page)
        for columns in ("40", "80"):
            done = subprocess.run(["man", "-l", "--warnings", "page.1"], capture_output=True, text=True,
                                  env={**os.environ, "MANWIDTH": columns, "LC_ALL": "C.UTF-8", "MAN_KEEP_FORMATTING": ""})
            if done.returncode != 0 or (done.stderr and columns == "80"):
                mistakes.append(f"manual page of {name or 'viscard'}: {done.stderr[:300]}")
            if name == "sweep" and "viscard-mpi" not in done.stdout:
                mistakes.append("manual page of sweep does not name viscard-mpi")
            if "EXIT STATUS" not in done.stdout:
                mistakes.append(f"manual page of {name or 'viscard'} has no exit status")


def completed(line):
    """What bash offers for this command line."""
    words = line.split(" ")
    script = (f"PATH={shlex.quote(os.path.dirname(VISCARD))}:$PATH; source viscard.bash; "
              f"COMP_WORDS=({' '.join(shlex.quote(word) for word in words)}); COMP_CWORD={len(words) - 1}; "
              '_viscard; printf "%s\\n" "${COMPREPLY[@]}"')
    done = subprocess.run(["bash", "--norc", "-c", script], capture_output=True, text=True)
    if done.stderr:
        mistakes.append(f"bash completion of '{line}': {done.stderr[:300]}")
    return done.stdout.split()


def check_completion():
    pathlib.Path("viscard.bash").write_text(output("completion", "bash"))
    for line, wanted in [
            ("viscard fi", ["fit"]),
            ("viscard fit --boot", ["--bootstrap"]),
            ("viscard fit --kind r", ["relaxation"]),
            ("viscard card m.json --for calc", ["calculix"]),
            ("viscard card --units mm-t", ["mm-t-s"]),
            ("viscard rig ch", ["check"]),
            ("viscard help cap", ["capture"]),
            ("viscard completion z", ["zsh"]),
            ("viscard fit --out x", []),  # a file: left to the shell
            ("viscard fit run", [])]:
        offered = completed(line)
        if offered != wanted:
            mistakes.append(f"bash completion of '{line}': {offered}, not {wanted}")
    for shell in ("zsh", "fish"):
        if shutil.which(shell) is None:
            print(f"{shell} is not here; its script is not parsed")
            continue
        pathlib.Path(f"viscard.{shell}").write_text(output("completion", shell))
        done = subprocess.run([shell, "-n", f"viscard.{shell}"], capture_output=True, text=True)
        if done.returncode != 0 or done.stderr:
            mistakes.append(f"{shell} does not parse its script: {done.stderr[:300]}")


with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    for part in (run_examples, check_manual, check_completion):
        try:
            part()
        except Exception as error:  # what follows is still run
            mistakes.append(f"{part.__name__}: {type(error).__name__}: {error}")
    os.chdir("/")
for mistake in mistakes:
    print(mistake)
sys.exit(1 if mistakes else 0)
