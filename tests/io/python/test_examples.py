"""The example scripts, and the Python block of the README."""
import csv
import pathlib
import re
import subprocess
import sys

import pytest

import viscard


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
