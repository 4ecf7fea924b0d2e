"""Arguments of the wrong type or value: one sentence that names the keyword, before anything is computed."""
import copy
import inspect
import pathlib
import warnings
from decimal import Decimal

import numpy as np
import pytest

import viscard
from test_rubber import WORDS
from test_scene import PRESS

EXAMPLE = "data/demo/example_relaxation.csv"
MATERIAL = viscard.Material(2e6, 0.49, terms=[(0.2, 1.0)])
RIG, SPECIMEN = "data/demo/01_rig.toml", "data/demo/03_pdms_1to10.toml"
ARRAY = {"geometry": {"kind": "array", "model": "space", "rows": 1, "columns": 2}, "analysis": {"kind": "static"}}
NO_TEXT, NO_NUMBER, NO_FLAG, NO_WHOLE = (3, True, [1], None), ("abc", True, [1], b"x"), ("abc", 1, [1], ""), ("abc", True, 2.5, [1])
NO_PATH, NO_FUNCTION = (3, True, [1], b"x"), ("abc", True, 3)

# What takes keywords, the keyword, wrong values, what the message says that it must be.
WRONG_TYPES = [
    (lambda **k: viscard.Material(**{"E0_Pa": 1e6, "nu": 0.4, **k}), "E0_Pa", NO_NUMBER, "a number"),
    (lambda **k: viscard.Material(**{"E0_Pa": 1e6, "nu": 0.4, **k}), "nu", NO_NUMBER, "a number"),
    (lambda **k: viscard.Material(1e6, 0.4, **k), "rho_kg_m3", NO_NUMBER, "a number"),
    (lambda **k: viscard.Material(1e6, 0.4, **k), "name", NO_TEXT, "a text"),
    (lambda **k: viscard.Material(1e6, 0.4, **k), "terms", ("abc", [1], {}, [(True, "a")]), r"a list of \(g, tau_s\)"),
    (lambda **k: MATERIAL.loss(1.0, **k), "band", NO_FLAG, "True or False"),
    (MATERIAL.at_temperature, "temperature_C", NO_NUMBER, "a number"),
    (lambda **k: MATERIAL.card(**{"target": "abaqus", **k}), "target", NO_TEXT, "a text"),
    (lambda **k: MATERIAL.card("abaqus", **k), "bound", NO_TEXT, "a text"),
    (lambda **k: MATERIAL.card("abaqus", **k), "reproducible", NO_FLAG, "True or False"),
    (lambda **k: MATERIAL.card("abaqus", **k), "temperature_C", NO_NUMBER, "a number"),
    (lambda **k: MATERIAL.card("abaqus", **k), "terms", NO_WHOLE, "a whole number"),
    (lambda **k: MATERIAL.save("a.json", **k), "overwrite", NO_FLAG, "True or False"),
    (lambda **k: MATERIAL.card("abaqus").save("a.inp", **k), "overwrite", NO_FLAG, "True or False"),
    (viscard.Material.load, "path", NO_PATH, "a path"),
    (lambda **k: viscard.predict(MATERIAL, **k), "strain", (True, [1], b"x"), "a text or a number"),
    (lambda **k: viscard.calibrate({"mass_kg": [0.0], "volts_V": [0.0]}, **k), "mass_u", NO_NUMBER, "a number"),
    (lambda **k: viscard.calibrate({"mass_kg": [0.0], "volts_V": [0.0]}, **k), "compliance", NO_FLAG, "True or False"),
    (lambda **k: viscard.read_table(EXAMPLE, **k), "sheet", NO_TEXT, "a text"),
    (lambda **k: viscard.read_table(EXAMPLE, **k), "column", (3, [1]), "a text or a list of texts"),
    (lambda **k: viscard.fit(EXAMPLE, **k), "joint", NO_FLAG, "True or False"),
    (lambda **k: viscard.fit(EXAMPLE, **k), "ratio", NO_NUMBER[:2], "a number or a list of numbers"),
    (lambda **k: viscard.fit(EXAMPLE, **k), "progress", NO_FUNCTION, "a function"),
    (viscard.simulate, "scene", NO_PATH, "a path or a dict"),
    (lambda **k: viscard.simulate(PRESS, **k), "tol", NO_NUMBER, "a number"),
    (lambda **k: viscard.simulate(PRESS, **k), "fields", NO_FLAG, "True or False"),
    (lambda **k: viscard.simulate(PRESS, uncertainty=True, **k), "samples", NO_WHOLE, "a whole number"),
    (lambda **k: viscard.simulate(PRESS, **k), "folder", NO_PATH, "a path"),
    (lambda **k: viscard.cost(PRESS, **k), "budget", (True, [1], None), "a text or a number"),
    (lambda **k: viscard.forces_from_voltages(ARRAY, np.zeros((1, 2, 4)), **k), "noise", NO_NUMBER, "a number"),
    (viscard.sweep, "study", NO_PATH, "a path"),
    (lambda **k: viscard.predict(viscard.Material(1e6, 0.4), **k), "against", NO_PATH, "a path"),
    (lambda **k: viscard.next_test(want="E0=1%", **k), "capture", NO_PATH, "a path"),
    (lambda **k: viscard.sweep("a.toml", **k), "over", (3, [1]), "a dict of values"),
    (lambda **k: viscard.sweep("a.toml", "a.sqlite", **k), "merge", NO_PATH[:2], "a path or a list of paths"),
    (lambda **k: viscard.design("a.toml", {}, **k), "search_time", (True, [1]), "a text or a number"),
    (viscard.design, "lattice", (True, [1]), "a text or a number"),
    (lambda **k: viscard.cost_of_tests(RIG, SPECIMEN, **k), "want", (3, [1], None), "a text or a list of texts"),
    (lambda **k: viscard.capture("a.viscap", **k), "speed", NO_NUMBER, "a number"),
    (lambda **k: viscard.capture("a.viscap", **k), "emulate", NO_FLAG, "True or False"),
    (lambda **k: viscard.capture("a.viscap", **k), "sample", NO_FUNCTION, "a function"),
]


