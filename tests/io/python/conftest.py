"""What the tests of the Python module share."""
import os
import pathlib

import numpy as np
import pytest

import viscard

ROOT = pathlib.Path(__file__).parents[3]
SHORT_TEST = """
[approach]
speed = "0.2 mm/s"
limit = "5 mm"
contact_force = "10 mN"
gap = "20 um"
baseline = "2 s"
[ramp]
depth = "0.1 mm"
duration = "1 s"
hold = "5 s"
[recovery]
unload_to_fraction = 0.1
unload_speed = "4 mm/s"
hold = "2 s"
[retract]
speed = "1 mm/s"
distance = "0.5 mm"
"""


@pytest.fixture(autouse=True)
def in_source_folder(monkeypatch):
    monkeypatch.chdir(ROOT)


@pytest.fixture(scope="session")
def short_test(tmp_path_factory):
    """A test file of some seconds for the emulated rig."""
    path = tmp_path_factory.mktemp("test") / "short.toml"
    path.write_text(SHORT_TEST)
    return str(path)


@pytest.fixture(scope="session")
def run(tmp_path_factory, short_test):
    """A capture of the emulated rig."""
    path = str(tmp_path_factory.mktemp("run") / "run.viscap")
    viscard.capture(path, test=short_test, emulate=True, speed=200, seed=3)
    return path


@pytest.fixture(scope="session")
def ratio_files(tmp_path_factory):
    """Tables of E(t) with E0 = 20 MPa/ratio at the mixing ratios 10, 13 and 20, noise of 0.1 %."""
    folder, random = tmp_path_factory.mktemp("ratios"), np.random.default_rng(4)
    time_s, paths = np.geomspace(0.01, 100.0, 300), []
    for ratio in (10, 13, 20):
        pdms = viscard.Material(2e7 / ratio, 0.495, terms=[(0.1, 0.5), (0.1, 8.0)])
        modulus_Pa = pdms.relaxation(time_s) * random.normal(1.0, 1e-3, time_s.size)
        paths.append(str(folder / f"1to{ratio}.csv"))
        np.savetxt(paths[-1], np.column_stack([time_s, modulus_Pa]), delimiter=",", header="time_s,modulus_Pa",
                   comments="")
    return paths


@pytest.fixture
def relaxation():
    """E(t) = 1 MPa + 0.5 MPa exp(-t/2 s) with noise of 1 kPa: time_s, modulus_Pa."""
    time_s = np.geomspace(0.01, 100.0, 400)
    noise = 1e3 * np.random.default_rng(1).standard_normal(time_s.size)
    return time_s, 1e6 + 5e5 * np.exp(-time_s / 2.0) + noise


@pytest.fixture(scope="session")
def program():
    """The command line program, if it was built."""
    path = os.path.join(os.environ.get("VISCARD_BUILD", ""), "viscard")
    if not os.path.exists(path):
        pytest.skip("the program viscard was not built")
    return path
