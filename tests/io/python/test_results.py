"""What results can do in a notebook and between processes."""
import copy
import multiprocessing
import pickle

import numpy as np
import pytest

import viscard

EXAMPLE = "data/demo/example_relaxation.csv"
SEED = "data/materials/pdms_1to10_seed.json"


def fit_of(path):
    return viscard.fit(path)


@pytest.mark.parametrize("make", [
    lambda: viscard.fit(EXAMPLE), lambda: viscard.predict(SEED, test="creep"), lambda: viscard.plan("data/scenes/pillar_press.toml"),
    lambda: viscard.fit(["uniaxial=data/reference/treloar_uniaxial.csv"], model="neo-hooke")])
def test_a_result_that_was_pickled_or_copied_is_equal(make):
    result = make()
    for again in (pickle.loads(pickle.dumps(result)), copy.deepcopy(result), make()):
        assert again == result and again is not result and hash(again) == hash(result)
        assert again.json == result.json and repr(again) == repr(result)
    assert result != "text" and len({result, make()}) == 1


def test_a_fit_comes_back_from_another_process_with_its_text_and_material():
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        (again,) = pool.map(fit_of, [EXAMPLE])
    here = viscard.fit(EXAMPLE)
    assert again == here and again.summary() == here.summary()
    assert again.material.E0_Pa == here.material.E0_Pa
    np.testing.assert_array_equal(again.covariance, here.covariance)
    assert viscard.fit(EXAMPLE, terms=1) != here


def test_parameters_and_residuals_are_those_of_the_fit():
    result = viscard.fit(EXAMPLE)
    found = result.parameters
    assert list(found) == ["E0_Pa", "E_inf_Pa", "g_1", "tau_1_s", "g_2", "tau_2_s"]
    assert found["tau_2_s"].value == result.tau_s[1] and found["E0_Pa"].interval == result.E0_interval
    assert all(one.interval[0] < one.value < one.interval[1] for one in found.values())
    np.testing.assert_array_equal(result.residuals, result.curves["measured"] - result.curves["fitted"])
    # Of averages with known deviations.
    assert 0.8 < np.sqrt(np.mean((result.residuals / result.curves["sigma"])**2)) < 1.2
    force = viscard.fit({"time_s": np.geomspace(0.01, 10, 50), "force_N": 1 + np.exp(-np.geomspace(0.01, 10, 50))})
    assert "F0_N" in force.parameters


def test_notebooks_show_tables_with_escaped_texts():
    time_s = np.geomspace(0.01, 100, 60)
    result = viscard.fit({"time_s": time_s, "modulus_Pa": 1e6 * (1 + np.exp(-time_s))})
    assert "<table>" in result._repr_html_() and "tau_1_s" in result._repr_html_()
    named = viscard.Material(1e6, 0.4, name="<b>soft</b> & 1:10")
    assert "&lt;b&gt;soft&lt;/b&gt; &amp; 1:10" in named._repr_html_()
    assert viscard.predict(SEED, test="creep")._repr_html_().count("<tr>") < 20


def test_tables_become_frames():
    pandas = pytest.importorskip("pandas")
    result, prediction = viscard.fit(EXAMPLE), viscard.predict(SEED, test="oscillation")
    frame = result.to_frame()
    assert isinstance(frame, pandas.DataFrame) and {"at", "measured", "fitted", "residual"} <= set(frame.columns)
    assert len(prediction.to_frame()) == len(prediction.at)


def test_materials_and_predictions_draw_their_bands():
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("agg")
    material = viscard.fit(EXAMPLE).material
    assert material.tan_delta(1.0) == pytest.approx(material.loss(1.0) / material.storage(1.0))
    for kind, words in (("relaxation", "relaxation modulus (MPa)"), ("creep", "creep compliance (1/Pa)"),
                        ("storage", "storage modulus (MPa)"), ("loss", "loss modulus (kPa)"), ("tan_delta", "loss factor")):
        axes = material.plot(kind)
        assert axes.get_ylabel() == words and len(axes.collections) == (kind != "tan_delta")
    with pytest.raises(viscard.Error, match="use one of relaxation"):
        material.plot("relaxtion")
    creep, sweep = (viscard.predict(material, test=test).plot() for test in ("creep", "oscillation"))
    assert creep.get_ylabel() == "compliance (1/Pa)" and len(creep.lines) == 1 and len(sweep.lines) == 2