@pytest.mark.parametrize("call, keyword, values, expected", WRONG_TYPES)
def test_a_wrong_type_is_named_with_its_keyword(call, keyword, values, expected, tmp_path, monkeypatch):
    if keyword in ("overwrite", "sample", "merge"):
        monkeypatch.chdir(tmp_path)
    for value in values:
        with pytest.raises(TypeError, match=f"^{keyword} must be {expected}.*, not ") as caught:
            call(**{keyword: value})
        assert len(str(caught.value)) < 150
    assert not list(tmp_path.iterdir())


def rows_of(value):
    return lambda: viscard.forces_from_voltages(ARRAY, [[value, [0.0] * 4]])


# What fails, and words of its message.
WRONG_VALUES = [
    (lambda: viscard.Material(float("nan"), 0.4), "E0_Pa is nan; it must be a finite number"),
    (lambda: viscard.Material(1e6, 0.4, terms=[(0.2, float("inf"))]), "tau_s is inf"),
    (lambda: MATERIAL.card("abaqus", elastic_only="abc"), "no elastic_only 'abc'.* There are: instantaneous, long-term"),
    (lambda: MATERIAL.card("abaqus", bound="uper"), "no bound 'uper'; did you mean 'upper'"),
    (lambda: MATERIAL.card("abaqus", terms=2**70), "terms is 1180591620717411303424; it must be at least 0 and at most"),
    (lambda: MATERIAL.card("abaqus", terms=1), "terms changes the material; pass approximate=True too"),
    (lambda: MATERIAL.card("abaqus", clamp_nu=3), r"clamp_nu is 3; it must lie in \(-1, 0.5\)"),
    (lambda: viscard.fit(EXAMPLE, poisson_ratio=float("inf")), "poisson_ratio is inf; it must be a finite number"),
    (lambda: viscard.simulate(PRESS, uncertainty=True, samples=-1), "samples is -1; it must be at least 1"),
    (lambda: viscard.simulate(PRESS, tol=10**400), "tol is 10+...; it must be a finite number"),
    (rows_of([0.0, 0.0, 0.0, float("inf")]), r"voltages\[0, 0\] is .*inf.*four NaN where no pillar stands"),
    (rows_of([0.0, float("nan"), 0.0, 0.0]), r"voltages\[0, 0\] is .*nan"),
    (lambda: viscard.check_scene(PRESS, svg="x.png"), "svg is 'x.png'; the drawing is an SVG file, so end its name with .svg"),
    (lambda: viscard.Material(Decimal("NaN"), 0.4), "E0_Pa is .*NaN.*; it must be a finite number"),
    (lambda: viscard.Material(Decimal("sNaN"), 0.4), "E0_Pa is .*NaN.*; it must be a finite number"),
    (lambda: viscard.design(diameter=40), 'write diameter="40 um"; if'),
    (lambda: viscard.design(search_time=5), "search_time belongs to a scene; give one, or omit it"),
    (lambda: viscard.design(diameter="40 um", search_time=-5), "search_time belongs to a scene; give one, or omit it"),
    (lambda: viscard.design("a.toml", search_time=5), "search_time belongs to a scene that is judged by require; omit it"),
    (lambda: viscard.fit({"relaxaton": {"time_s": [1.0], "modulus_Pa": [1.0]}}),
     "^data: there is no kind of test 'relaxaton'; did you mean 'relaxation'.*There are: relaxation, creep, .*uniaxial"),
    (lambda: viscard.fit({"time_s": [1.0, 2.0, 3.0], "modulus_Pa": [np.nan] * 3}),
     "^arrays: column 2 'modulus_Pa' for modulus_Pa: no row has a number; "),
    (lambda: viscard.sweep(viscard.data_file("studies/pillar.toml"), over={"geometry.diameter": [36e-6]}),
     "^over is for a scene, and .*pillar.toml' is a study, which states its own values; omit over"),
    (lambda: viscard.data_file("/etc"), "no file '/etc' comes with viscard"),
]


