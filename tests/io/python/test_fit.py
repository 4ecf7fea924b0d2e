"""Fits in Python equal those of the command line."""
import inspect
import json
import os
import re
import subprocess
import warnings

import numpy as np
import pytest

import viscard

EXAMPLE = "data/demo/example_relaxation.csv"


def of_program(program, *words):
    # doctest loads readline, which tells child processes a width.
    found = subprocess.run([program, *words], capture_output=True, text=True, env={**os.environ, "COLUMNS": ""})
    return found.stdout


def keys_of_result(printed):
    """Without the files that the command has read."""
    return {key: value for key, value in json.loads(printed).items() if key != "input_files"}


def test_a_fit_equals_the_command_line(program):
    result = viscard.fit(EXAMPLE)
    assert result.json == keys_of_result(of_program(program, "fit", EXAMPLE, "--json"))
    assert result.summary() == of_program(program, "fit", EXAMPLE)


def test_options_have_the_same_effect(program):
    result = viscard.fit(EXAMPLE, terms=1, noise="white", full_data=True, from_="0.1 s", to=50)
    printed = of_program(program, "fit", EXAMPLE, "--terms", "1", "--noise", "white", "--full-data",
                         "--from", "0.1 s", "--to", "50", "--json")
    assert result.json == keys_of_result(printed)


def test_every_option_of_the_command_is_a_keyword(program):
    options = set(re.findall(r"^  (?:-\w \[ )?--([a-z-]+)", of_program(program, "fit", "--help"), re.M))
    options -= {"help", "json", "out", "force", "version", "color", "strip-paths", "svg", "csv"}
    options -= {"want", "show-table", "curves"}  # what the program alone prints; here they are attributes
    names = {"from_" if one == "from" else one.replace("-", "_") for one in options}
    assert names <= set(inspect.signature(viscard.fit).parameters)
    assert {"terms", "from_", "punch_diameter", "share"} <= names


def test_every_option_of_predict_is_a_keyword(program):
    options = set(re.findall(r"^  (?:-\w \[ )?--([a-z-]+)", of_program(program, "predict", "--help"), re.M))
    options -= {"help", "json", "force", "csv", "svg", "accept-flags", "version", "color", "strip-paths"}
    names = {"from_" if one == "from" else one.replace("-", "_") for one in options}
    assert names <= set(inspect.signature(viscard.predict).parameters)


def test_arrays_give_the_fit_of_the_same_numbers_in_a_file(tmp_path, relaxation):
    time_s, modulus_Pa = relaxation
    path = tmp_path / "t.csv"
    np.savetxt(path, np.column_stack([time_s, modulus_Pa]), delimiter=",", header="time_s,modulus_Pa",
               comments="", fmt="%.17g")
    of_file, of_arrays = viscard.fit(path), viscard.fit({"time_s": time_s, "modulus_Pa": modulus_Pa})
    assert of_arrays.E0 == of_file.E0
    np.testing.assert_array_equal(of_arrays.tau_s, of_file.tau_s)
    np.testing.assert_array_equal(of_arrays.covariance, of_file.covariance)
    in_ms = viscard.fit({"Time [ms]": time_s * 1e3, "E [kPa]": modulus_Pa / 1e3}, column="modulus_Pa=E")
    assert in_ms.E0 == pytest.approx(of_file.E0, rel=1e-9)


def test_intervals_and_arrays_have_their_shapes(relaxation):
    result = viscard.fit({"time_s": relaxation[0], "modulus_Pa": relaxation[1]})
    assert result.g.shape == result.tau_s.shape == result.moduli.shape == (1,)
    assert result.g_interval.shape == (1, 2) and result.covariance.shape == (3, 3)
    assert result.E0_interval[0] < 1.5e6 < result.E0_interval[1]
    assert result.tau_interval_s[0, 0] < 2.0 < result.tau_interval_s[0, 1]
    se = np.sqrt(result.covariance[result.covariance_parameters.index("E_inf_Pa")][0])
    assert result.E_inf_interval[0] == pytest.approx(result.E_inf - 1.96 * se, rel=1e-3)
    assert result.curves["at"].shape == result.curves["fitted"].shape


def test_a_list_gives_a_list_and_a_bad_file_does_not_stop_the_others(tmp_path):
    bad = tmp_path / "bad.csv"
    bad.write_text("a,b\n1,x\n")
    seen = []
    results = viscard.fit([EXAMPLE, bad], errors="return", progress=lambda done, file: seen.append(done))
    assert results[0].E0 > 0 and isinstance(results[1], viscard.Error) and str(bad) in str(results[1])
    assert seen[-1] == 1.0
    with pytest.raises(viscard.Error, match="bad.csv"):
        viscard.fit([EXAMPLE, bad])
    assert len(viscard.fit([EXAMPLE])) == 1


