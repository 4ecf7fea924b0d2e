"""Arrays and tables in the place of files, and what is missing in them."""
import numpy as np
import pytest

import viscard

pandas = pytest.importorskip("pandas", reason="needs the package python3-pandas")

T = np.geomspace(0.01, 100.0, 120)
RANDOM = np.random.default_rng(3)
PDMS = viscard.Material(1.5e6, 0.495, terms=[(0.2, 0.5), (0.1, 8.0)])
E = PDMS.relaxation(T) * RANDOM.normal(1.0, 1e-3, T.size)
J = PDMS.creep(T) * RANDOM.normal(1.0, 1e-3, T.size)
S = np.linspace(1.05, 2.0, 30)
RUBBER = {kind: np.column_stack([S, C]) for kind, C in (("uniaxial", 4e5 * (S - S**-2)), ("planar", 4e5 * (S - S**-3)))}


def written(path, header, *columns):
    np.savetxt(path, np.column_stack(columns), delimiter=",", header=header, comments="", fmt="%.17g")
    return str(path)


def same(one, other):
    """Equal in all numbers of a fit; their files have other names."""
    return one.parameters == other.parameters and one.json["n_samples"] == other.json["n_samples"]


def test_tests_of_one_material_by_kind(tmp_path):
    files = {"relaxation": written(tmp_path / "e.csv", "time_s,modulus_Pa", T, E),
             "creep": written(tmp_path / "j.csv", "time_s,compliance_1_Pa", T, J)}
    arrays = viscard.fit({"relaxation": {"time_s": T, "modulus_Pa": E},
                          "creep": pandas.DataFrame({"time_s": T, "compliance_1_Pa": J})})
    assert same(arrays, viscard.fit(files)) and same(arrays, viscard.fit([f"{k}={v}" for k, v in files.items()]))
    assert arrays.file == "relaxation + creep" and arrays.material.json["provenance"].get("raw_files", []) == []
    twice = viscard.fit({"relaxation": [files["relaxation"], {"time_s": T, "modulus_Pa": 1.001 * E}]})
    assert len(twice.json["tests"]) == 2
    with pytest.raises(viscard.Error, match="there is no kind of test 'creeep'; did you mean 'creep'"):
        viscard.fit({"creeep": {"time_s": T, "compliance_1_Pa": J}})


def test_tests_of_rubber(tmp_path):
    files = {kind: written(tmp_path / f"{kind}.csv", "stretch,nominal_stress_Pa", rows) for kind, rows in RUBBER.items()}
    arrays = {kind: {"stretch": rows[:, 0], "nominal_stress_Pa": rows[:, 1]} for kind, rows in RUBBER.items()}
    rubber = viscard.fit(arrays, model="neo-hooke")
    assert rubber.parameters["C10_Pa"].value == pytest.approx(2e5, rel=1e-9)  # P = 2 C10 (s - s^-2)
    assert rubber.parameters == viscard.fit(files, model="neo-hooke").parameters
    rubber.save(tmp_path / "law.json")
    loaded = viscard.RubberFit.load(tmp_path / "law.json")
    assert loaded.parameters == rubber.parameters and "sha256" not in str(
        [line for line in rubber.card("abaqus").text.splitlines() if "raw data" in line])


def test_a_list_of_tables(ratio_files):
    frames = [pandas.read_csv(path, float_precision="round_trip") for path in ratio_files]
    assert [one.file for one in viscard.fit(frames)] == ["arrays 1", "arrays 2", "arrays 3"]
    mixed = viscard.fit([ratio_files[0], frames[1], viscard.read_table(ratio_files[2])])
    for one, path in zip(mixed, ratio_files):
        assert same(one, viscard.fit(path))
    joint = viscard.fit(frames, joint=True, ratio=[10, 13, 20])
    of_files = viscard.fit(ratio_files, joint=True, ratio=[10, 13, 20])
    assert joint.law == of_files.law and joint.material(15).E0_Pa == of_files.material(15).E0_Pa


def test_a_prediction_beside_arrays(tmp_path):
    material = viscard.fit({"time_s": T, "modulus_Pa": E}).material
    path = written(tmp_path / "measured.csv", "time_s,modulus_Pa", T, E)
    found = viscard.predict(material, against={"time_s": T, "modulus_Pa": E})
    assert found.agreement == viscard.predict(material, against=path).agreement and found.agreement
    t = np.linspace(0.0, 5.0, 40)
    frame = pandas.DataFrame({"time_s": t, "strain": np.minimum(0.01 * t, 0.02)})
    path = written(tmp_path / "history.csv", "time_s,strain", t, frame["strain"])
    curves = [viscard.predict(material, history=one).curves["stress_Pa"] for one in (frame, path)]
    assert np.array_equal(*curves)


def test_histories_of_scenes(tmp_path):
    scene = {"tolerance": 1e-2, "geometry": {"diameter": 40e-6, "length": 120e-6}, "materials": {"pillar": PDMS},
             "analysis": {"kind": "creep", "history": [["0 s", "10 kPa"], ["5 s", "10 kPa"], ["10 s", "0 Pa"]]}}
    of_texts = viscard.simulate(scene).curves["top_displacement"]["value"]
    t, p = np.array([0.0, 5.0, 10.0]), np.array([1e4, 1e4, 0.0])
    for history in (np.column_stack([t, p]), {"time_s": t, "pressure_Pa": p}, pandas.DataFrame({"time_s": t, "pressure_Pa": p})):
        scene["analysis"] = {"kind": "creep", "history": history}
        assert np.array_equal(viscard.simulate(scene).curves["top_displacement"]["value"], of_texts)
    scene["analysis"] = {"kind": "creep", "history": {"time_s": t, "Pressure [kPa]": p}}
    with pytest.raises(viscard.Error, match="columns time_s and one more in SI"):
        viscard.simulate(scene)