@pytest.mark.parametrize("length", [10, 80, 190, 5000])
def test_a_path_in_a_message_keeps_its_end(length):
    folder = "/" + "/".join(["a" * 40] * 200)[:length]
    for path in (folder + "/pillar.toml", pathlib.Path(folder) / "pillar.toml", folder + "/" + "b" * 90 + "pillar.toml"):
        for value in (path, [path]):
            with pytest.raises(TypeError) as caught:
                viscard.Material(1e6, value)
            message = str(caught.value)
            assert "pillar.toml'" in message
            assert len(message) < 300
            assert value is not path or length > 90 or str(path) in message
    with pytest.raises(TypeError, match="^nu must be a number, not 'xxx.*x\\.\\.\\.$"):  # no path
        viscard.Material(1e6, "x" * 5000)


@pytest.mark.parametrize("call, words", WRONG_VALUES)
def test_a_wrong_value_is_named_with_its_keyword(call, words):
    with pytest.raises(viscard.Error, match=words):
        call()


WRONG_ARRAYS = [
    (lambda: MATERIAL.relaxation([1.0, True]), "time_s must hold real numbers, not True or False"),
    (lambda: MATERIAL.relaxation(np.array([True])), "time_s must hold real numbers, not True or False"),
    (lambda: MATERIAL.relaxation([[1.0], [1.0, 2.0]]), "time_s must hold numbers in rows of one length"),
    (lambda: viscard.fit({"time_s": ["0.1", "0.2"], "modulus_Pa": [1.8e6, 1.7e6]}), "^time_s must hold real numbers, not text"),
    (lambda: viscard.fit({"time_s": ["0.1", "0.2"], "modulus_Pa": ["2e6", "1e6"]}), "^time_s must hold real numbers, not text"),
    (lambda: viscard.forces_from_voltages(ARRAY, "abc"), "voltages must hold real numbers, not text"),
    (lambda: viscard.forces_from_voltages({**ARRAY, "analysis": 3}, np.zeros((1, 2, 4))), "analysis must be a dict, not 3"),
]


