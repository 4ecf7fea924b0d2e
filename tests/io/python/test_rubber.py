"""Tests at large strain: beside the command line, and stresses beside their closed forms."""
import json
import math
import pathlib
import subprocess

import numpy as np
import pytest

import viscard

FILES = {name: f"data/reference/treloar_{name}.csv" for name in ("uniaxial", "planar", "equibiaxial")}
WORDS = [f"{name}={path}" for name, path in FILES.items()]


@pytest.fixture(scope="module")
def rubber():
    return viscard.fit([f"{name}={pathlib.Path(path)}" for name, path in FILES.items()])


def test_it_is_what_the_command_prints(program):
    rubber = viscard.fit(WORDS, weight="relative", youngs_modulus="1.2 MPa +- 0.1 MPa")
    options = ["--weight", "relative", "--youngs-modulus", "1.2 MPa +- 0.1 MPa"]
    printed = json.loads(subprocess.run([program, "fit", *WORDS, *options, "--json"], capture_output=True).stdout)
    # The file has a sum of its own, the command names the files that it has read.
    assert rubber.json.keys() - printed.keys() == {"body_sha256"} and printed.pop("input_files")
    assert {key: rubber.json[key] for key in printed} == printed
    text = subprocess.run([program, "fit", *WORDS, *options], capture_output=True, text=True,
                          env={"COLUMNS": ""}).stdout
    assert rubber.summary() == text


def test_the_least_squares_of_treloar(rubber):
    # 0.2048079328 MPa^2 of ogden-3: tests/fit/large_strain, by SciPy.
    assert rubber.law == "ogden-3" and rubber.is_trustworthy
    assert rubber.laws["ogden-3"]["rss_Pa2"] == pytest.approx(0.2048079328e12, rel=1e-6)
    residuals = [rubber.stress(stretch, name) - stress for name, (stretch, stress) in zip(FILES, rubber.tests)]
    assert np.sum(np.concatenate(residuals) ** 2) == pytest.approx(0.2048079328e12, rel=1e-6)
    assert rubber.covariance.shape == (6, 6) and len(rubber.parameters) == 6
    low, high = rubber.E0_interval
    assert low < rubber.E0_Pa < high


def test_stresses_are_those_of_closed_forms():
    rubber = viscard.fit(WORDS, model="mooney-rivlin")
    C10, C01 = (rubber.parameters[name].value for name in ("C10_Pa", "C01_Pa"))
    s = np.array([[0.7, 1.0], [1.5, 3.0]])
    of_closed_form = {"uniaxial": 2 * (s - s**-2) * (C10 + C01 / s), "planar": 2 * (s - s**-3) * (C10 + C01),
                      "equibiaxial": 2 * (s - s**-5) * (C10 + C01 * s**2)}
    for name, expected in of_closed_form.items():
        assert rubber.stress(s, name) == pytest.approx(expected, rel=1e-12, abs=1e-6)
    with pytest.raises(viscard.Error, match="deformation is 'shear'; use uniaxial, planar or equibiaxial"):
        rubber.stress(2.0, "shear")
    with pytest.raises(viscard.Error, match="above 0"):
        rubber.stress([1.0, 0.0])


def body(card):
    """A card without the lines of its header that tell when, from which file and by which command it was written."""
    of_origin = ("card sha256", "material file", "created ", "by viscard")
    return [line for line in card.splitlines() if not any(word in line for word in of_origin)]


def test_file_and_cards_are_those_of_the_command(rubber, program, tmp_path):
    rubber.save(tmp_path / "rubber.json")
    with pytest.raises(viscard.Error, match="exists") as caught:
        rubber.save(tmp_path / "rubber.json")
    assert caught.value.code == "exists"
    again = viscard.RubberFit.load(tmp_path / "rubber.json")
    assert again.json == rubber.json and again.E0_interval == rubber.E0_interval
    for target in ("abaqus", "ansys", "febio"):
        card = subprocess.run([program, "card", "rubber.json", "--for", target, "--units", "mm-t-s",
                               "--bulk-modulus", "1 GPa"], capture_output=True, text=True, cwd=tmp_path).stdout
        assert body(again.card(target, "mm-t-s", bulk_modulus_Pa=1e9).text) == body(card)
    with pytest.raises(viscard.Error, match="no card of rubber for 'sofa'"):
        rubber.card("sofa")
    with pytest.raises(viscard.Error, match="bulk"):
        rubber.card("abaqus", bulk_modulus_Pa=-1.0)


