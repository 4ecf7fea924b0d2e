"""Scenes from files and dicts."""
import copy
import json
import subprocess
import threading
import time
import warnings

import numpy as np
import pytest

import viscard

PRESS = {
    "tolerance": 1e-3,
    "geometry": {"diameter": "40 um", "length": "120 um",
                 "film": {"thickness": "25 um", "radius": "60 um", "material": "pvdf"},
                 "electrode": {"face": "top", "kind": "equipotential", "radius": "20 um"}},
    "materials": {"pillar": {"E": "1.8 MPa", "nu": 0.33, "rho": "965 kg/m3"},
                  "pvdf": {"file": "data/materials/pvdf_film_manual.json"}},
    "analysis": {"kind": "static", "load": {"displacement": "-1 um", "on": "top"}},
}


def test_an_answer_equals_the_command_line(program):
    for scene in ("pillar_press", "pillar_modal"):
        path = f"data/scenes/{scene}.toml"
        printed = json.loads(subprocess.run([program, "simulate", path, "--json"], capture_output=True,
                                            text=True, check=True).stdout)
        answer = viscard.simulate(path)
        assert {name: v.value for name, v in answer.results.items()} == \
            {name: v["value"] for name, v in printed["results"].items()}
        np.testing.assert_array_equal(answer.frequencies_Hz, [m["frequency_Hz"] for m in printed["modes"]])
        assert answer.unknowns == printed["unknowns"]


def test_an_effect_that_is_not_computed_is_doubted_as_the_command_does(program, tmp_path):
    bent = {"tolerance": 1e-2, "geometry": {"diameter": "40 um", "length": "120 um"},
            "materials": {"pillar": {"E": "1.8 MPa", "nu": 0.33, "rho": "965 kg/m3"}},
            "analysis": {"kind": "static", "load": {"shear": "10 kPa", "on": "top", "direction": "lateral"}}}
    with pytest.warns(viscard.DoubtWarning, match="not within the tolerance: finite_strain is not computed"):
        answer = viscard.simulate(bent)
    assert answer.within_tolerance and not answer.effects_within_tolerance
    file = tmp_path / "bent.toml"
    file.write_text("""tolerance = 1e-2
[geometry]
diameter = "40 um"
length = "120 um"
[materials]
pillar = { E = "1.8 MPa", nu = 0.33, rho = "965 kg/m3" }
[analysis]
kind = "static"
load = { shear = "10 kPa", on = "top", direction = "lateral" }
""")
    printed = subprocess.run([program, "simulate", file], capture_output=True, text=True, check=True).stdout
    assert printed.split("\n")[0] == f"{file}: {answer.tolerance_doubt}"
    with warnings.catch_warnings():
        warnings.simplefilter("error", viscard.DoubtWarning)
        answer = viscard.simulate({**bent, "tolerance": 0.5})
    assert answer.effects_within_tolerance and answer.tolerance_doubt == ""


def test_a_dict_equals_its_file():
    of_file, of_dict = viscard.simulate("data/scenes/pillar_press.toml"), viscard.simulate(PRESS)
    assert of_file.results == of_dict.results
    with_numbers = copy.deepcopy(PRESS)
    with_numbers["geometry"]["diameter"] = np.float64(40e-6)
    with_numbers["analysis"]["load"]["displacement"] = -1e-6
    with_numbers["materials"]["pillar"] = viscard.Material(1.8e6, 0.33, rho_kg_m3=965)
    assert viscard.simulate(with_numbers)["top_force"] == pytest.approx(of_file["top_force"], rel=1e-9)
    with_folder = copy.deepcopy(PRESS)
    with_folder["materials"]["pvdf"]["file"] = "pvdf_film_manual.json"
    assert viscard.simulate(with_folder, folder="data/materials").results == of_file.results


def test_two_scenes_beside_each_other_are_those_of_the_command(program, tmp_path):
    paths = []
    for name, modulus in (("stiff", "2 MPa"), ("soft", "1 MPa")):
        paths.append(tmp_path / f"{name}.toml")
        paths[-1].write_text(f"""[geometry]
diameter = "40 um"
length = "120 um"
[materials]
pillar = {{ E = "{modulus}", nu = 0.33, rho = "965 kg/m3" }}
[analysis]
kind = "modal"
modes = 1
""")
    found = viscard.simulate(paths[0], compare=paths[1]).compared
    printed = json.loads(subprocess.run([program, "simulate", *map(str, paths[:1]), "--compare", str(paths[1]), "--json"],
                                        capture_output=True, text=True, check=True).stdout)["compared"]
    assert found["scene"] == str(paths[1])
    assert [one["ratio"] for one in found["values"]] == [one["ratio"] for one in printed["values"]]
    assert found["values"][0]["ratio"] == pytest.approx(np.sqrt(2.0), rel=1e-3)
    assert viscard.simulate(paths[0]).compared is None
    with pytest.raises(viscard.Error, match="absent.toml"):
        viscard.simulate(paths[0], compare=tmp_path / "absent.toml")