@pytest.mark.parametrize("call, words", WRONG_ARRAYS)
def test_wrong_arrays_are_named(call, words):
    with pytest.raises(TypeError, match=words):
        call()


WRONG_KEYWORDS = [
    (lambda: viscard.fit(EXAMPLE, term=2), r"^fit\(\) has no keyword 'term'; did you mean 'terms'\?$"),
    (lambda: viscard.fit(EXAMPLE, qqq=2), r"^fit\(\) has no keyword 'qqq'; help\(viscard.fit\) lists them$"),
    (lambda: MATERIAL.card("abaqus", aproximate=True), r"^Material.card\(\) has no keyword .*did you mean 'approximate'"),
    (lambda: viscard.simulate(PRESS, field=True), r"^simulate\(\) has no keyword 'field'; did you mean 'fields'"),
]


@pytest.mark.parametrize("call, words", WRONG_KEYWORDS)
def test_an_unknown_keyword_gets_the_nearest_name(call, words):
    with pytest.raises(TypeError, match=words):
        call()


def test_no_times_give_no_values():
    value, low, high = MATERIAL.relaxation([], band=True)
    assert value.shape == low.shape == high.shape == (0,)


def test_decimals_are_numbers(relaxation):
    as_decimals = [[Decimal(str(one)) for one in column] for column in relaxation]
    fitted = viscard.fit(dict(zip(("time_s", "modulus_Pa"), as_decimals)))
    assert fitted.E0_Pa == viscard.fit(dict(zip(("time_s", "modulus_Pa"), relaxation))).E0_Pa
    assert viscard.Material(Decimal("2e6"), 0.49).E0_Pa == 2e6
    scene = copy.deepcopy(PRESS)
    scene["geometry"]["diameter"] = Decimal("40e-6")
    assert viscard.check_scene(scene) == "pillar"


def test_numbers_of_numpy_are_numbers():
    one = viscard.Material(np.float32(2e6), np.float64(0.49), terms=np.array([[0.2, 1.0]]), rho_kg_m3=np.int64(965))
    assert (one.E0_Pa, one.json["rho_kg_m3"]) == (2e6, 965)
    assert len(MATERIAL.card("abaqus", terms=np.int32(1), approximate=True, reproducible=np.bool_(True)).text) > 0
    assert viscard.design(diameter=np.array(40e-6)).json == viscard.design(diameter="40 um").json


def test_a_ratio_outside_names_the_keyword(ratio_files):
    joint = viscard.fit(ratio_files, joint=True, ratio=(10, 13, 20))
    with pytest.raises(viscard.Error, match="may_extrapolate=True"):
        joint.material(40)
    with pytest.raises(TypeError, match="ratio must be a number, not 'abc'"):
        joint.material("abc")


def test_plots_refuse_what_matplotlib_does_not_take():
    pytest.importorskip("matplotlib")
    import matplotlib.pyplot as plt

    result = viscard.fit(EXAMPLE, terms=1)
    with pytest.raises(TypeError, match="ax must be axes of matplotlib, such as .*, not 'abc'"):
        result.plot("abc")
    with pytest.raises(TypeError, match="plot.. has no keyword 'colour'"):
        result.plot(colour="C3")
    with pytest.raises(viscard.Error, match="color is 'abc', which matplotlib does not take"):
        result.plot(color="abc")
    assert not plt.get_fignums()  # refused before a figure is made
    result.plot(lw=2, color="C3", label="one")
    result.plot(color=None)
    plt.close("all")


