"""What a type checker sees: the module, the examples, the kinds of results, and mistakes in keywords."""
import re
import subprocess
import sys

import pytest

import viscard
from test_examples import EXAMPLES, code_cells

CONFIG = """
[mypy]
python_version = 3.11
strict = True
enable_incomplete_feature = Unpack
[mypy-matplotlib.*,pandas.*]
ignore_missing_imports = True
"""


@pytest.fixture(scope="module")
def mypy(tmp_path_factory):
    """What mypy --strict prints about files or the package, with a cache that the tests share."""
    pytest.importorskip("mypy", reason="needs the package mypy")
    folder = tmp_path_factory.mktemp("mypy")
    (folder / "mypy.ini").write_text(CONFIG)

    def check(*words):
        found = subprocess.run([sys.executable, "-m", "mypy", "--config-file", str(folder / "mypy.ini"), "--cache-dir",
                                str(folder / "cache"), *map(str, words)], capture_output=True, text=True, cwd=folder,
                               env={"MYPYPATH": viscard.__path__[0].rsplit("/", 1)[0]})
        return found.stdout + found.stderr

    return check


def test_the_module_is_typed_strictly(mypy):
    assert "Success: no issues" in mypy("-p", "viscard")


def test_the_examples_pass(mypy, tmp_path):
    notebooks = []
    for path in sorted(EXAMPLES.glob("*.ipynb")):
        notebooks.append(tmp_path / f"{path.stem}.py")
        notebooks[-1].write_text("\n".join(code_cells(path.stem)) + "\n")
    scripts = sorted(EXAMPLES.glob("*.py"))
    assert len(notebooks) >= 3 and len(scripts) >= 2
    for file in notebooks + scripts:  # apart, because two may have a function of one name
        assert "Success: no issues" in mypy(file), file


REVEALED = [
    ('viscard.fit("a.csv")', "FitResult"),
    ('viscard.fit({"time_s": t, "modulus_Pa": t})', "FitResult"),
    ('viscard.fit(viscard.read_table("a.csv"))', "FitResult"),
    ('viscard.fit({"relaxation": {"time_s": t, "modulus_Pa": t}, "creep": "b.csv"})', "FitResult"),
    ('viscard.fit({"uniaxial": {"stretch": t, "nominal_stress_Pa": t}})', "RubberFit"),
    ('viscard.fit(["a.csv", "b.csv"])', "list[viscard._fit_result.FitResult]"),
    ('viscard.fit(["a.csv"], errors="return")', "list[Union[viscard._fit_result.FitResult, viscard._error.Error]]"),
    ('viscard.fit(["a.csv", "b.csv"], joint=True, ratio=[10, 20])', "JointFit"),
    ('viscard.Material(1e6, 0.4).relaxation(0.1)', "builtins.float"),
    ('viscard.Material(1e6, 0.4).creep([0.1, 1.0])', "numpy.ndarray"),
    ('viscard.Material(1e6, 0.4).storage(t, band=True)', "Tuple[numpy.ndarray"),
    ('viscard.simulate("a.toml").modes[0]["frequency_Hz"]', "builtins.float"),
    ('viscard.sweep("a.toml", over={"geometry.diameter": t})["torsion 1"]', "numpy.ndarray"),
    ('viscard.predict("a.json", against={"time_s": t, "modulus_Pa": t})', "Prediction"),
]


def test_the_kind_of_result_follows_from_the_arguments(mypy, tmp_path):
    lines = ["import numpy as np", "import viscard", "t = np.geomspace(0.1, 1.0, 9)"]
    (tmp_path / "kinds.py").write_text("\n".join(lines + [f"reveal_type({call})" for call, _ in REVEALED]) + "\n")
    found = re.findall(r'Revealed type is "(.*)"', mypy(tmp_path / "kinds.py"))
    assert len(found) == len(REVEALED)
    for kind, (call, expected) in zip(found, REVEALED):
        assert expected in kind, call


@pytest.mark.parametrize("call", ['viscard.fit("a.csv", max_term=3)', 'viscard.fit("a.csv", terms="three")',
                                  'viscard.predict("a.json", tests="creep")', 'viscard.simulate(3)',
                                  'viscard.Material(1e6)', 'viscard.simulate("a.toml").modes[0]["frequency"]'])
def test_a_mistake_is_found_before_the_program_runs(mypy, tmp_path, call):
    (tmp_path / "mistake.py").write_text(f"import viscard\n{call}\n")
    assert "mistake.py:2: error" in mypy(tmp_path / "mistake.py")
