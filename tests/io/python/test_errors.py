"""Wrong input: the words of the command line as exceptions."""
import copy
import pickle
import subprocess

import numpy as np
import pytest

import viscard
from test_scene import PRESS

EXAMPLE = "data/demo/example_relaxation.csv"


def text_of(call, *words, **keywords):
    with pytest.raises(viscard.Error) as caught:
        call(*words, **keywords)
    return caught.value


def test_the_words_are_those_of_the_command_line(program, tmp_path):
    empty = tmp_path / "empty.csv"
    empty.touch()
    for path in ("nothing.csv", str(empty)):  # messages that name options name them as keywords here
        printed = subprocess.run([program, "fit", path], capture_output=True, text=True).stderr
        assert str(text_of(viscard.fit, path)) == printed.removeprefix("viscard: ").rstrip("\n")


def test_options_are_named_as_keywords():
    error = text_of(viscard.fit, EXAMPLE, max_terms=200)
    assert (error.code, str(error)) == ("usage", "max_terms 200 is outside 0 to 100")
    assert "add depth" in str(text_of(viscard.fit, {"time_s": [0, 1, 2, 3, 4], "force_N": [5, 4, 3, 2.5, 2.2]},
                                      punch_diameter="4 mm"))
    assert "exclude each other" in str(text_of(viscard.fit, EXAMPLE, liquid=True, solid=True))
    assert "from_ must be before to" in str(text_of(viscard.fit, EXAMPLE, from_=2, to=1))
    assert "relaxtion is not known; did you mean" in str(text_of(viscard.predict,
                                                                 "data/materials/pdms_1to10_seed.json",
                                                                 test="relaxtion"))
    assert "share needs joint=True" in str(text_of(viscard.fit, EXAMPLE, share="g"))


def test_errors_have_parts_and_can_be_pickled():
    error = text_of(viscard.fit, "nothing.csv")
    assert error.where == "nothing.csv" and error.code and error.message
    again = pickle.loads(pickle.dumps(error))
    assert (str(again), again.code, again.hint) == (str(error), error.code, error.hint)


def test_an_unknown_keyword_is_a_TypeError():
    with pytest.raises(TypeError, match="max_term"):
        viscard.fit(EXAMPLE, max_term=3)
    with pytest.raises(TypeError, match="terms must be a whole number, not 'three'"):
        viscard.fit(EXAMPLE, terms="three")
    with pytest.raises(TypeError, match="terms must be a whole number, not 2.5"):
        viscard.fit(EXAMPLE, terms=2.5)
    with pytest.raises(TypeError, match="depth must be a text or a number, not"):
        viscard.fit(EXAMPLE, depth=[1])
    with pytest.raises(TypeError, match="path"):
        viscard.read_table(5)


def test_booleans_are_no_numbers_and_numbers_no_booleans():
    for keyword in ("terms", "max_terms", "poisson_ratio", "ratio"):
        with pytest.raises(TypeError, match=f"{keyword} must be .*number.*, not True"):
            viscard.fit(EXAMPLE, **{keyword: True})
    with pytest.raises(TypeError, match="liquid must be True or False, not 3"):
        viscard.fit(EXAMPLE, liquid=3)
    with pytest.raises(TypeError, match="depth must be a text or a number, not array"):
        viscard.fit(EXAMPLE, depth=np.array([1.0, 2.0]))


def test_names_that_are_nearly_right():
    material = viscard.Material(1e6, 0.4)
    assert "'abaqu'; did you mean 'abaqus'?" in str(text_of(material.card, "abaqu"))
    assert "'mm-t'; did you mean 'mm-t-s'?" in str(text_of(material.card, "abaqus", "mm-t"))
    assert str(text_of(viscard.cost, PRESS, budget="abc")).startswith("budget: 'abc'")
    modes = viscard.simulate("data/scenes/pillar_modal.toml")
    assert [modes[mode["name"]] for mode in modes.modes] == list(modes.frequencies_Hz)
    with pytest.raises(KeyError, match=modes.modes[0]["name"]):
        modes["voltage"]


def test_arrays_of_the_wrong_kind(relaxation):
    time_s, modulus_Pa = relaxation
    with pytest.raises(TypeError, match="modulus_Pa must hold real numbers, not text"):
        viscard.fit({"time_s": time_s, "modulus_Pa": modulus_Pa.astype(str)})
    with pytest.raises(TypeError, match="complex128"):
        viscard.fit({"time_s": time_s, "modulus_Pa": modulus_Pa * 1j})
    assert "different lengths: time_s 400, modulus_Pa 399" in str(
        text_of(viscard.fit, {"time_s": time_s, "modulus_Pa": modulus_Pa[1:]}))
    assert "2 dimensions" in str(text_of(viscard.fit, {"time_s": time_s.reshape(2, -1), "modulus_Pa": modulus_Pa}))
    assert "no rows" in str(text_of(viscard.fit, {}))
    assert "modulus_Pa" in str(text_of(viscard.fit, {"t": time_s, "y": modulus_Pa}))
    with pytest.raises(TypeError, match="a dict of arrays by header, a DataFrame, a Capture, a list of these, or .* by kind of test, not array"):
        viscard.fit(np.column_stack([time_s, modulus_Pa]))
    whole = viscard.fit({"time_s": time_s.astype(np.float32), "modulus_Pa": modulus_Pa.astype(int)})
    assert whole.E0 == pytest.approx(1.5e6, rel=0.01)