def test_a_mistake_in_a_scene_of_a_dict_is_not_taken_for_JSON():
    scene = copy.deepcopy(PRESS)
    scene["geometry"] = {}
    with pytest.raises(viscard.Error, match="diameter"):
        viscard.simulate(scene)


def test_a_warning_points_at_the_line_that_fits():
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        viscard.fit(WORDS, model="mooney-rivlin")
    assert [one.filename for one in caught] == [__file__]


def test_a_pillar_without_voltages_is_named_without_the_file_of_ours():
    scene = copy.deepcopy(PRESS)
    scene["geometry"] = {"kind": "array", "model": "space", "rows": 1, "columns": 2, "spacing": "60 um", "diameter": "40 um",
                         "length": "120 um", "film": {"thickness": "25 um", "edge": "150 um", "material": "pvdf"},
                         "electrode": {"face": "bottom", "kind": "sampled", "quadrants": True}}
    scene["analysis"] = {"kind": "static"}
    with pytest.raises(viscard.Error, match=r"^voltages: has no voltages of pillar \[1, 2\]"):
        viscard.forces_from_voltages(scene, np.array([[[0.0] * 4, [np.nan] * 4]]))


def test_every_argument_is_checked():
    """A function with a keyword whose annotation has no rule would pass everything."""
    own = {"data", "stretch", "time_s", "frequency_Hz", "voltages", "terms", "merge", "material", "ax", "style", "options"}
    for name in viscard.__all__:
        one = getattr(viscard, name)
        calls = [call for key, call in vars(one).items() if not key.startswith("_")] if inspect.isclass(one) else [one]
        for call in calls:
            call = getattr(call, "__func__", call)
            if not inspect.isfunction(call):
                continue
            keys = set(inspect.signature(call).parameters) - {"self", "cls"} - own
            assert not keys or hasattr(call, "__wrapped__") or name == "Table", (name, call.__name__, keys)


def test_arrays_without_a_name_are_shown_the_dict():
    time_s, modulus_Pa = np.array([0.1, 1.0]), np.array([2e6, 1e6])
    with pytest.raises(TypeError, match=r'fit\(\) takes 1 value without a name, and arrays go into one dict'):
        viscard.fit(time_s, modulus_Pa)
    with pytest.raises(TypeError, match=r"takes 1 value without a name; write the others as NAME=VALUE"):
        viscard.fit(EXAMPLE, "return")
    with pytest.raises(TypeError, match=r"a Capture, a list of these, or a dict of these by kind of test, not b'run.csv'"):
        viscard.fit(b"run.csv")


@pytest.mark.parametrize("text", ["\0", "a\0b", "\ud800"])
def test_text_that_no_file_and_no_message_can_hold_is_refused_with_its_keyword(text):
    for call in (lambda: viscard.check_scene(text), lambda: viscard.read_table(text), lambda: viscard.fit(text),
                 lambda: viscard.simulate(viscard.data_file("scenes/pillar_press.toml"), plausible=text)):
        with pytest.raises(viscard.Error, match="holds no NUL"):
            call()


def nested(kind, depth):
    """Lists or dicts within each other; 0: one that contains itself."""
    value = kind()
    if depth == 0:
        value.append(value) if kind is list else value.update(a=value)
    for _ in range(depth):
        value = [value] if kind is list else {"a": value}
    return value