def test_tests_of_one_material_are_fitted_together(tmp_path, relaxation):
    time_s, modulus_Pa = relaxation
    compliance = viscard.Material(1.5e6, 0.495, terms=[(1 / 3, 2.0)]).creep(time_s)
    noise = 1 + 1e-3 * np.random.default_rng(2).standard_normal(time_s.size)
    for name, column, values in (("a", "modulus_Pa", modulus_Pa), ("b", "compliance_1_Pa", compliance * noise)):
        np.savetxt(tmp_path / f"{name}.csv", np.column_stack([time_s, values]), delimiter=",",
                   header=f"time_s,{column}", comments="")
    result = viscard.fit([f"relaxation={tmp_path}/a.csv", f"creep={tmp_path}/b.csv"])
    assert result["kind"] == "several" and len(result["tests"]) == 2
    assert result.E0_Pa == pytest.approx(1.5e6, rel=2e-3)
    assert viscard.fit(f"relaxation={tmp_path}/a.csv")["kind"] == "relaxation"


def test_a_result_that_is_not_to_be_trusted_warns():
    time_s = np.geomspace(0.01, 100.0, 200)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        result = viscard.fit({"time_s": time_s, "modulus_Pa": 1e6 + 1e5 * np.log10(time_s)})  # rises
    assert result.is_trustworthy == (not [w for w in caught if w.category is viscard.DoubtWarning])
    assert not result.is_trustworthy


def test_a_stiffness_has_no_modulus(relaxation):
    result = viscard.fit({"time_s": relaxation[0], "force_N": relaxation[1] * 1e-6}, depth="0.1 mm")
    assert result.unit == "N/m" and result.E0 == pytest.approx(1.5e4, rel=0.01)
    with pytest.raises(viscard.Error, match="punch_diameter"):
        result.E0_Pa
    with pytest.raises(viscard.Error):
        result.material


def test_a_joint_fit_gives_the_law(ratio_files, tmp_path):
    joint = viscard.fit(ratio_files, joint=True, ratio=[10, 13, 20])
    for ratio in (10, 13, 20):
        assert joint.material(ratio).E0_Pa == pytest.approx(2e7 / ratio, rel=3e-3)
    assert 2e7 / 13 > joint.material(15).E0_Pa > 2e7 / 20
    with pytest.raises(viscard.Error, match="extrapolat"):
        joint.material(40)
    joint.save(tmp_path / "joint.json")
    assert json.loads((tmp_path / "joint.json").read_text()) == joint.json
    with pytest.raises(viscard.Error, match="there are 3 files and 2 ratio"):
        viscard.fit(ratio_files, joint=True, ratio=[10, 13])


def test_a_capture_is_fitted(run):
    result = viscard.fit(viscard.read_capture(run))
    assert result["kind"] == "indentation" and result.E0_Pa == pytest.approx(1.88e6, rel=0.02)


def test_plots_of_results(relaxation):
    plt = pytest.importorskip("matplotlib.pyplot")
    result = viscard.fit({"time_s": relaxation[0], "modulus_Pa": relaxation[1]})
    axes = result.plot(label="one")
    assert axes.get_ylabel() == "modulus (MPa)" and axes.get_xscale() == "log"
    assert len(axes.lines) == 2
    assert result.plot(ax=axes, color="C3") is axes and len(axes.lines) == 4
    plt.close("all")


def test_values_are_those_of_json_as_arrays_and_a_key_is_found_where_it_stands():
    result = viscard.fit(EXAMPLE, profiles=True)
    json.dumps(result.json)
    assert result.find("E0_Pa") == result["E0_Pa"] == result.E0_Pa
    assert result.find("E0_interval_95") == tuple(result["E0_interval_95"])
    assert result.find("terms.1.tau_s") == result["terms"][1]["tau_s"]
    assert result.find("inflation") == result["noise"]["inflation"]  # stands below
    profile = result.find("profiles.0.value")
    assert isinstance(profile, np.ndarray) and profile.tolist() == result["profiles"][0]["value"]
    assert "covariance" not in result.json and result.values["covariance"].shape == (5, 5)
    for name, says in (("E0_kPa", "there is no"), ("sigma", "in 2 places"), ("terms.9.tau_s", "'9' is missing"),
                       ("terms.0.E0", "'E0' is missing")):
        with pytest.raises(KeyError, match=says):
            result.find(name)
