"""Pictures and tables of results: what is drawn are the numbers of the result."""
import copy
import multiprocessing
import pickle

import numpy as np
import pytest

import viscard

pyplot = pytest.importorskip("matplotlib.pyplot")
EXAMPLE = "data/demo/example_relaxation.csv"
PDMS = viscard.Material(1.5e6, 0.33, terms=[(0.2, 0.5)], rho_kg_m3=965)
PILLAR = {"tolerance": 1e-2, "geometry": {"diameter": "40 um", "length": "120 um"}, "materials": {"pillar": PDMS}}
PRESSED = {**PILLAR, "analysis": {"kind": "static", "load": {"pressure": "1 kPa", "on": "top"}}}
OVER = {"geometry.diameter": [36e-6, 40e-6, 44e-6], "geometry.length": ["100 um", "120 um"]}


@pytest.fixture(autouse=True)
def closed():
    yield
    pyplot.close("all")


def test_a_fit_shows_data_curve_band_and_residuals():
    result = viscard.fit(EXAMPLE)
    above = result.plot()
    below = above.figure.axes[1]
    np.testing.assert_allclose(above.lines[0].get_ydata(), 1e-6 * result.curves["measured"])
    np.testing.assert_allclose(above.lines[1].get_ydata(), 1e-6 * result.curves["fitted"])
    np.testing.assert_allclose(below.lines[0].get_ydata(), result.residuals / result.curves["sigma"])
    (band,) = above.collections
    _, low, high = result.material.relaxation(result.curves["at"], band=True)
    ends = band.get_paths()[0].vertices[:, 1] * 1e6
    assert ends.min() == pytest.approx(low.min()) and ends.max() == pytest.approx(high.max())
    # The curve falls by 2 %; it fills most of the axes all the same.
    span = np.ptp(above.get_ylim()) * 1e6
    assert np.ptp(result.curves["fitted"]) < 0.03 * result.E0_Pa and np.ptp(result.curves["fitted"]) > 0.7 * span
    own = pyplot.subplots()[1]
    assert result.plot(own) is own and len(own.figure.axes) == 1  # into a picture of the user's: no residuals


def test_the_hold_of_an_indentation_is_seen(run):
    axes = viscard.fit(run).plot()
    (hold,) = axes.child_axes
    drop = np.ptp(hold.lines[1].get_ydata())
    assert np.min(hold.lines[1].get_ydata()) > 0.9 * np.max(hold.lines[1].get_ydata())  # without the lift
    assert drop < 0.1 * np.ptp(axes.get_ylim()) and drop > 0.5 * np.ptp(hold.get_ylim())


def test_answers_draw_what_they_have():
    modes = viscard.simulate({**PILLAR, "analysis": {"kind": "modal", "modes": 3}})
    axes = modes.plot()
    np.testing.assert_allclose(axes.containers[0].lines[0].get_xdata(), 1e-3 * modes.frequencies_Hz)
    creep = viscard.simulate({**PILLAR, "analysis": {"kind": "creep", "history": [["0 s", "1 kPa"], ["5 s", "1 kPa"]]}})
    name = next(iter(creep.curves))
    assert creep.plot().get_ylabel().startswith(name.replace("_", " "))
    assert len(creep.plot(name).lines[0].get_ydata()) == len(creep.curves[name]["x"])
    pressed = viscard.simulate(PRESSED)
    assert len(pressed.plot().patches) == len(pressed.results)
    with pytest.raises(viscard.Error, match="has no 'volts' to draw"):
        pressed.plot("volts")


def test_a_map_shows_each_pillar_at_its_place_and_zero_in_the_middle_of_its_colours():
    answer = viscard.simulate("data/scenes/space_array.toml")
    (drawn,) = answer.plot("centre_voltage").collections
    value = answer.maps["centre_voltage"]["value"]
    assert value.min() < 0.0 < value.max() and drawn.norm.vmin == -drawn.norm.vmax == pytest.approx(1e3 * value.min())
    np.testing.assert_allclose(drawn.get_array(), 1e3 * value.ravel())  # mV
    np.testing.assert_allclose(drawn.get_offsets(), 1e6 * np.column_stack([answer.x_m, answer.y_m]))
    gaps = answer.maps["crosstalk_percent"]["value"]  # the pillar that is pressed has none
    assert len(answer.plot("crosstalk_percent").collections[0].get_array()) == np.isfinite(gaps).sum() < gaps.size


def test_a_sweep_draws_a_line_for_each_value_of_the_other_parameter():
    sweep = viscard.sweep(PRESSED, over=OVER)
    axes = sweep.plot("top_displacement")
    assert axes.get_xlabel() == "geometry.diameter" and [t.get_text() for t in axes.get_legend().get_texts()] == [
        "length 100 um", "length 120 um"]
    np.testing.assert_allclose(axes.containers[0].lines[0].get_ydata(), 1e9 * sweep["top_displacement"][::2])  # nm
    assert "36 um" not in axes.get_xlabel() and sweep.to_frame().shape[0] == 6
    with pytest.raises(KeyError, match="the answers have no 'volts'"):
        sweep.plot("volts")


def test_costs_draw_their_front():
    cost = viscard.cost(PRESSED, budget=0.2)
    assert len(cost.plot().lines[1].get_xdata()) == cost.pareto.sum()


