"""The example scripts and notebooks, and the Python block of the README."""
import ast
import csv
import json
import pathlib
import re
import subprocess
import sys

import pytest

import viscard

EXAMPLES = pathlib.Path(__file__).parents[3] / "data/examples"


def run_script(name, folder):
    found = subprocess.run([sys.executable, f"data/examples/{name}.py", str(folder)], capture_output=True, text=True)
    assert found.returncode == 0, found.stderr
    return found.stdout


def is_png(path):
    return path.read_bytes().startswith(b"\x89PNG")


def test_a_campaign_of_ten_specimens(tmp_path):
    pytest.importorskip("matplotlib")
    printed = run_script("campaign", tmp_path)
    assert printed.startswith("10 specimens: E0 ") and is_png(tmp_path / "campaign.png")
    rows = list(csv.DictReader(open(tmp_path / "campaign.csv")))
    assert len(rows) == 10 and {row["terms"] for row in rows} == {"3"}
    E0 = [float(row["E0_MPa"]) for row in rows]
    assert sum(E0) / 10 == pytest.approx(1.88, rel=0.04)  # of ten that scatter by 4 %: 3 standard errors
    assert all(float(row["low_95"]) < float(row["E0_MPa"]) < float(row["high_95"]) for row in rows)


def test_a_design_study(tmp_path):
    pytest.importorskip("matplotlib")
    printed = run_script("design_study", tmp_path)
    assert "designs; most voltage" in printed and is_png(tmp_path / "study.png")
    rows = list(csv.DictReader(open(tmp_path / "study.csv")))
    assert len(rows) > 6
    # A slender cantilever bends at 1/L^2 (Euler-Bernoulli); a stubby one on a film is softer than that.
    of_40 = {row["length_um"]: float(row["bending_kHz"]) for row in rows if row["diameter_um"] == "40"}
    assert 1.5 < of_40["80"] / of_40["120"] < (120 / 80) ** 2


def code_cells(name):
    cells = json.loads((EXAMPLES / f"{name}.ipynb").read_text())["cells"]
    assert not any(cell.get("outputs") for cell in cells), "a notebook is kept without its outputs"
    return ["".join(cell["source"]) for cell in cells if cell["cell_type"] == "code"]


def shown(value):
    """What a notebook shows of a value."""
    return value._repr_html_() if hasattr(value, "_repr_html_") else repr(value)


def run_notebook(name):
    """Runs the cells in order, as Jupyter does: a cell that ends with an expression shows its value. Returns the
    names that the cells defined, and what they showed."""
    names, texts = {}, []
    for number, source in enumerate(code_cells(name), 1):
        tree = ast.parse(source, f"{name}, cell {number}")
        last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
        exec(compile(tree, f"{name}, cell {number}", "exec"), names)
        if last is not None:
            value = eval(compile(ast.Expression(last.value), f"{name}, cell {number}", "eval"), names)
            texts += [] if value is None else [shown(value)]
    return names, "\n".join(texts)


@pytest.fixture
def in_empty_folder(tmp_path, monkeypatch):
    pyplot = pytest.importorskip("matplotlib.pyplot")
    monkeypatch.chdir(tmp_path)
    yield tmp_path
    pyplot.close("all")


def test_the_notebook_from_a_csv_to_a_card(in_empty_folder):
    names, texts = run_notebook("csv_to_card")
    assert "E0_Pa" in texts and "*VISCOELASTIC" in (in_empty_folder / "pdms.inp").read_text().upper()
    kept = viscard.Material.load(in_empty_folder / "pdms.json")
    assert kept.E0_Pa == names["result"].E0_Pa == pytest.approx(1.88e6, rel=1e-3)  # stated in the file


def test_the_notebook_from_volts_to_the_voltage_of_a_sensor(in_empty_folder):
    names, _ = run_notebook("volts_to_sensor")
    low, high = names["result"].E0_combined_interval
    assert low < 1.88e6 < high  # the emulated specimen: data/demo/03_pdms_1to10.truth.toml
    truth = viscard.Material(1.88e6, names["result"].material.nu, terms=[(0.008206, 0.1945), (0.01386, 2.403)])
    scene = {**names["scene"], "materials": {**names["scene"]["materials"], "pillar": truth}}
    low, high = names["voltage"]["interval_95"]
    assert low < viscard.simulate(scene)["electrode_voltage"] < high
    assert sum(names["voltage"]["shares"].values()) == pytest.approx(1.0, abs=0.05)


def test_the_notebook_on_the_rubber_of_treloar(in_empty_folder):
    names, texts = run_notebook("rubber_of_treloar")
    assert 0.9e6 < names["rubber"].E0_Pa < 1.5e6  # Treloar's rubber: G about 0.4 MPa
    measured = names["measured"]
    together, alone = (abs(law.stress(measured["stretch"], "equibiaxial") - measured["nominal_stress_Pa"]).max() /
                       measured["nominal_stress_Pa"].max() for law in (names["rubber"], names["alone"]))
    assert together < 0.1 < alone  # a law from one way of stretching is no law of another
    assert (in_empty_folder / "treloar.feb").exists()


def test_a_touch_read_back(tmp_path):
    pytest.importorskip("matplotlib")
    printed = run_script("pressure_map", tmp_path)
    inside = float(re.search(r"; ([\d.]+) % of the pressures lie within", printed)[1])
    assert 92.0 < inside < 98.0 and "resolution 50 um" in printed and is_png(tmp_path / "pressure_map.png")


def blocks(path):
    return re.findall(r"```python\n(.*?)```", pathlib.Path(path).read_text(), re.S)


@pytest.mark.parametrize("path", ["README.md", "io/python/README.md"])
def test_the_python_blocks_of_the_documents_run(path, tmp_path, monkeypatch):
    found = blocks(path)
    assert found
    monkeypatch.chdir(tmp_path)  # an empty folder
    for block in found:
        exec(compile(block, path, "exec"), {})


def test_the_table_of_functions_names_all():
    text = pathlib.Path("io/python/README.md").read_text()
    assert not [name for name in viscard.__all__ if f"`{name}" not in text]