def test_the_processor_time_of_a_study_of_costs_is_limited():
    found = viscard.cost(PRESS, budget=20, cpu_budget="0.2 s")
    assert found.json["rows_left_out"] > 0
    with pytest.raises(viscard.Error, match="cpu_budget is 0 s; it must be positive"):
        viscard.cost(PRESS, cpu_budget=0)


def test_fields_are_arrays():
    answer = viscard.simulate(PRESS, fields=True)
    field = answer.fields[0]
    moved = field.values["displacement_m"]["value"]
    assert moved.shape == (field.x_m.size, 3) and field.quads.shape[1] == 4
    assert field.quads.max() < field.x_m.size
    top = moved[field.z_m >= field.z_m.max() * (1 - 1e-12), 2]
    np.testing.assert_allclose(top, -1e-6, rtol=1e-6)  # the plate
    modes = viscard.simulate("data/scenes/pillar_modal.toml", fields=True)
    assert {f.name for f in modes.fields} <= {m["family"] for m in modes.modes}


def test_curves_and_maps_are_arrays(program):
    creep = viscard.simulate("data/scenes/pillar_creep.toml")
    assert creep.curves
    for curve in creep.curves.values():
        assert curve["x"].shape == curve["value"].shape
    answer = viscard.simulate("data/scenes/space_array.toml", tol=0.05)
    assert answer.maps
    for each in answer.maps.values():
        assert each["value"].ndim == 2 and np.isfinite(each["value"]).any()
        assert np.nanmax(each["value"]) >= np.nanmin(each["value"])
    assert answer.x_m.shape == answer.y_m.shape


def test_a_sweep_names_its_points():
    answer = viscard.simulate("data/seed/array_spacing.toml", tol=0.02)
    assert "centre_voltage_1 at spacing 20 um" in answer.results
    deviation = {name: v.value for name, v in answer.results.items() if name.startswith("deviation")}
    below = [name for name, value in deviation.items() if abs(value) < 0.1]  # the limit of the scene
    assert below[0] == f"deviation_percent_1 at spacing {answer['first_spacing'] * 1e6:.0f} um"


def test_plan_and_cost():
    plan = viscard.plan(PRESS, tol=1e-2)
    assert plan.tolerance == 1e-2 and {e["name"] for e in plan.effects} >= {"piezo_coupling"}
    with pytest.raises(KeyError, match="no effect 'magic'"):
        plan.is_on("magic")
    seen = []
    cost = viscard.cost(PRESS, budget="1 s", progress=lambda done, row: seen.append(row))
    assert cost.error.shape == cost.cpu_s.shape == cost.pareto.shape and cost.pareto.any() and seen
    with pytest.raises(viscard.Error, match="budget is -1 s; it must be positive"):
        viscard.cost(PRESS, budget=-1)


def test_progress_is_called_in_this_thread_and_its_exception_is_raised():
    threads = set()
    viscard.simulate(PRESS, progress=lambda done, point: threads.add(threading.get_ident()))
    assert threads == {threading.get_ident()}

    def stop(done, point):
        raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        viscard.simulate(PRESS, progress=stop)


def test_other_threads_run_meanwhile_and_answers_do_not_mix():
    answers, ticks, is_done = {}, [], threading.Event()

    def tick():
        while not is_done.wait(0.002):
            ticks.append(time.monotonic())

    def solve(um):
        scene = copy.deepcopy(PRESS)
        scene["geometry"]["length"] = f"{um} um"
        answers[um] = viscard.simulate(scene)["top_force"]

    ticker = threading.Thread(target=tick)
    workers = [threading.Thread(target=solve, args=(um,)) for um in (80, 100, 120)]
    ticker.start()
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    is_done.set()
    ticker.join()
    assert ticks
    for um, force in answers.items():
        scene = copy.deepcopy(PRESS)
        scene["geometry"]["length"] = f"{um} um"
        assert viscard.simulate(scene)["top_force"] == force


def test_a_judgement_equals_the_command_line(program):
    scene, hand = "data/scenes/pillar_sensor.toml", "data/requirements/human_hand.toml"
    done = subprocess.run([program, "design", scene, "--require", hand, "--json"], capture_output=True, text=True)
    assert done.returncode == 1
    judgement = viscard.design(scene, hand)
    assert not judgement.passes and judgement.lines == json.loads(done.stdout)["lines"]
    assert "not answered" in judgement.summary()
    with pytest.raises(viscard.Error, match="crosstalk"):
        viscard.design(PRESS, {"crosstalc": 0.1})
    assert viscard.design(PRESS, {"largest_pressure": "10 kPa"}).passes