def test_a_cycle_is_chosen(tmp_path):
    # Neo-Hooke of 0.4 MPa first, 0.2 MPa in the second cycle.
    up = np.linspace(1.0, 2.0, 30)
    stretch = np.concatenate([up, up[::-1], up, up[::-1]])
    stress = np.where(np.arange(120) < 60, 4e5, 2e5) * (stretch - stretch**-2)
    path = tmp_path / "cycles.csv"
    np.savetxt(path, np.column_stack([stretch, stress]), delimiter=",", header="stretch,nominal_stress_Pa", comments="")
    first, last = (viscard.fit([f"uniaxial={path}"], model="neo-hooke", cycle=cycle) for cycle in (1, None))
    assert first.parameters["C10_Pa"].value == pytest.approx(2e5, rel=1e-6)
    assert last.parameters["C10_Pa"].value == pytest.approx(1e5, rel=1e-6)
    assert "mullins" in [flag.name for flag in first.flags]
    with pytest.raises(viscard.Error, match="no cycle 5"):
        viscard.fit([f"uniaxial={path}"], cycle=5)


def test_options_that_do_not_belong_are_refused():
    for keywords, words in (({"drift": True}, "drift does not belong to tests at large strain"),
                            ({"weight": "huge"}, "weight huge is not known"),
                            ({"model": "yeo"}, "model yeo is no law of rubber"),
                            ({"youngs_modulus": "1 m"}, "youngs_modulus 1 m")):
        with pytest.raises(viscard.Error, match=words) as caught:
            viscard.fit(WORDS[:1], **keywords)
        assert caught.value.code == "usage"
    with pytest.raises(viscard.Error, match="cycle is for tests at large strain"):
        viscard.fit("data/demo/example_relaxation.csv", cycle=1)
    with pytest.raises(viscard.Error, match="is no test at large strain, but others are"):
        viscard.fit([WORDS[0], "data/demo/example_relaxation.csv"])


def test_the_plot_shows_readings_and_law(rubber):
    axes = rubber.plot()
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("stretch", "nominal stress (MPa)")
    assert len(axes.lines) == 6


def rate_and_hold(path, stress_Pa_of):
    time_s = np.arange(0.0, 21.0, 0.1)
    stretch = np.minimum(2.0, 1.0 + time_s)
    stress = stress_Pa_of(time_s, stretch)
    np.savetxt(path, np.column_stack([time_s, stretch, stress]), delimiter=",", comments="",
               header="time_s,stretch,nominal_stress_Pa")
    return f"uniaxial={path}"


def test_relaxation_beside_the_law(tmp_path):
    # Neo-Hooke without terms first: its stress with times is that of the law.
    def elastic(time_s, stretch):
        return 4e5 * (stretch - stretch**-2) + 100.0 * np.random.default_rng(1).standard_normal(time_s.size)

    rubber = viscard.fit([rate_and_hold(tmp_path / "elastic.csv", elastic)], model="neo-hooke")
    assert rubber.terms == [] and rubber.E_inf_Pa == rubber.E0_Pa
    assert rubber.stress([1.0, 1.5], time_s=[0.0, 1.0]) == pytest.approx(rubber.stress([1.0, 1.5]))

    # By the linear convolution of S = 2 C10 (1 - s^-3) (2/3, and -s^3/3 on the side) with exp(-t/tau).
    def relaxing(time_s, stretch):
        fine = np.linspace(0.0, 1.0, 4001)
        s = 1.0 + fine
        parts = np.array([4e5 * 2 / 3 * (1 - s**-3), -4e5 / 3 * (s**3 - 1)])
        rate = np.gradient(parts, fine, axis=1)
        out = []
        for t, at in zip(time_s, stretch):
            until = fine <= t + 1e-12
            kernel = 0.7 + 0.3 * np.exp(-(t - fine[until]) / 2.0)
            first, side = (np.trapz(kernel * r[until], fine[until]) for r in rate)
            out.append((at**2 * first - side / at) / at)
        return np.array(out) + 100.0 * np.random.default_rng(2).standard_normal(time_s.size)

    word = rate_and_hold(tmp_path / "relaxing.csv", relaxing)
    rubber = viscard.fit([word], model="neo-hooke")
    (term,) = rubber.terms
    assert term.g == pytest.approx(0.3, rel=0.01) and term.tau_s == pytest.approx(2.0, rel=0.02)
    assert term.g_interval[0] < term.g < term.g_interval[1]
    assert rubber.E_inf_Pa == pytest.approx(0.7 * rubber.E0_Pa, rel=0.01)
    assert rubber.series_covariance.shape == (3, 3)
    stretch, _ = rubber.tests[0]
    assert rubber.stress(stretch, time_s=rubber.times[0]) == pytest.approx(rubber.fitted[0], rel=1e-9, abs=1e-3)
    rubber.save(tmp_path / "rubber.json")
    again = viscard.RubberFit.load(tmp_path / "rubber.json")
    assert again.terms == rubber.terms
    assert "*VISCOELASTIC, TIME=PRONY" in again.card("abaqus", "mm-t-s").text
    with pytest.raises(viscard.Error, match="terms of relaxation.*elastic_only"):
        again.card("calculix", "mm-t-s")
    at_rest = again.card("calculix", "mm-t-s", elastic_only="long-term").text.splitlines()
    row = at_rest[at_rest.index("*HYPERELASTIC, NEO HOOKE") + 1]
    assert 6e6 * float(row.split(",")[0]) == pytest.approx(again.E_inf_Pa, rel=1e-9)
    with pytest.raises(viscard.Error, match="approximate=True"):
        again.card("lsdyna", "mm-t-s", density_kg_m3=1100.0)
    assert "BETAI" in again.card("lsdyna", "mm-t-s", density_kg_m3=1100.0, approximate=True).text
    with pytest.raises(viscard.Error, match="use instantaneous or long-term"):
        again.card("abaqus", elastic_only="later")
    with pytest.raises(viscard.Error, match="time_s has the shape"):
        rubber.stress([1.0, 2.0], time_s=[0.0])
    assert viscard.fit([word], model="neo-hooke", terms=0).terms == []


