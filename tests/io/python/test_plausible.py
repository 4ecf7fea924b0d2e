"""Numbers that no material or test has are refused in Python as on the command line."""
import numpy as np
import pytest

import viscard

T = np.geomspace(0.02, 100, 120)
NOISE = 1 + 1e-3 * np.sin(12.9898 * np.arange(120)) * np.cos(78.233 * np.arange(120))
E = (1.0 + 0.5 * np.exp(-T / 3)) * NOISE  # MPa


@pytest.mark.parametrize("columns, advice", [
    ({"time": T, "E": E}, 'column="modulus_Pa=1e6*E"'),
    ({"time_s": T, "modulus_Pa": E}, 'column="modulus_Pa=1e6*modulus_Pa"'),
    ({"time": T, "stress": 0.01 * E, "strain": 0.01 + 0 * T}, 'column="stress_Pa=1e6*stress"'),
    ({"time (s)": T, "stress (MPa)": 0.01 * E, "strain": 1.0 + 0 * T}, 'column="strain=0.01*strain"'),
    ({"time": T, "compliance": 1 / E}, 'column="compliance_1_Pa=1e-6*compliance"')])
def test_arrays_in_another_unit_are_refused_and_the_advised_words_read_them(columns, advice):
    with pytest.raises(viscard.Error) as refused:
        viscard.fit(columns)
    assert advice in str(refused.value)
    assert "--" not in str(refused.value)
    assert refused.value.code != "usage"
    fitted = viscard.fit(columns, column=advice[len('column="'):-1])
    assert fitted.E0_Pa == pytest.approx(1.5e6, rel=0.02)


def test_plausible_off_fits_them_and_the_result_says_so():
    fitted = viscard.fit({"time": T, "E": E}, plausible="off")
    assert "plausible-off" in [flag.name for flag in fitted.flags]
    assert "plausible-off" in [flag["name"] for flag in fitted.material.json["flags"]]


@pytest.mark.parametrize("make, advice", [
    (lambda: viscard.Material(2, 0.49), "plausible are 100 Pa to 1 TPa"),
    (lambda: viscard.Material(2e6, 0.49, rho_kg_m3=1.1), "1.1 g/cm3"),
    (lambda: viscard.Material(2e6, 0.49).card("febio", temperature_C=5000.0), "temperature_C"),
    (lambda: viscard.Material(2e6, 0.49).predict(strain=5), 'strain="5 %"'),
    (lambda: viscard.fit({"time_s": T, "modulus_Pa": 1e6 * E}, density=1.1), 'density="1.1 g/cm3"'),
    (lambda: viscard.fit({"time_s": T, "modulus_Pa": 1e6 * E}, punch_diameter=4.4), 'punch_diameter="4.4 mm"')])
def test_keywords_that_are_not_plausible_are_refused(make, advice):
    with pytest.raises(viscard.Error) as refused:
        make()
    assert advice in str(refused.value)
    assert "--" not in str(refused.value)


def test_a_material_keeps_that_it_was_accepted(tmp_path):
    material = viscard.Material(2, 0.49, plausible="off")
    material.save(tmp_path / "soft.json")
    assert viscard.Material.load(tmp_path / "soft.json").E0_Pa == 2
    assert any("plausible" in note for note in viscard.predict(material, to="10 s").notes)


def test_a_scene_is_judged_by_its_own_limits():
    def scene(E):
        return {"geometry": {"diameter": "40 um", "length": "120 um"}, "tolerance": 0.01,
                "materials": {"pillar": {"E": E, "nu": 0.33, "rho": "965 kg/m3"}},
                "analysis": {"kind": "static", "load": {"displacement": -1e-6, "on": "top"}}}

    viscard.plan(scene("1e15 Pa"))
    with pytest.raises(viscard.Error, match="1.8 MPa"):
        viscard.plan(scene(1.8))
    assert any("plausible" in note for note in viscard.simulate(scene(1.8), plausible="off").notes)
    assert any("plausible" in note for note in viscard.simulate({**scene(1.8), "plausible": "off"}).notes)


def test_a_sweep_with_a_wrong_unit_ends_before_its_first_point(tmp_path):
    (tmp_path / "scene.toml").write_text(
        'tolerance = 1e-2\n[geometry]\ndiameter = "40 um"\nlength = "120 um"\n[materials]\n'
        'pillar = { E = "1.8 MPa", nu = 0.33, rho = "965 kg/m3" }\n[analysis]\nkind = "static"\n'
        'load = { displacement = "-1 um", on = "top" }\n')
    (tmp_path / "study.toml").write_text(
        'scene = "scene.toml"\n[[parameter]]\nkey = "geometry.diameter"\nvalues = ["36 um", "40 um", "44 kPa"]\n')
    with pytest.raises(viscard.Error, match="44 kPa"):
        viscard.sweep(tmp_path / "study.toml", tmp_path / "points.sqlite")
    assert not (tmp_path / "points.sqlite").exists()


def test_masked_rows_are_left_out():
    wrong = np.where(np.arange(120) % 10 == 0, -999.0, 1e6 * E)
    masked = np.ma.masked_where(wrong < 0, wrong)
    kept = wrong > 0
    fitted = viscard.fit({"time_s": T, "modulus_Pa": masked})
    assert fitted.json["n_samples"] == kept.sum()
    assert fitted.E0_Pa == viscard.fit({"time_s": T[kept], "modulus_Pa": wrong[kept]}).E0_Pa
    with pytest.raises(viscard.Error, match="finite"):
        viscard.Material(2e6, 0.49).relaxation(np.ma.masked_equal([1.0, 2.0], 2.0))
