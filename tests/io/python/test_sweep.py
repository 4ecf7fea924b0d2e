"""Scenes at many values of their parameters."""
import csv
import io
import pathlib
import subprocess

import numpy as np
import pytest

import viscard

STUDY = "data/studies/pillar.toml"


@pytest.fixture(scope="session")
def study(tmp_path_factory):
    """The same study of a scene with a wide tolerance, which takes a tenth of the time."""
    folder, data = tmp_path_factory.mktemp("study"), pathlib.Path(__file__).parents[3] / "data"
    scene = (data / "scenes/pillar_press.toml").read_text().replace("../materials", str(data / "materials"))
    (folder / "scene.toml").write_text(scene.replace("tolerance = 1e-3", "tolerance = 5e-2"))
    path = folder / "study.toml"
    path.write_text((data / "studies/pillar.toml").read_text().replace("../scenes/pillar_press.toml", "scene.toml"))
    return str(path)


def test_a_sweep_has_the_rows_of_the_command_line(program, study, tmp_path):
    table = tmp_path / "study.csv"
    subprocess.run([program, "sweep", study, "--out", str(tmp_path / "a.sqlite"), "--csv", str(table)], check=True,
                   capture_output=True)
    rows = list(csv.DictReader(io.StringIO(table.read_text())))
    found = viscard.sweep(study)
    assert (len(found), found.n_points, found.n_answered) == (len(rows), 9, 9)
    assert found.parameters["geometry.diameter"] == [row["geometry.diameter"] for row in rows]
    assert list(found["electrode_voltage"]) == [float(row["electrode_voltage [V]"]) for row in rows]
    assert np.allclose(found.results["electrode_voltage"]["error"],
                       [float(row["error electrode_voltage [V]"]) for row in rows], rtol=1e-2)
    again = viscard.sweep(study, tmp_path / "a.sqlite")  # the file of the program
    assert again.n_answered == 0 and list(again["top_force"]) == list(found["top_force"])


def test_parts_are_merged(study, tmp_path):
    parts = [tmp_path / f"{i}.sqlite" for i in (1, 2)]
    for i, part in enumerate(parts):
        assert viscard.sweep(study, part, shard=f"{i + 1}/2").n_answered == (5, 4)[i]
    whole = viscard.sweep(study, tmp_path / "whole.sqlite", merge=parts)
    assert (whole.n_merged, whole.n_answered, list(whole.point)) == (9, 0, list(range(9)))


def test_an_interrupted_sweep_continues(tmp_path):
    def stop(fraction, step):
        assert 0.0 < fraction <= 1.0 and step == "sweep"
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        viscard.sweep(STUDY, tmp_path / "a.sqlite", progress=stop)
    rest = viscard.sweep(STUDY, tmp_path / "a.sqlite")
    assert 1 <= rest.n_answered < 9 and len(rest) == 9


def test_a_point_without_an_answer_is_nan_with_its_reason(tmp_path):
    scene = pathlib.Path("data/scenes/pillar_press.toml").resolve()
    study = tmp_path / "study.toml"
    study.write_text(f'scene = "{scene}"\n[[parameter]]\nkey = "materials.pillar.nu"\nvalues = ["0.33", "-1"]\n')
    found = viscard.sweep(study)
    assert np.isfinite(found["electrode_voltage"]).tolist() == [True, False]
    assert found.failures[0] == "" and "Poisson ratio is -1" in found.failures[1] and "1 without an answer" in repr(found)
    with pytest.raises(KeyError, match="voltage2"):
        found["voltage2"]


def test_mistakes_have_the_words_of_the_command_line(program, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # messages name the folder
    (tmp_path / "study.toml").write_text("points = 3\n")
    for words, call in ((["nothing.toml"], lambda: viscard.sweep("nothing.toml")),
                        ([str(tmp_path / "study.toml")], lambda: viscard.sweep(tmp_path / "study.toml"))):
        printed = subprocess.run([program, "sweep", *words], capture_output=True, text=True, cwd=tmp_path).stderr
        with pytest.raises(viscard.Error) as caught:
            call()
        assert str(caught.value) == printed.removeprefix("viscard: ").rstrip("\n")
    with pytest.raises(viscard.Error, match="shard is '4/3'; write it like 3/64") as caught:
        viscard.sweep(STUDY, shard="4/3")
    assert caught.value.code == "usage"
    with pytest.raises(viscard.Error, match="leave shard out"):
        viscard.sweep(STUDY, tmp_path / "a.sqlite", shard="1/3", merge="b.sqlite")
    with pytest.raises(TypeError, match="shard must be a text"):
        viscard.sweep(STUDY, shard=3)
