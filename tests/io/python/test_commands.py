"""What other commands do, from Python: beside the command line."""
import json
import subprocess

import numpy as np
import pytest

import viscard

SEED = "data/materials/pdms_1to10_seed.json"


def printed(program, *words):
    found = subprocess.run([program, *words], capture_output=True, text=True)
    assert found.returncode == 0, found.stderr
    return found.stdout


def test_validate_is_the_command(program):
    found = viscard.Material.load(SEED).validate()
    of_command = json.loads(printed(program, "validate", SEED, "--json"))
    assert found.passed and found.json["unknowns"] == of_command["unknowns"]
    assert {key: found.json[key] for key in ("creep", "relaxation", "max_error")} == {
        key: of_command[key] for key in ("creep", "relaxation", "max_error")}
    off = found.relaxation["stress_Pa"] / found.relaxation["exact_stress_Pa"] - 1
    assert np.abs(off).max() == pytest.approx(found.relaxation["largest_relative_error"])
    assert not viscard.Material.load(SEED).validate(max_error=1e-15).passed
    for wrong in (0, 1, 2, 1e9):
        with pytest.raises(viscard.Error, match=r"max_error is .*; it must lie between 0 and 1"):
            viscard.Material.load(SEED).validate(max_error=wrong)


def test_export_is_the_command(program, run, tmp_path):
    viscard.read_capture(run).save(tmp_path / "run.csv")
    assert (tmp_path / "run.csv").read_text() == printed(program, "export", run)
    with pytest.raises(viscard.Error) as refused:
        viscard.read_capture(run).save(tmp_path / "run.csv")
    assert refused.value.code == "exists"


def test_a_scene_is_checked_without_being_solved(program, tmp_path):
    scene = "data/scenes/pillar_sensor.toml"
    assert viscard.check_scene(scene, svg=tmp_path / "python.svg") == "pillar"
    printed(program, "scene", "check", scene, "--svg", str(tmp_path / "command.svg"))
    assert (tmp_path / "python.svg").read_text() == (tmp_path / "command.svg").read_text()
    pillar = {"geometry": {"diameter": "40 um", "length": "120 um"}, "materials": {"pillar": {"E": "1 MPa", "nu": 0.3}}}
    assert viscard.check_scene({**pillar, "analysis": {"kind": "static", "load": {"pressure": "1 kPa", "on": "top"}}}) == "pillar"
    with pytest.raises(viscard.Error, match="needs the density"):
        viscard.check_scene({**pillar, "analysis": {"kind": "modal"}})


def test_what_to_measure_next_is_the_command(program, run):
    found = viscard.next_test(run, ["E0=1%"])
    of_command = json.loads(printed(program, "fit", run, "--want", "E0=1%", "--json"))["next"]["measurements"]
    assert [one["what"] for one in found] == [one["what"] for one in of_command]
    assert found[0]["half_width_95_after"] == of_command[0]["half_width_95_after"] < found[0]["half_width_95"]
    assert viscard.next_test(viscard.read_capture(run), "E0=1%") == found
    with pytest.raises(viscard.Error, match="E0"):
        viscard.next_test(run, "E0")


