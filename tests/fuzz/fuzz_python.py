#!/usr/bin/python3
"""Calls the functions of the Python module with arguments drawn at random, for some seconds.

fuzz_python.py FOLDER_OF_MODULE [SECONDS] [SEED]

Each call returns or raises ValueError, TypeError, OSError, RuntimeError, MemoryError or viscard.Error with a text. Ends
with status 1 at the first other exception, a call that takes longer than ten seconds, or (the caller notices) a crash.
The last line printed before is the call.
"""
import faulthandler
import pathlib
import random
import sys
import tempfile
import time

sys.path.insert(0, sys.argv[1])
import numpy as np
import viscard

seconds = float(sys.argv[2]) if len(sys.argv) > 2 else 60.0
rng = random.Random(int(sys.argv[3]) if len(sys.argv) > 3 else 1)
CALL_LIMIT_S = 10

folder = pathlib.Path(tempfile.mkdtemp(prefix="viscard-fuzz-"))
times = np.geomspace(0.01, 100.0, 40)
moduli = 1e6 * (1.0 + 0.5 * np.exp(-times / 3.0))
fitted = viscard.fit({"time_s": times, "modulus_Pa": moduli}, terms=1)
material = fitted.material
scene = viscard.data_file("scenes/pillar_press.toml")
volts = np.full((2, 2), 1e-3)

GOOD = [
    (viscard.fit, [{"time_s": times, "modulus_Pa": moduli}], {"terms": 1, "name": "a"}),
    (viscard.fit, [{"strain": np.linspace(0, 1, 20), "stress_Pa": np.linspace(0, 1e6, 20)}], {"model": "neo-hookean"}),
    (viscard.predict, [material], {"test": "creep", "stress": "10 kPa", "hold": "60 s", "points": 5}),
    (viscard.predict, [material], {"test": "relaxation", "strain": 0.01, "hold": 60.0}),
    (viscard.simulate, [scene], {"tol": 0.01}),
    (viscard.plan, [scene], {"tol": 0.01}),
    (viscard.check_scene, [scene], {}),
    (viscard.read_table, [viscard.data_file("demo/example_relaxation.csv")], {"column": None}),
    (viscard.read_capture, [folder / "none.viscap"], {}),
    (viscard.data_file, ["demo/example_relaxation.csv"], {}),
    (viscard.card_targets, [], {}),
    (viscard.pressures_from_voltages, [viscard.data_file("scenes/space_array.toml"), volts], {"noise": 1e-6}),
    (material.card, [], {"target": "abaqus", "units": "mm-t-s"}),
    (material.relaxation, [times], {}),
    (material.storage, [times], {}),
    (material.validate, [], {}),
]


def odd():
    """A value that somebody might hand over by mistake."""
    return rng.choice([
        lambda: None, lambda: float("nan"), lambda: float("inf"), lambda: -1, lambda: 0, lambda: 1e308, lambda: 10**400,
        lambda: True, lambda: 1j, lambda: "", lambda: "\0", lambda: "\ud800", lambda: "2 GPa", lambda: "-3 um",
        lambda: "a" * 20000, lambda: "[" * 3000, lambda: b"\xff\xfe", lambda: bytearray(8), lambda: [], lambda: [[]],
        lambda: {}, lambda: {"time_s": [1, 2]}, lambda: {"": []}, lambda: object(), lambda: len, lambda: Ellipsis,
        lambda: pathlib.Path(""), lambda: folder, lambda: [None] * 3, lambda: ("a", 1), lambda: range(5), lambda: {1, 2},
        lambda: np.array([]), lambda: np.zeros((0, 3)), lambda: np.zeros((2, 2, 2)), lambda: np.array(["a", "b"]),
        lambda: np.array([None, 1]), lambda: np.array([1 + 2j]), lambda: np.ma.masked_all(5), lambda: times[::-1],
        lambda: np.float32(3), lambda: np.int64(-5), lambda: np.datetime64("2020-01-01"), lambda: times.astype("f2"),
        lambda: times.reshape(5, 8), lambda: np.full(40, np.nan), lambda: material, lambda: fitted,
        lambda: times.astype(">f8"), lambda: np.broadcast_to(1.0, 40), lambda: {"time_s": times, "modulus_Pa": moduli[:-1]},
    ])()


def drawn(function, arguments, words):
    arguments, words = list(arguments), dict(words)
    for _ in range(rng.randint(1, 3)):
        place = rng.randint(0, len(arguments) + len(words))
        if place < len(arguments):
            if isinstance(arguments[place], dict) and arguments[place] and rng.random() < 0.7:  # one column of a table
                table = dict(arguments[place])
                table[rng.choice(list(table))] = odd()
                arguments[place] = table
            else:
                arguments[place] = odd()
        elif words and place < len(arguments) + len(words):
            words[rng.choice(list(words))] = odd()
        else:
            words[rng.choice(["column", "kind", "time_zero", "plausible", "geometry", "folder", "tol", "out", "x"])] = odd()
    return arguments, words


ALLOWED = (ValueError, TypeError, OSError, RuntimeError, MemoryError, viscard.Error)
end, n = time.monotonic() + seconds, 0
while time.monotonic() < end:
    function, *good = rng.choice(GOOD)
    arguments, words = drawn(function, *good)
    words.pop("progress", None)
    print(f"{function.__qualname__} {arguments!r:.600} {words!r:.600}".replace("\n", " ").encode("ascii", "backslashreplace").decode(), flush=True)
    faulthandler.dump_traceback_later(CALL_LIMIT_S, exit=True)
    try:
        function(*arguments, **words)
    except ALLOWED as error:
        if not str(error) or type(error) is RecursionError:
            raise SystemExit(f"{type(error).__name__} without a text") from error
    faulthandler.cancel_dump_traceback_later()
    n += 1
print(f"Done {n} runs")