TAKES_ANY = [
    lambda v: viscard.simulate(v), lambda v: viscard.simulate({"a": v}), lambda v: viscard.simulate({"geometry": {"diameter": v}}),
    lambda v: viscard.check_scene(v), lambda v: viscard.check_scene({"a": v}), lambda v: viscard.plan({"a": v}),
    lambda v: viscard.cost({"a": v}), lambda v: viscard.cost(PRESS, budget=v), lambda v: viscard.design({"a": v}, {"b": v}),
    lambda v: viscard.design(diameter=v), lambda v: viscard.sweep({"a": v}, over={"a": [1]}),
    lambda v: viscard.sweep("a.toml", over={"a": v}), lambda v: viscard.fit(v), lambda v: viscard.fit([v]),
    lambda v: viscard.fit({"time_s": v}), lambda v: viscard.fit(EXAMPLE, column=v), lambda v: viscard.fit(EXAMPLE, errors=v),
    lambda v: viscard.predict(v), lambda v: viscard.predict(MATERIAL, strain=v), lambda v: viscard.predict(MATERIAL, against=v),
    lambda v: MATERIAL.predict(history={"a": v}), lambda v: MATERIAL.card(v), lambda v: MATERIAL.relaxation(v),
    lambda v: MATERIAL.tan_delta(v), lambda v: MATERIAL.plot(ax=v), lambda v: MATERIAL.validate().find(v),
    lambda v: viscard.Material(1e6, 0.4, terms=v), lambda v: viscard.Material(1e6, 0.4, name=v),
    lambda v: viscard.calibrate({"a": v}), lambda v: viscard.report(v, "a.html"), lambda v: viscard.next_test(EXAMPLE, v),
    lambda v: viscard.pressures_from_voltages({"a": v}, [[1.0]]), lambda v: viscard.forces_from_voltages({"a": v}, np.zeros((1, 1, 4)))]


@pytest.mark.parametrize("kind, depth", [(list, 0), (dict, 0), (list, 5000), (dict, 5000)])
def test_a_value_that_is_nested_too_deep_is_refused_in_a_line(kind, depth):
    value = nested(kind, depth)
    for number, call in enumerate(TAKES_ANY):
        with pytest.raises((viscard.Error, TypeError)) as caught:
            call(value)
        assert len(str(caught.value)) < 300 and "\n" not in str(caught.value), number


def test_a_value_that_cannot_be_written_is_named_by_its_kind():
    class Odd:
        def __repr__(self):
            raise ZeroDivisionError

    with pytest.raises(TypeError, match="material must be a path or a Material, not <Odd"):
        viscard.predict(Odd())
    with pytest.raises(viscard.Error, match="tol is <int>; it must be a finite number"):
        viscard.simulate(PRESS, tol=10**5000)


@pytest.mark.parametrize("call, words", [
    (lambda: viscard.predict(3), "material must be a path or a Material, not 3"),
    (lambda: viscard.predict(MATERIAL, history=3), "history must be a path, a dict of arrays by header or a DataFrame, not 3"),
    (lambda: viscard.fit([[1.0]]), r"data\[0\] must be a path, a dict of arrays by header, a DataFrame or a Capture, not \[1.0\]"),
    (lambda: viscard.fit([EXAMPLE, MATERIAL]), r"data\[1\] must be a path, .*, not <viscard.Material"),
    (lambda: viscard.fit({"time_s": {"a": {"b": 1}}}), r"data\['time_s'\] must be a path, a dict of arrays by header"),
    (lambda: viscard.calibrate(3), "data must be a path, a dict of arrays by header or a DataFrame, not 3"),
    (lambda: viscard.next_test(3, "E0=1%"), "capture must be a path or a Capture, not 3")])
def test_what_is_accepted_is_named_as_a_whole(call, words):
    with pytest.raises(TypeError, match=f"^{words}"):
        call()


def test_files_of_a_generator_are_fitted():
    assert len(viscard.fit(name for name in [EXAMPLE, EXAMPLE])) == 2


def test_a_whole_number_beyond_all_floats_is_no_number_of_a_row():
    with pytest.raises(viscard.Error, match="only 2 of"):
        viscard.fit({"time_s": [1.0, 2.0, 10**400], "modulus_Pa": [3e6, 2e6, 1e6]})