def test_a_record_of_cycles_gives_the_damage_of_the_first_loading(tmp_path):
    # Neo-Hooke of C10 = 0.3 MPa with r 1.5, m 0.05 MPa, from one maximum: beta is held at 0.
    up = np.linspace(1.0, 1.8, 40)
    stretch = np.concatenate([up, up[::-1], up])
    energy = 3e5 * (stretch**2 + 2.0 / stretch - 3.0)
    drop = (np.maximum.accumulate(energy) - energy) / 5e4
    eta = 1.0 - np.array([math.erf(x) for x in drop]) / 1.5
    stress = eta * 6e5 * (stretch - stretch**-2)
    path = tmp_path / "cycles.csv"
    np.savetxt(path, np.column_stack([stretch, stress]), delimiter=",", header="stretch,nominal_stress_Pa", comments="")
    rubber = viscard.fit([f"uniaxial={path}"], model="neo-hooke+mullins-or")
    assert rubber.damage["r"].value == pytest.approx(1.5, rel=1e-6)
    assert rubber.damage["m_Pa"].value == pytest.approx(5e4, rel=1e-5)
    assert rubber.damage["beta"].value == 0.0
    assert "one-maximum" in [flag.name for flag in rubber.flags]
    assert rubber.stress(stretch) == pytest.approx(stress, rel=1e-5, abs=1.0)
    assert "*MULLINS EFFECT" in rubber.card("abaqus").text
    with pytest.raises(viscard.Error, match="calculix cannot take the damage"):
        rubber.card("calculix")


def test_tests_of_a_foam_give_its_law(tmp_path):
    # One term, nu = 0.2: the side is s^-0.2, and the force follows from the energy.
    s = np.linspace(0.5, 1.1, 40)
    volume = s**0.6
    stress = 2 * 5e4 / 8 * (s**8 - volume ** (-8 / 3)) / s
    path = tmp_path / "foam.csv"
    np.savetxt(path, np.column_stack([s, s**-0.2, stress]), delimiter=",", comments="",
               header="stretch,lateral_stretch,nominal_stress_Pa")
    foam = viscard.fit([f"uniaxial={path}"], model="hyperfoam-1")
    assert foam.law == "hyperfoam-1"
    assert foam.parameters["mu_1_Pa"].value == pytest.approx(5e4, rel=1e-6)
    assert foam.parameters["nu"].value == pytest.approx(0.2, rel=1e-6)
    assert foam.stress(0.5) == pytest.approx(stress[0], rel=1e-6)
    assert foam.stress([0.1, 0.2], "shear") == pytest.approx([5125.75125, 11024.16], rel=1e-5)
    assert "*HYPERFOAM, N=2" in foam.card("calculix").text
    with pytest.raises(viscard.Error, match="no card of a foam"):
        foam.card("febio")
