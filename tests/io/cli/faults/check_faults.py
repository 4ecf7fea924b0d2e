#!/usr/bin/python3
"""Every writing command under faults of the machine: a table of what became of the files.

check_faults.py VISCARD SOURCE_FOLDER [--few] [--flips N] [--only NAME]

Each command runs in a folder of its own with inputs of all kinds, under one fault at a time. What it leaves counts as
  clean    the answer of a run without a fault, or the outputs of before; a later run gives the answer
  noted    an answer with a word about the fault (flips: refused, noted in the result, or without effect on it)
  refused  a failure in words; the outputs of before are whole, and the command works once the fault is gone
  lost     an output of before is damaged, half an output has its name, or the command does not work afterwards
  silent   another answer, exit status 0 and no word
  crash    ended by a signal other than ours, or by an exception without words
--few takes three tries a fault and 40 flips a kind; a command of more than two seconds gets a quarter of the tries.
Exit status 1 when anything is lost, silent or crashed.
"""
import argparse
import collections
import gzip
import os
import pathlib
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time

TIME_LIMIT_S = 120
KINDS = ("clean", "noted", "refused", "lost", "silent", "crash")
FEW = 3
TIMED = ("cost",)  # commands that measure times

Command = collections.namedtuple("Command", "name words outputs resume first", defaults=(None, None))


def commands():
    """Writing commands: words, the outputs that they name, how a cut run goes on (none: the same words again), and what
    runs once before them."""
    rows = [
        ("fit", "fit example_relaxation.csv --terms 2 --force --out out.json --csv out.csv", "out.json out.csv"),
        ("fit, picture", "fit creep.csv --terms 2 --force --svg out.svg", "out.svg"),
        ("fit, rubber", "fit uniaxial=treloar_uniaxial.csv --model yeoh --force --out out.json", "out.json"),
        ("fit --joint", "fit --joint ratio10.csv ratio13.csv ratio20.csv --ratio 10 --ratio 13 --ratio 20 --force "
         "--out out.json", "out.json"),
        ("card", "card material.json --for abaqus --units mm-t-s --reproducible --force --out out.inp", "out.inp"),
        ("card --import", "card card.inp --import out.json --for abaqus --units mm-t-s --force", "out.json"),
        ("predict", "predict material.json --test creep --stress 10kPa --hold 60s --points 20 --force --csv out.csv "
         "--svg out.svg", "out.csv out.svg"),
        ("validate", "validate materials/pdms_1to10_seed.json --force --csv out.csv", "out.csv"),
        ("calibrate", "calibrate --data weights.csv --capacity 250gf --force --out out.toml", "out.toml"),
        ("simulate", "simulate scenes/pillar_creep.toml --force --out out", "out/*"),
        ("scene", "scene check scenes/pillar_press.toml --force --svg out.svg", "out.svg"),
        ("cost", "cost scenes/pillar_modal.toml --budget 1s --force --out out", "out/*"),
        ("report", "report material.json --reproducible --force --out out.html", "out.html"),
        ("export", "export run.viscap --force --out out.csv", "out.csv"),
        ("design", "design --force --out out", "out/*"),
        ("sweep", "sweep studies/pillar.toml --force --out out.sqlite --csv out.csv", "out.csv"),
    ]
    for name, words, outputs in rows:
        yield Command(name, words.split(), outputs.split())
    if shutil.which("ccx"):
        yield Command("card --prove", "card --prove proven.inp --force --out out.proof.json".split(), ["out.proof.json"],
                      first="card material.json --for calculix --units mm-t-s --out proven.inp".split())
    capture = ("capture --emulate --speed 500 --seed 3 --rig rig.toml --test test.toml --specimen "
               "03_pdms_1to10.toml --out run2.viscap")
    yield Command("capture", capture.split(), ["run2.viscap"], "export run2.viscap --force --out out.csv".split())


def make_folder(source, into):
    before = source / "tests/compatibility/before/files"
    shutil.copytree(before, into)
    for packed in into.glob("*.gz"):
        packed.with_suffix("").write_bytes(gzip.decompress(packed.read_bytes()))


