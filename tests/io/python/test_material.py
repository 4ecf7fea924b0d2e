"""Materials against closed forms."""
import locale
import re
import pickle
import warnings

import numpy as np
import pytest

import viscard

E0, G, TAU = 2e6, 0.2, 1.5


@pytest.fixture
def material():
    return viscard.Material(E0, 0.49, terms=[(G, TAU)], rho_kg_m3=965, name="zener")


def test_curves_equal_closed_forms(material):
    """A Zener solid: Tschoegl (1989), ch. 3."""
    t = np.geomspace(1e-3, 1e3, 61).reshape(-1, 1)
    np.testing.assert_allclose(material.relaxation(t), E0 * (1 - G + G * np.exp(-t / TAU)), rtol=1e-13)
    retardation = TAU / (1 - G)
    creep = (1 - G * np.exp(-t / retardation)) / (E0 * (1 - G))
    np.testing.assert_allclose(material.creep(t), creep, rtol=1e-12)
    f = np.geomspace(1e-3, 1e3, 31)
    w = 2 * np.pi * f * TAU
    np.testing.assert_allclose(material.storage(f), E0 * (1 - G + G * w**2 / (1 + w**2)), rtol=1e-12)
    np.testing.assert_allclose(material.loss(f), E0 * G * w / (1 + w**2), rtol=1e-12)
    assert isinstance(material.relaxation(0.0), float) and material.relaxation(t).shape == (61, 1)


def test_moduli(material):
    assert material.moduli["G0_Pa"] == pytest.approx(E0 / (2 * 1.49), rel=1e-14)
    assert material.moduli["K0_Pa"] == pytest.approx(E0 / (3 * 0.02), rel=1e-12)
    assert material.E_inf_Pa == pytest.approx(E0 * (1 - G), rel=1e-14)


def test_a_band_belongs_to_a_fit(material, relaxation):
    value, low, high = material.relaxation([1.0, 2.0], band=True)
    assert np.isnan(low).all() and np.isnan(high).all() and value.shape == (2,)
    fitted = viscard.fit({"time_s": relaxation[0], "modulus_Pa": relaxation[1]}).material
    value, low, high = fitted.relaxation([1.0, 2.0], band=True)
    assert np.all(low < value) and np.all(value < high)


def test_files_and_pickles_read_back(material, tmp_path):
    material.save(tmp_path / "m.json")
    for again in (viscard.Material.load(tmp_path / "m.json"), pickle.loads(pickle.dumps(material))):
        assert again.json == material.json and again.name == "zener"
    with pytest.raises(viscard.Error, match="exists already") as caught:
        material.save(tmp_path / "m.json")
    assert caught.value.code == "exists"
    material.save(tmp_path / "m.json", overwrite=True)


def test_every_target_writes_a_card(material, tmp_path):
    assert len(viscard.card_targets()) > 20
    card = material.card("abaqus", "mm-t-s", reproducible=True)
    assert card.largest_difference < 1e-6 and str(card) == card.text
    card.save(tmp_path / "card.inp")
    assert (tmp_path / "card.inp").read_text() == card.text
    with pytest.raises(viscard.Error, match="unobtainium"):
        material.card("unobtainium")
    with pytest.raises(viscard.Error, match="furlong"):
        material.card("abaqus", "furlong")


def test_predictions(material, tmp_path):
    found = material.predict(test="creep", stress="1 kPa", hold="10 s", recovery=None)
    np.testing.assert_allclose(found.curves["strain"][-1], 1e3 * material.creep(found.at[-1]), rtol=1e-9)
    sweep = viscard.predict(material, test="oscillation", from_=0.1, to="10 Hz", points=50)
    np.testing.assert_allclose(sweep.curves["storage_modulus_Pa"], material.storage(sweep.at), rtol=1e-12)
    with pytest.raises(viscard.Error, match="strain does not belong to test creep"):
        material.predict(test="creep", strain=0.01)


def test_predictions_beside_measured_values():
    found = viscard.predict("data/materials/pdms_1to10_seed.json", against="data/demo/example_relaxation.csv")
    assert found.agreement[0]["rms"] > 0