def test_the_report_is_the_command(program, run, tmp_path):
    viscard.report([run, SEED], tmp_path / "python.html", title="A & B", cards="febio", reproducible=True)
    printed(program, "report", run, SEED, "--out", str(tmp_path / "command.html"), "--title", "A & B", "--card", "febio",
            "--reproducible")
    pages = [(tmp_path / name).read_text().splitlines() for name in ("python.html", "command.html")]
    differ = [one for one, other in zip(*pages) if one != other]
    assert len(pages[0]) == len(pages[1]) and all("sha256" in line or "report" in line for line in differ)  # by whom
    with pytest.raises(viscard.Error) as refused:
        viscard.report(SEED, tmp_path / "python.html")
    assert refused.value.code == "exists"
    with pytest.raises(viscard.Error, match="'abacus'"):
        viscard.report(SEED, tmp_path / "other.html", cards="abacus")
    with pytest.raises(viscard.Error, match="2 truth files for 1 capture: give one truth for each"):
        viscard.report([run, SEED], tmp_path / "other.html", truth=["a.json", "b.json"])
    with pytest.raises(TypeError, match="truth must be a path or a list of paths, not 3"):
        viscard.report(SEED, tmp_path / "other.html", truth=3)
    arrays = {"time_s": [1.0, 2.0], "modulus_Pa": [2.0, 1.0]}
    for no_file in (arrays, [SEED, arrays], viscard.Material.load(SEED)):
        with pytest.raises(TypeError, match=r"^data.* must be a path(,| or) a Capture.*; save arrays and materials to a file"):
            viscard.report(no_file, tmp_path / "other.html")
    with pytest.raises(viscard.Error, match="data is empty; give at least one file"):
        viscard.report([], tmp_path / "other.html")
    assert not (tmp_path / "other.html").exists()


def test_pictures_of_a_report_are_files_too(program, tmp_path):
    viscard.report(SEED, tmp_path / "python.html", pictures=tmp_path / "python", unverified=True)
    printed(program, "report", SEED, "--out", str(tmp_path / "command.html"), "--pictures", str(tmp_path / "command"))
    names = sorted(one.name for one in (tmp_path / "command").iterdir())
    assert names and sorted(one.name for one in (tmp_path / "python").iterdir()) == names
    for name in names:
        assert (tmp_path / "python" / name).read_text() == (tmp_path / "command" / name).read_text()


def test_calibrations_of_readings_are_the_command(program, tmp_path):
    mass_kg = np.array([0, 0.05, 0.1, 0.2, 0.1, 0.05, 0, 0.05, 0.1, 0.2, 0.1, 0.05, 0])
    cell = {"mass_kg": mass_kg, "volts_V": 0.014 + 7.1 * mass_kg + 2e-5 * np.cos(np.arange(mass_kg.size))}
    block = {"position_m": np.linspace(0, 3e-5, 7), "force_N": np.linspace(0, 0.31, 7) + 1e-4 * np.cos(np.arange(7))}
    for words, data, keywords in ((["--capacity", "250 gf", "--gravity", "9.81 m/s2"], cell,
                                   {"capacity": "250 gf", "gravity": 9.81}),
                                  (["--compliance", "--id", "steel"], block, {"compliance": True, "id": "steel"})):
        table, record = tmp_path / "table.csv", tmp_path / "record.toml"
        table.write_text(",".join(data) + "\n" + "\n".join(",".join(map(repr, map(float, row))) for row in zip(*data.values())))
        of_command = json.loads(printed(program, "calibrate", "--data", str(table), "--out", str(record), "--force", "--json", *words))
        del of_command["input_files"]  # of what the program read
        for given in (data, table, viscard.read_table(table)):
            found = viscard.calibrate(given, **keywords)
            assert {**found.json, "file": str(record), "inputs": [str(table)]} == of_command
            assert found.record == record.read_text()
        with pytest.raises(viscard.Error) as refused:
            found.save(record)
        assert refused.value.code == "exists"
    with pytest.raises(viscard.Error, match="capacity is missing"):
        viscard.calibrate(cell)
    less = {name: np.delete(values, 4) for name, values in cell.items()}
    gap = {**cell, "volts_V": np.where(np.arange(mass_kg.size) == 4, np.nan, cell["volts_V"])}
    found = viscard.calibrate(gap, capacity="250 gf")  # what is missing leaves its row out
    assert found["gain_V_N"] == viscard.calibrate(less, capacity="250 gf")["gain_V_N"]
    assert found.rows_left_out == 1 and "1 row without a number" in found._repr_html_()
    with pytest.raises(viscard.Error, match="above the capacity"):
        viscard.calibrate(cell, capacity="0.1 N")
    with pytest.raises(viscard.Error, match="gravity 1.6 m/s2 does not occur on Earth"):
        viscard.calibrate(cell, capacity="250 gf", gravity=1.6)
