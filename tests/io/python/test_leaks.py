"""Calls leave nothing behind: neither objects of Python nor memory of the compiled part.

VISCARD_CALLS=10000 makes that many calls of each kind; ctest does so in a test with the label slow.
"""
import gc
import os
import pickle

import numpy as np
import pytest

import viscard

pytestmark = pytest.mark.filterwarnings("ignore::viscard.DoubtWarning")  # tables of 40 rows
CALLS = int(os.environ.get("VISCARD_CALLS", "60"))
T = np.geomspace(0.01, 100.0, 40)
PDMS = viscard.Material(1e6, 0.49, terms=[(0.2, 1.0), (0.1, 10.0)])
TABLE = {"time_s": T, "modulus_Pa": PDMS.relaxation(T) * np.random.default_rng(1).normal(1.0, 1e-3, T.size)}
S = np.linspace(1.1, 2.0, 12)
RUBBER = {"stretch": S, "nominal_stress_Pa": 4e5 * (S - S**-2) * np.random.default_rng(2).normal(1.0, 1e-3, S.size)}
FIT = viscard.fit(TABLE, terms=2)
SCENE = {"tolerance": 1e-1, "geometry": {"diameter": 40e-6, "length": 120e-6}, "materials": {"pillar": {"E": 1e6, "nu": 0.3, "rho": 965.0}},
         "analysis": {"kind": "static", "load": {"pressure": 1e3, "on": "top"}}}


def refused():
    with pytest.raises(viscard.Error):
        viscard.fit({"time_s": T, "modulus_Pa": -T})


WORK = {
    "fit": lambda: viscard.fit(TABLE, terms=2), "rubber": lambda: viscard.fit({"uniaxial": RUBBER}, model="neo-hooke"),
    "values of a fit": lambda: (viscard.fit(TABLE, terms=2).values, FIT.summary()), "curve": lambda: PDMS.storage(T, band=True),
    "predict": lambda: viscard.predict(PDMS, against=TABLE).values, "card": lambda: PDMS.card("abaqus"),
    "pickle": lambda: pickle.loads(pickle.dumps(FIT)), "material": lambda: pickle.loads(pickle.dumps(PDMS)),
    "simulate": lambda: viscard.simulate(SCENE), "refused": refused, "html": FIT._repr_html_,
    "callback": lambda: viscard.fit(TABLE, terms=2, progress=lambda done, step: None)}


def resident_B():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


@pytest.mark.parametrize("name", WORK)
def test_calls_leave_nothing_behind(name):
    work = WORK[name]
    calls = CALLS if name not in ("simulate", "rubber") else CALLS // 3
    for _ in range(calls // 3):  # caches, and memory that the allocator keeps
        work()
    gc.collect()
    objects, memory_B = len(gc.get_objects()), resident_B()
    for _ in range(calls):
        work()
    gc.collect()
    # An object, or 2 kB, for each call would be a leak; a table of 40 rows alone is 640 bytes, a result many kB.
    assert len(gc.get_objects()) - objects < calls / 10 + 20
    assert resident_B() - memory_B < 2000 * calls + 500_000


def test_a_leak_would_be_seen():
    kept = []
    memory_B = resident_B()
    for _ in range(CALLS):
        kept.append(viscard.fit(TABLE, terms=2))
        kept[-1].values
    assert resident_B() - memory_B > 2000 * CALLS + 500_000