def test_unphysical_materials_are_refused():
    for words in ({"E0_Pa": -1.0, "nu": 0.49}, {"E0_Pa": 1e6, "nu": 0.7}, {"E0_Pa": float("nan"), "nu": 0.4}):
        with pytest.raises(viscard.Error):
            viscard.Material(**words)
    with pytest.raises(viscard.Error):
        viscard.Material(1e6, 0.49, terms=[(1.5, 1.0)])
    with pytest.raises(TypeError, match="terms must be a list of"):
        viscard.Material(1e6, 0.49, terms=[0.2, 1.0])
    with pytest.raises(TypeError, match="terms must be a whole number, not 0.5"):
        viscard.Material(1e6, 0.49).card("abaqus", terms=0.5)
    assert "without a name" in repr(viscard.Material(1e6, 0.49))


@pytest.fixture
def decimal_comma():
    """A language with a decimal comma, as programs with windows set it."""
    before = locale.setlocale(locale.LC_ALL)
    for name in ("de_DE.UTF-8", "fr_FR.UTF-8", "nl_NL.UTF-8"):
        try:
            locale.setlocale(locale.LC_ALL, name)
            break
        except locale.Error:
            continue
    else:
        pytest.skip("no language with a decimal comma is installed")  # tests/layering reads the source for it
    yield lambda: locale.setlocale(locale.LC_ALL, before)
    locale.setlocale(locale.LC_ALL, before)


def test_a_decimal_comma_in_the_language_changes_no_card_and_no_message(decimal_comma):
    def texts():
        fitted = viscard.fit("data/demo/example_relaxation.csv")
        cards = [fitted.summary(), *(flag.text for flag in fitted.flags)]
        for target in viscard.card_targets():
            try:
                text = fitted.material.card(target, "SI").text
                cards.append([line for line in text.splitlines() if "created" not in line])
            except viscard.Error as error:
                cards.append(str(error))
        return cards

    with_comma = texts()
    decimal_comma()
    assert with_comma == texts()


def test_what_is_in_doubt_of_a_file_is_a_warning_of_every_call_that_reads_it(tmp_path):
    path = tmp_path / "m.json"
    viscard.fit("data/demo/example_relaxation.csv").material.save(path)

    def doubts(call):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            call()
        return [str(one.message) for one in caught if one.category is viscard.DoubtWarning]

    calls = [lambda: viscard.Material.load(path),
             lambda: viscard.predict(path, test="creep", stress="1 kPa", hold="1 s"),
             lambda: viscard.report([path], tmp_path / "page.html", overwrite=True)]
    assert not [text for call in calls for text in doubts(call)]
    path.write_text(path.read_text().replace('"E0_Pa": 1', '"E0_Pa": 2', 1))
    for call in calls:
        assert [text for text in doubts(call) if text.startswith(f"{path}: the file was edited")], call
    path.write_text(re.sub(r',\s*"body_sha256": "\w+"', "", path.read_text()))
    for call in calls:
        assert [text for text in doubts(call) if "has no sum of its contents" in text], call


def test_a_card_that_is_refused_leaves_no_companions(tmp_path):
    card = viscard.Material.load("data/materials/pdms_1to10_seed.json").card("mfront", "SI")
    assert card.companions
    (tmp_path / "x.mfront").write_text("mine")
    with pytest.raises(viscard.Error, match="exists already"):
        card.save(tmp_path / "x.mfront")
    assert [file.name for file in tmp_path.iterdir()] == ["x.mfront"]


def test_a_thread_is_warned_of_its_own_files_only(tmp_path):
    import threading
    good, edited = tmp_path / "good.json", tmp_path / "edited.json"
    for path in (good, edited):
        viscard.fit("data/demo/example_relaxation.csv").material.save(path)
    edited.write_text(edited.read_text().replace('"E0_Pa": 1', '"E0_Pa": 2', 1))
    from viscard import _core
    recorders, both = {}, threading.Barrier(2)

    def load(path):
        recorder = recorders[path] = _core.InputRecorder()
        both.wait()  # both record while both read
        viscard.Material.load(path)
        both.wait()
        recorders[path] = recorder.notes()

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        threads = [threading.Thread(target=load, args=(path,)) for path in (good, edited)]
        for one in threads:
            one.start()
        for one in threads:
            one.join()
    assert recorders[good] == [] and len(recorders[edited]) == 1