class Result(collections.namedtuple("Result", "status out err")):
    def words(self):
        return bool(self.err.strip())

    def crashed(self):
        return self.status < 0 or "terminate called" in self.err or "std::" in self.err


class Study:
    def __init__(self, viscard, source, tries):
        self.viscard, self.source, self.tries = viscard, source, tries
        self.least_B = self.least_memory()
        self.table = collections.defaultdict(collections.Counter)
        self.examples = []

    def run(self, words, folder, limit=None, act=None):
        """The command; limit is called in the child before it starts, act(process) beside it."""
        # Pipes: a limit of file size must not hold for what is printed.
        process = subprocess.Popen([self.viscard, *words], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   stdin=subprocess.DEVNULL, preexec_fn=limit)
        if act:
            act(process)
        try:
            out, err = process.communicate(timeout=TIME_LIMIT_S)
            status = process.returncode
        except subprocess.TimeoutExpired:
            process.kill()
            out, err = process.communicate()
            status = -signal.SIGALRM
        return Result(status, out.decode(errors="replace"), err.decode(errors="replace"))

    def least_memory(self):
        """Address space in which the program starts at all: below it the loader of libraries fails, not the program."""
        low, high = 1 << 20, 1 << 30
        while high - low > 1 << 16:
            middle = (low + high) // 2
            starts = self.run(["help"], None, limiter(resource.RLIMIT_AS, middle)).status == 0
            low, high = (low, middle) if starts else (middle, high)
        return high

    def memory_limit(self):
        """Half of the limits lie just above what the program needs to start."""
        return limiter(resource.RLIMIT_AS, self.least_B + random.randint(0, random.choice((6, 120)) << 20))

    def count(self, row, column, kind, detail=""):
        self.table[row][column, kind] += 1
        if kind in ("lost", "silent", "crash"):
            self.examples.append(f"{kind}: {row}, {column}: {detail}")

    # --- what a command left ---------------------------------------------------------------------------
    def outputs(self, command, folder):
        found = {}
        for pattern in command.outputs:
            for path in sorted(folder.glob(pattern)):
                # What kill leaves of a file in the making, ".x.csv.123.tmp", is removed by the next run.
                if path.is_file() and not path.name.startswith("."):
                    found[str(path.relative_to(folder))] = path.read_bytes()
        return found

    def reference(self, command, folder):
        """The outputs of two runs, and a function that says whether others are the same but for times and dates."""
        first_result = self.run(command.words, folder)
        first = self.outputs(command, folder)
        if first_result.status != 0 or not first:
            raise SystemExit(f"{command.name} fails without a fault: {first_result.err[-500:]}")
        time.sleep(1.1)  # dates are written in seconds
        self.run(command.words, folder)
        second = self.outputs(command, folder)

        def same(found):
            if found.keys() != first.keys():
                return False
            if command.name in TIMED:  # every number changes; a whole file has its last line
                return all(kept.rstrip()[-1:] == first[name].rstrip()[-1:] for name, kept in found.items())
            for name, content in found.items():
                lines, others, these = (kept[name].split(b"\n") for kept in (first, second, found))
                if len(lines) != len(these):
                    return False
                # Lines that differ between two runs without a fault hold times.
                if any(a == b and a != c for a, b, c in zip(lines, others, these)):
                    return False
            return True

        return first, same

    def judge(self, command, column, result, folder, before, same, ours=()):
        """Counts what a fault has left in folder, where the outputs of before stood."""
        found = self.outputs(command, folder)
        if result.crashed() and -result.status not in ours:
            return self.count(command.name, column, "crash", f"status {result.status}: {result.err[-300:]}")
        whole = same(found) or found == before
        if not whole and not (not found and not before):
            # Several outputs of one command: each is that of before or the new one.
            whole = all(found.get(name) is not None for name in before) and \
                result.status != 0 and set(found) >= set(before) and same({**before, **found})
        if not whole:
            kind = "silent" if result.status == 0 and not result.words() else "lost"
            return self.count(command.name, column, kind, f"status {result.status}: {result.err[-300:]}")
        if result.status == 0:
            kind = "clean" if same(found) else "lost"
            if column == "input gone" and kind == "lost":
                kind = "silent"
        elif result.status in [-number for number in ours]:
            kind = "clean"
        else:
            kind = "refused" if result.words() else "lost"
        return self.count(command.name, column, kind, f"status {result.status}: {result.err[-300:]}")

    def afterwards(self, command, column, folder, same):
        """The same words once the fault is gone."""
        result = self.run(command.words, folder)
        if result.status != 0 or not same(self.outputs(command, folder)):
            self.count(command.name, column, "lost", f"afterwards: status {result.status}: {result.err[-300:]}")

    # --- faults ----------------------------------------------------------------------------------------
    def try_command(self, command, home):
        clean = home / "clean"
        make_folder(self.source, clean)
        started = time.monotonic()
        if command.resume:
            return self.try_capture(command, home, clean)
        if command.first and self.run(command.first, clean).status != 0:
            raise SystemExit(f"{' '.join(command.first)} fails without a fault")
        before, same = self.reference(command, clean)
        took_s = (time.monotonic() - started) / 2
        tries = max(FEW, self.tries // 4) if took_s > 2 else self.tries

        def attempt(column, words=None, limit=None, act=None, prepare=None, ours=()):
            folder = home / "tried"
            shutil.copytree(clean, folder)
            if prepare:
                prepare(folder)
            result = self.run(words or command.words, folder, limit, act)
            self.judge(command, column, result, folder, before, same, ours)
            if column != "input gone":
                self.afterwards(command, column, folder, same)
            shutil.rmtree(folder)

        largest = max(len(content) for content in before.values())
        for number in range(tries):
            attempt("kill", act=killer(random.uniform(0, 1.1 * took_s)), ours=(signal.SIGKILL,))
            attempt("stop", act=killer(random.uniform(0, 1.1 * took_s), signal.SIGTERM), ours=(signal.SIGTERM,))
            attempt("file size", limit=limiter(resource.RLIMIT_FSIZE, int(largest * number / tries)))
            attempt("descriptors", limit=limiter(resource.RLIMIT_NOFILE, 3 + number))
            attempt("memory", limit=self.memory_limit())
            inputs = [word for word in command.words[1:] if (clean / word).is_file() and not word.startswith("out")]
            inputs += [word.split("=")[1] for word in command.words if "=" in word]
            if not inputs:
                continue
            gone = random.choice(inputs)
            attempt("input gone", act=lambda process: (time.sleep(random.uniform(0, took_s)),
                                                       (home / "tried" / gone).unlink()))
        shutil.rmtree(clean)

    def try_capture(self, command, home, clean):
        """A capture that is cut keeps what was committed, and export reads it."""
        started = time.monotonic()
        if self.run(command.words, clean).status != 0:
            raise SystemExit("a capture fails without a fault")
        took_s = time.monotonic() - started
        size = (clean / "run2.viscap").stat().st_size
        for made in clean.glob("run2*"):  # the truth of the emulated rig stands beside the capture
            made.unlink()

        def attempt(column, limit=None, act=None, ours=()):
            folder = home / "tried"
            shutil.copytree(clean, folder)
            result = self.run(command.words, folder, limit, act)
            exported = self.run(command.resume, folder)
            if (result.crashed() and -result.status not in ours) or exported.crashed():
                kind = "crash"
            elif (folder / "run2.viscap").exists():
                kind = "clean" if exported.status == 0 else "refused" if exported.words() else "lost"
            else:
                kind = "clean" if -result.status in ours else "refused" if result.words() else "lost"
            self.count(command.name, column, kind, f"status {result.status}: {result.err[-200:]} {exported.err[-200:]}")
            shutil.rmtree(folder)

        for number in range(self.tries):
            attempt("kill", act=killer(random.uniform(0, 1.1 * took_s)), ours=(signal.SIGKILL,))
            attempt("stop", act=killer(random.uniform(0, 1.1 * took_s), signal.SIGTERM), ours=(signal.SIGTERM,))
            attempt("file size", limit=limiter(resource.RLIMIT_FSIZE, int(size * number / self.tries)))
            attempt("descriptors", limit=limiter(resource.RLIMIT_NOFILE, 3 + number))
            attempt("memory", limit=self.memory_limit())
        shutil.rmtree(clean)

    def try_full_disk(self, command, home):
        """In a file system of a few blocks, where the user may mount one."""
        if command.resume or subprocess.run(["unshare", "-rm", "true"], capture_output=True).returncode != 0:
            return
        clean = home / "clean"
        make_folder(self.source, clean)
        if command.first:
            self.run(command.first, clean)
        before, same = self.reference(command, clean)
        used_kB = int(subprocess.run(["du", "-sk", clean], capture_output=True, text=True).stdout.split()[0])
        for number in range(self.tries):
            report = home / "report"
            report.mkdir()
            room_kB = used_kB + 4 * number + 8
            script = (f"mount -t tmpfs -o size={room_kB}k none '{home}/tried' && cp -r '{clean}/.' '{home}/tried' && "
                      f"cd '{home}/tried' && '{self.viscard}' \"$@\" >'{report}/out' 2>'{report}/err'; "
                      f"echo $? >'{report}/status'; cp -r '{home}/tried/.' '{report}/left'")
            (home / "tried").mkdir()
            subprocess.run(["unshare", "-rm", "sh", "-c", script, "sh", *command.words], capture_output=True)
            status = int((report / "status").read_text())
            result = Result(status if status < 128 else 128 - status, "", (report / "err").read_text())
            self.judge(command, "full disk", result, report / "left", before, same)
            shutil.rmtree(report), shutil.rmtree(home / "tried")
        shutil.rmtree(clean)


def killer(delay_s, number=signal.SIGKILL):
    def act(process):
        time.sleep(delay_s)
        process.send_signal(number)
    return act


def limiter(what, limit):
    return lambda: resource.setrlimit(what, (limit, limit))


# --- flipped bits ----------------------------------------------------------------------------------------
# Of each kind of file with a sum: the file, and the words that read it.
FLIPPED = [
    ("flip: capture", "run.viscap", "fit run.viscap --terms 2 --json"),
    ("flip: material", "new.json", "predict new.json --test creep --stress 10kPa --hold 60s --points 5 --json"),
    ("flip: joint fit", "new_joint.json", "card new_joint.json --ratio 12 --for febio --units SI --reproducible --json"),
    ("flip: sweep store", "kept.sqlite", "sweep studies/pillar.toml --out kept.sqlite --force --json --csv out.csv"),
    ("flip: card", "new.inp", "card --verify new.inp --json"),
    ("flip: certificate", "proven.inp.calculix.proof.json", "card --verify proven.inp.calculix.proof.json --json"),
]
# What a run takes, where it ran and by what.
VOLATILE = re.compile(r'"(wall_s|cpu_s|memory_B|created_at|duration_s|elapsed_s|sha256)": ?("[^"]*"|[^,}\n]*)|sha256 [0-9a-f]{64}')


def first_difference(one, other):
    """Where two texts differ, with what stands around it."""
    at = next((k for k, (a, b) in enumerate(zip(one, other)) if a != b), min(len(one), len(other)))
    return f"{one[max(0, at - 40):at + 40]!r} is {other[max(0, at - 40):at + 40]!r}"


def try_flips(study, home, number):
    folder = home / "flips"
    proof = shutil.which("ccx") is not None
    make_folder(study.source, folder)
    for words in ("sweep studies/pillar.toml --out kept.sqlite",
                  "fit example_relaxation.csv --terms 2 --out new.json",
                  "fit --joint ratio10.csv ratio13.csv ratio20.csv --ratio 10 --ratio 13 --ratio 20 --out new_joint.json",
                  "card material.json --for abaqus --units mm-t-s --out new.inp",
                  *(["card new.json --for calculix --units mm-t-s --out proven.inp", "card --prove proven.inp"]
                    if proof else [])):
        made = study.run(words.split(), folder)
        if made.status != 0:
            raise SystemExit(f"{words} fails: {made.err[-500:]}")
    for kind, name, words in FLIPPED if proof else FLIPPED[:-1]:  # the last needs CalculiX
        whole = (folder / name).read_bytes()
        clean = study.run(words.split(), folder)
        if clean.status != 0:
            raise SystemExit(f"{words} fails: {clean.err[-500:]}")
        expected = VOLATILE.sub("", clean.out)
        for _ in range(number):
            damaged = bytearray(whole)
            place, bit = random.randrange(len(whole)), random.randrange(8)
            damaged[place] ^= 1 << bit
            (folder / name).write_bytes(damaged)
            result = study.run(words.split(), folder)
            found = VOLATILE.sub("", result.out)
            where = f"byte {place} bit {bit}: {first_difference(expected, found)}"
            if result.crashed():
                study.count(kind, "flip", "crash", where + result.err[-200:])
            elif result.status != 0:
                study.count(kind, "flip", "refused" if result.words() or result.out else "lost", where)
            elif found == expected and result.err == clean.err:
                study.count(kind, "flip", "clean")
            elif result.err != clean.err or notes(result.out) - notes(clean.out):
                study.count(kind, "flip", "noted")
            else:
                study.count(kind, "flip", "silent", where)
        (folder / name).write_bytes(whole)


def notes(printed):
    """The words of an answer that state a doubt."""
    return set(re.findall(r'"(?:flag|note|message|doubt|edited|unverified)[^"]*": ?"([^"]+)"', printed)) | \
        set(re.findall(r'edited since[^"]*|damaged[^"]*|not checked[^"]*', printed))


def print_table(study, columns):
    """Rows as Markdown: clean/noted/refused of each fault, then what must be 0."""
    names = list(dict.fromkeys(row for row in study.table))
    print("| command | " + " | ".join(columns) + " | lost | silent | crash |")
    print("|---|" + "---|" * (len(columns) + 3))
    for row in names:
        counts = study.table[row]
        cells = []
        for column in columns:
            kinds = [counts[column, kind] for kind in ("clean", "noted", "refused")]
            cells.append("/".join(map(str, kinds)) if sum(kinds) else "")
        bad = [sum(count for (_, kind), count in counts.items() if kind == bad) for bad in ("lost", "silent", "crash")]
        print(f"| {row} | " + " | ".join(cells) + " | " + " | ".join(map(str, bad)) + " |")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("viscard")
    parser.add_argument("source", type=pathlib.Path)
    parser.add_argument("--few", action="store_true")
    parser.add_argument("--tries", type=int, default=20)
    parser.add_argument("--flips", type=int, default=400)
    parser.add_argument("--only", help="commands whose name begins so; 'flip' for the flips")
    parser.add_argument("--seed", type=int, default=1)
    words = parser.parse_args()
    random.seed(words.seed)
    study = Study(os.path.abspath(words.viscard), words.source.resolve(), FEW if words.few else words.tries)
    try:
        with tempfile.TemporaryDirectory() as folder:
            for command in commands():
                if not words.only or command.name.startswith(words.only):
                    print(f"{command.name} ...", file=sys.stderr)
                    study.try_command(command, pathlib.Path(folder))
                    study.try_full_disk(command, pathlib.Path(folder))
            if not words.only or words.only == "flip":
                print("flipped bits ...", file=sys.stderr)
                try_flips(study, pathlib.Path(folder), 40 if words.few else words.flips)
    finally:  # what was found is printed even if a step cannot be made
        print_table(study, ["kill", "stop", "file size", "full disk", "descriptors", "memory", "input gone", "flip"])
    print("\n".join(study.examples), file=sys.stderr)
    return 1 if study.examples else 0


sys.exit(main())