def made():
    """A result of every kind."""
    pressed = {**PRESSED, "analysis": {"kind": "static", "load": {"pressure": "1 kPa +- 1 %", "on": "top"}}}
    treloar = viscard.read_table("data/reference/treloar_uniaxial.csv")
    return [viscard.fit(EXAMPLE), viscard.fit({"uniaxial": treloar}, model="neo-hooke"), PDMS, PDMS.card("abaqus"), PDMS.validate(),
            viscard.predict(PDMS, test="creep"), treloar, viscard.simulate({**PILLAR, "analysis": {"kind": "modal"}}),
            viscard.simulate(pressed, uncertainty=True), viscard.plan(PRESSED), viscard.cost(PRESSED, budget=0.1),
            viscard.sweep(PRESSED, over={"geometry.length": ["100 um", "120 um"]}),
            viscard.design(diameter=40e-6, spacing="60 um"),
            viscard.design({**PILLAR, "analysis": {"kind": "modal"}}, {"bandwidth": "1 kHz"})]


def text(value):
    """All that a result holds, arrays as lists."""
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, dict):
        return {key: text(one) for key, one in value.items()}
    if isinstance(value, (list, tuple)):
        return [text(one) for one in value]
    return repr(value)


def made_at_the_rig(run, folder, short_test):
    rig, specimen = viscard.data_file("demo/01_rig.toml"), viscard.data_file("demo/03_pdms_1to10.toml")
    block = {"position_m": [0, 1e-5, 2e-5, 3e-5], "force_N": [0, 0.1, 0.2, 0.3]}
    return [viscard.read_capture(run), viscard.calibrate(block, compliance=True), viscard.next_test(run, "E0=1%"),
            viscard.cost_of_tests(rig, specimen, "E0=10%", at_most="2 min"),
            viscard.capture(folder / "again.viscap", test=short_test, emulate=True, speed=500)]


def pressures():
    scene = viscard.data_file("scenes/space_sphere.toml")
    return viscard.pressures_from_voltages(scene, viscard.simulate(scene).maps["mean_voltage"]["value"], noise=1e-4)


def test_every_result_can_be_pickled_copied_compared_and_shown(ratio_files, run, tmp_path, short_test):
    pandas = pytest.importorskip("pandas")
    joint = viscard.fit(ratio_files, joint=True, ratio=[10, 13, 20])
    rubber = viscard.fit({"uniaxial": viscard.read_table("data/reference/treloar_uniaxial.csv")}, model="yeoh")
    results = [*made(), *made_at_the_rig(run, tmp_path, short_test), joint, pressures(), rubber.card("abaqus", "mm-t-s"),
               viscard.design(viscard.data_file("designs/longest_pillar.toml"))]
    shown = {one for one in map(viscard.__dict__.get, viscard.__all__) if isinstance(one, type) and hasattr(one, "_table")}
    assert shown - {type(one) for one in results} == set()
    for result in results:
        for again in (pickle.loads(pickle.dumps(result)), copy.deepcopy(result)):
            assert again == result and again is not result
            assert isinstance(result, list) or hash(again) == hash(result)
            assert type(again) is type(result) and repr(again) == repr(result)
            public = [name for name in vars(result) if not name.startswith("_")]
            assert [repr(text(getattr(again, name))) for name in public] == [repr(text(getattr(result, name))) for name in public]
        if type(result) in shown:
            assert "<table>" in result._repr_html_()
            assert isinstance(result.to_frame(), pandas.DataFrame) and len(result.to_frame()) > 0, type(result)
    assert pickle.loads(pickle.dumps(joint)).material(15).E0_Pa == joint.material(15).E0_Pa


def test_answers_and_materials_that_differ_are_not_equal():
    answer = viscard.simulate(PRESSED)
    assert answer == viscard.simulate(PRESSED) != answer_of("44 um")
    assert answer != "text" and PDMS != viscard.Material(PDMS.E0_Pa, 0.4) and len({PDMS, copy.copy(PDMS)}) == 1
    field, again = (viscard.simulate(PRESSED, fields=True).fields[0] for _ in range(2))
    assert field == again and not field != again and hash(field) == hash(again)
    assert field != again._replace(x_m=2.0 * again.x_m)


def test_frames_hold_what_was_fitted(ratio_files):
    pytest.importorskip("pandas")
    rubber = viscard.fit({"uniaxial": viscard.read_table("data/reference/treloar_uniaxial.csv")}, model="yeoh")
    frame = rubber.to_frame()
    assert list(frame.columns) == ["test", "time_s", "stretch", "measured", "fitted", "residual"]
    np.testing.assert_array_equal(frame["residual"], rubber.residuals[0])
    np.testing.assert_allclose(frame["fitted"], rubber.stress(frame["stretch"].to_numpy()), rtol=1e-9)
    joint = viscard.fit(ratio_files, joint=True, ratio=[10, 13, 20])
    frame = joint.to_frame()
    assert list(frame["mixing_ratio"]) == [10, 13, 20] and (frame["E0_low_95"] < frame["E0_Pa"]).all()
    assert joint.residuals.shape == (3,) and abs(joint.residuals).max() < 1e-3
    assert joint.plot().get_xlabel() == "mixing ratio"


def answer_of(diameter):
    return viscard.simulate({**PRESSED, "geometry": {"diameter": diameter, "length": "120 um"}})


def test_scenes_are_answered_by_several_processes():
    diameters = ["36 um", "40 um", "44 um"]
    with multiprocessing.get_context("spawn").Pool(2) as pool:
        found = pool.map(answer_of, diameters)
    assert [one["top_displacement"] for one in found] == [answer_of(one)["top_displacement"] for one in diameters]