def test_NaN_in_arrays_names_its_place(relaxation):
    time_s, modulus_Pa = relaxation
    modulus_Pa[6] = np.nan
    found = viscard.fit({"time_s": time_s, "modulus_Pa": modulus_Pa})
    assert found.json["left_out"] == {"not_a_number": 1} and "1 row without a number" in found.summary()
    material = viscard.Material(1e6, 0.4)
    assert "time_s holds nan" in str(text_of(material.relaxation, [1.0, np.nan]))
    assert "frequency_Hz holds -1" in str(text_of(material.loss, -1.0))


def test_mistakes_in_scenes_name_the_key():
    scene = copy.deepcopy(PRESS)
    scene["geometry"]["diametre"] = scene["geometry"].pop("diameter")
    assert str(text_of(viscard.simulate, scene)).startswith("scene: ")
    scene["geometry"]["diameter"] = "40 apples"
    del scene["geometry"]["diametre"]
    error = text_of(viscard.simulate, scene)
    assert str(error).startswith("scene: geometry.diameter: 'apples'") and error.where == "scene"
    scene = copy.deepcopy(PRESS)
    scene["geometry"]["length"] = float("nan")
    assert "length is nan" in str(text_of(viscard.simulate, scene))
    scene["geometry"]["length"] = object()
    with pytest.raises(TypeError, match="length is a object"):
        viscard.simulate(scene)
    assert "tol must lie between" in str(text_of(viscard.simulate, PRESS, tol=2.0))
    assert "nothing.toml" in str(text_of(viscard.simulate, "nothing.toml"))
    with pytest.raises(KeyError, match="no 'voltage'; it has"):
        viscard.simulate(PRESS)["voltage"]


def test_captures_are_refused_before_they_begin(tmp_path, short_test):
    error = text_of(viscard.capture, tmp_path / "a.viscap")
    assert error.code == "usage" and "emulate=True" in str(error)
    assert "speed must be above 0" in str(text_of(viscard.capture, tmp_path / "a.viscap", emulate=True, speed=0))
    assert "seed is -1" in str(text_of(viscard.capture, tmp_path / "a.viscap", emulate=True, seed=-1))
    (tmp_path / "b.viscap").write_text("mine")
    error = text_of(viscard.capture, tmp_path / "b.viscap", test=short_test, emulate=True, speed=200)
    assert error.code == "exists" and (tmp_path / "b.viscap").read_text() == "mine"


def test_files_that_do_not_come_with_viscard(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # the data lie beside the module, not beside the user
    assert viscard.data_file("scenes/pillar_press.toml").endswith("share/viscard/scenes/pillar_press.toml")
    assert viscard.data_file() + "/demo" == viscard.data_file("demo")
    error = text_of(viscard.data_file, "scenes/pillar_pres.toml")
    assert error.code == "file" and "pillar_press.toml" in str(error) and str(error).startswith("no file 'scenes/pillar_pres.toml'")
    assert "demo, " in str(text_of(viscard.data_file, "scene/other/pillar.toml"))
    with pytest.raises(TypeError, match="name must be a path, not 3"):
        viscard.data_file(3)


def test_closed_form_limits_have_the_words_of_the_command_line(program):
    import json

    words = ["design", "--diameter", "50 um", "--lattice", "hexagonal", "--film-thickness", "2e-5"]
    given = {"diameter": "50 um", "lattice": "hexagonal", "film_thickness": 2e-5}
    found = viscard.design(**given)
    assert found.json == json.loads(subprocess.run([program, *words, "--json"], capture_output=True, text=True).stdout)
    assert found.summary() == subprocess.run([program, *words], capture_output=True, text=True).stdout
    for option, name, value in (("--diameter", "diameter", "-1 um"), ("--film-thickness", "film_thickness", "3 kg"),
                                ("--lattice", "lattice", "hexagon")):
        printed = subprocess.run([program, "design", f"{option}={value}"], capture_output=True, text=True).stderr
        words = str(text_of(viscard.design, **{name: value}))
        assert words == printed.splitlines()[0].removeprefix("viscard: ").replace(option, name), printed
    assert "belongs to the closed-form limits" in str(text_of(viscard.design, "data/scenes/pillar_modal.toml", diameter=1))
    assert "--require".lstrip("-") in str(text_of(viscard.design, require={"bandwidth": "1 kHz"}))
    with pytest.raises(TypeError, match="no keyword 'diametre'"):
        viscard.design(diametre=1)
    with pytest.raises(TypeError, match="diameter must be a text or a number"):
        viscard.design(diameter={})


def test_messages_name_files_of_this_installation(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # the source has a folder data, which comes first
    empty = tmp_path / "empty.toml"
    empty.write_text("")
    named = str(text_of(viscard.simulate, empty)).split("such as ")[1]
    assert named == viscard.data_file("scenes/pillar_sensor.toml")


def test_the_interval_of_a_fit_is_seen_when_it_is_shown():
    shown = repr(viscard.fit(EXAMPLE))
    assert "(95 % 1.87981e+06 to 1.88012e+06)" in shown