PILLAR = {"tolerance": 1e-2, "geometry": {"diameter": "40 um", "length": "120 um"}, "materials": {"pillar": PDMS},
          "analysis": {"kind": "static", "load": {"pressure": "1 kPa", "on": "top"}}}


def test_a_sweep_over_arrays(tmp_path):
    diameters, lengths = np.array([36e-6, 44e-6]), np.array([100e-6, 120e-6])
    over = {"geometry.diameter": diameters, "geometry.length": lengths}
    grid = viscard.sweep(PILLAR, over=over)
    assert len(grid) == 4 and grid.parameters["geometry.diameter"][:2] == ["3.6e-05", "3.6e-05"]
    rows = viscard.sweep(PILLAR, over=pandas.DataFrame(over))
    assert np.array_equal(rows["top_displacement"], grid["top_displacement"][[0, 3]])
    one = {**PILLAR, "geometry": {"diameter": 44e-6, "length": 120e-6}}
    assert rows["top_displacement"][1] == viscard.simulate(one)["top_displacement"]
    out = tmp_path / "points.sqlite"
    assert viscard.sweep(PILLAR, out, over=over, shard="1/2").n_answered == 2
    assert viscard.sweep(PILLAR, out, over=over).n_answered == 2  # continued


def test_a_study_of_rows_needs_a_value_of_each_parameter_for_each_point(tmp_path):
    def study(*lines):
        (tmp_path / "study.toml").write_text("\n".join([f'scene = "{viscard.data_file("scenes/pillar_press.toml")}"', "rows = true", *lines]))
        return viscard.sweep(tmp_path / "study.toml")

    diameters = ['[[parameter]]', 'key = "geometry.diameter"', 'values = ["36 um", "40 um"]']
    assert len(study(*diameters, '[[parameter]]', 'key = "geometry.length"', 'values = ["100 um", "120 um"]')) == 2
    with pytest.raises(viscard.Error, match="'geometry.length' has 1 values and 'geometry.diameter' has 2"):
        study(*diameters, '[[parameter]]', 'key = "geometry.length"', 'values = ["100 um"]')
    with pytest.raises(viscard.Error, match=r"needs values = \[...\] with rows = true"):
        study(*diameters, '[[parameter]]', 'key = "geometry.length"', 'from = "1 um"', 'to = "2 um"', 'count = 2')


def test_closed_form_limits_at_arrays():
    lengths = np.array([60e-6, 120e-6, 600e-6])
    found = viscard.design(diameter="40 um", spacing="60 um", length=lengths)
    assert [one.admissible for one in found] == [True, True, False]
    assert found[1] == viscard.design(diameter="40 um", spacing="60 um", length=120e-6)
    with pytest.raises(viscard.Error, match="length has 3 values and diameter has 2"):
        viscard.design(diameter=[40e-6, 50e-6], spacing="60 um", length=lengths)


GAPS = [np.where(np.arange(120) % 10 == 0, np.nan, E), np.ma.masked_where(np.arange(120) % 10 == 0, E),
        np.where(np.arange(120) % 10 == 0, np.inf, E), [None if i % 10 == 0 else value for i, value in enumerate(E)],
        pandas.Series([pandas.NA if i % 10 == 0 else value for i, value in enumerate(E)], dtype="Float64"),
        pandas.Series(np.where(np.arange(120) % 10 == 0, np.nan, E))]


@pytest.mark.parametrize("modulus_Pa", GAPS)
def test_a_row_in_which_a_used_number_is_missing_is_left_out_and_counted(modulus_Pa):
    kept = np.arange(120) % 10 != 0
    fitted = viscard.fit({"time_s": T, "modulus_Pa": modulus_Pa, "note": np.ma.masked_all(120)})
    assert same(fitted, viscard.fit({"time_s": T[kept], "modulus_Pa": E[kept]}))
    assert fitted.json["n_left_out"] == 12
    found = viscard.predict(PDMS, against={"time_s": T, "modulus_Pa": modulus_Pa})
    assert "against: 12 rows without a number left out" in found.notes
    assert found.agreement[0]["n"] == 108


def test_missing_stretches_are_left_out_of_a_test_of_rubber():
    s = np.ma.masked_where(np.arange(30) == 4, S)
    rubber = viscard.fit({"uniaxial": {"stretch": s, "nominal_stress_Pa": RUBBER["uniaxial"][:, 1]}}, model="neo-hooke")
    assert len(rubber.tests[0][0]) == 29
    assert "1 row without a number left out" in " ".join(flag.text for flag in rubber.flags)


def test_what_is_prescribed_may_not_be_missing():
    t, p = np.array([0.0, 5.0]), np.ma.masked_equal([1e4, 0.0], 0.0)
    for history in ({"time_s": t, "pressure_Pa": p}, np.ma.column_stack([t, p])):
        with pytest.raises(viscard.Error, match="history is nan"):
            viscard.simulate({**PILLAR, "analysis": {"kind": "creep", "history": history}})
    with pytest.raises(viscard.Error, match="geometry.length is nan; it must be a finite number"):
        viscard.sweep(PILLAR, over={"geometry.length": np.array([1e-4, np.nan])})


def test_text_in_a_column_is_refused():
    with pytest.raises(TypeError, match="modulus_Pa must hold real numbers, not text"):
        viscard.fit({"time_s": T[:2], "modulus_Pa": ["1", "2"]})
    with pytest.raises(TypeError, match="modulus_Pa must hold real numbers"):
        viscard.fit(pandas.DataFrame({"time_s": [1.0, 2.0], "modulus_Pa": ["a", None]}))
