#!/usr/bin/python3
"""Runs every command of viscard with --json and compares what it prints with the schemas that it writes.

check_output.py VISCARD SOURCE_FOLDER
"""
import copy
import difflib
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile

import jsonschema

VISCARD, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
SCHEMAS = {}
with tempfile.TemporaryDirectory() as written:
    subprocess.run([VISCARD, "help", "--schemas", written], check=True, stdout=subprocess.DEVNULL)
    for path in sorted(pathlib.Path(written).glob("*.schema.json")):
        schema = json.loads(path.read_text())
        jsonschema.Draft202012Validator.check_schema(schema)
        SCHEMAS[schema["properties"]["schema"]["const"]] = schema
    KEYS = pathlib.Path(written, "keys.txt").read_text()
BY_ID = {schema["$id"]: schema for schema in SCHEMAS.values()}

mistakes = []
seen = set()        # schemas of objects that were printed
commands_run = set()


def validator(schema):
    resolver = jsonschema.RefResolver(schema["$id"], schema, store=BY_ID)
    return jsonschema.Draft202012Validator(schema, resolver=resolver)


def check_object(what, text, wanted):
    try:
        printed = json.loads(text)
    except json.JSONDecodeError as error:
        mistakes.append(f"{what}: stdout is no object: {error}: {text[:200]!r}")
        return None
    name = printed.get("schema", "(none)")
    if wanted and name != wanted:
        mistakes.append(f"{what}: schema is {name}, not {wanted}: {text[:300]}")
    if name not in SCHEMAS:
        mistakes.append(f"{what}: no schema describes {name}")
        return printed
    seen.add(name)
    for error in validator(SCHEMAS[name]).iter_errors(printed):
        where = "/".join(str(part) for part in error.absolute_path)
        mistakes.append(f"{what}: {name}: {where}: {error.message[:300]}")
    return printed


def run(words, wanted=None, status=0):
    """Runs `viscard WORDS... --json`; returns the object."""
    words = [str(word) for word in words]
    done = subprocess.run([VISCARD, *words, "--json"], capture_output=True, text=True, timeout=250)
    what = "viscard " + " ".join(words)
    commands_run.add(words[0])
    if done.returncode != status:
        mistakes.append(f"{what}: exit status {done.returncode}, not {status}: {done.stderr[-400:]}")
    printed = check_object(what, done.stdout, wanted and f"viscard-{wanted}/1")
    if wanted == "error" and not done.stderr.startswith("viscard: "):
        mistakes.append(f"{what}: no message for people on stderr")
    return printed


def data(name):
    return SOURCE / "data" / name


def check_rig():
    run(["rig", "list"], "rig-list")
    run(["rig", "check", "--emulate", "--seconds", "1"], "rig-check")
    run(["rig", "touch", "--emulate"], "rig-touch")
    run(["rig", "jog", "--emulate", "--away", "0.1 mm"], "rig-move")
    bench = data("demo/01_rig.toml").read_text()
    bench = bench.replace('driver = "grbl"', 'driver = "zaber"\nmicrostep = "0.047625 um"')
    bench = bench.replace('driver = "hx711"', 'driver = "mt-sics"').replace('"0.7255 V/N"', '"1 V/N"')
    pathlib.Path("bench.toml").write_text(bench)
    run(["rig", "set-zero", "--emulate", "--rig", "bench.toml"], "rig-zero")
    run(["rig", "zero-force", "--emulate", "--rig", "bench.toml"], "rig-zero-force")
    run(["rig", "overshoot"], "rig-overshoot")
    pathlib.Path("test.toml").write_text('[ramp]\ndepth = "0.13 mm"\nduration = "1 s"\nhold = "3 s"\n')
    fast = ["--emulate", "--speed", "500", "--test", "test.toml"]
    run(["capture", *fast, "--out", "run.viscap"], "capture")
    run(["capture", *fast, "--repeat", "2", "--lift-wait", "1 s", "--out", "series"], "capture-series")
    pathlib.Path("short.toml").write_text(
        '[approach]\nspeed = "1 mm/s"\nlimit = "0.3 mm"\nbaseline = "1 s"\n'
        '[ramp]\ndepth = "0.13 mm"\nduration = "1 s"\nhold = "3 s"\n')
    run(["capture", "--emulate", "--speed", "500", "--test", "short.toml", "--out", "air.viscap"], "capture", 1)
    run(["calibrate", "--emulate", "--speed", "500", "--out", "cell.toml"], "calibrate")
    run(["calibrate", "--compliance", "--emulate", "--speed", "500", "--out", "frame.toml"], "calibrate-frame")
    run(["export", "run.viscap", "--out", "run.csv"], "export")
    run(["export", "run.viscap", "--verify"], "export-verify")


def check_serve():
    for command, *words in (("serve", "page", "--emulate"), ("desk", "tables")):
        commands_run.add(command)
        page = subprocess.Popen([VISCARD, command, *words, "--json"], stdout=subprocess.PIPE, text=True)
        text = ""
        for line in page.stdout:
            text += line
            if line.rstrip() == "}":
                break
        page.send_signal(signal.SIGINT)
        page.wait(60)
        check_object(f"viscard {command}", text, f"viscard-{command}/1")


def check_fit():
    relaxation = data("demo/example_relaxation.csv")
    printed = run(["fit", relaxation, "--out", "material.json"], "fit")
    if printed and printed["inputs"] != [str(relaxation)]:
        mistakes.append("viscard fit: inputs are not the files as named")
    run(["fit", relaxation, "--show-table"], "table")
    run(["fit", relaxation, "--curves"], "fit")
    run(["fit", relaxation, "--profiles", "--diagnose", "--bootstrap", "20"], "fit")
    run(["fit", "run.viscap", "--want", "E0=1%", "--want", "sum_g=5%"], "fit")
    run(["fit", relaxation, "missing.csv"], "fits", 1)
    printed = run(["fit", relaxation, "--plausible", "off"], "fit")
    if printed and printed.get("plausible") != "off":
        mistakes.append("viscard fit --plausible off: the object does not say so")
    material = data("materials/pdms_1to10_seed.json")
    for test in ("relaxation", "creep", "oscillation"):
        run(["predict", material, "--test", test, "--csv", f"{test}.csv"], "predict")
    run(["predict", "material.json", "--against", relaxation], "predict")
    run(["fit", "relaxation=relaxation.csv", "creep=creep.csv", "--terms", "3"], "fit")
    run(["fit", "--kind", "dma", "oscillation.csv", "--terms", "3"], "fit")
    rubber = [f"{kind}={data(f'reference/treloar_{kind}.csv')}" for kind in ("uniaxial", "equibiaxial")]
    run(["fit", *rubber, "--out", "rubber.json"], "hyperelastic")
    held = [(0.1 * i, min(2.0, 1.0 + 0.1 * i)) for i in range(150)]
    rows = [f"{t},{s},{4e5 * (s - s**-2) * (1.0 - 0.2 * t / (1.0 + t))}\n" for t, s in held]
    pathlib.Path("hold.csv").write_text("time_s,stretch,nominal_stress_Pa\n" + "".join(rows))
    run(["fit", "uniaxial=hold.csv", "--model", "neo-hooke", "--terms", "1"], "hyperelastic")


def check_card():
    material = data("materials/pdms_1to10_seed.json")
    write = ["card", material, "--for", "calculix", "--units", "mm-t-s"]
    run(write, "card-write")
    run([*write, "--out", "card.inp"], "card-write")
    run(["card", material, "--verify", "card.inp"], "card-verify")
    run(["card", "card.inp", "--import", "imported.json"], "card-import")
    run(["card", "rubber.json", "--for", "calculix"], "card-rubber")
    run(["card", "rubber.json", "--for", "abaqus", "--out", "rubber.inp"], "card-rubber")
    run(["card", "rubber.json", "--check", "rubber.inp"], "card-rubber-check")
    run(["card", "rubber.json", "--for", "calculix", "--units", "mm-t-s", "--out", "rubber_ccx.inp"], "card-rubber")
    run(["card", "rubber.json", "--prove", "rubber_ccx.inp"], "card-rubber-prove")
    run(["card", "--list"], "card-list")
    run(["card", "--check", "card.inp"], "card-check")
    run(["card", material, "--check", "card.inp"], "card-check")
    run(["card", material, "--for", "abaqus-table", "--out", "table.inp"], "card-write")
    run(["card", material, "--check", "table.inp"], "card-check")
    run(["card", material, "--for", "rayleigh", "--out", "rayleigh.txt"], "card-write")
    run(["card", material, "--check", "rayleigh.txt"], "card-check")
    run(["card", material, "--for", "calculix", "--deck", "creep", "--out", "deck"], "card-deck")
    run(["card", material, "--prove", "card.inp"], "card-prove")


def check_scenes():
    run(["validate", data("materials/pdms_1to10_seed.json")], "validate")
    run(["scene", "check", data("scenes/pillar_sensor.toml")], "scene")
    for name in ("pillar_modal", "pillar_creep", "pillar_buckling", "array_voltages", "pillar_touch", "space_quadrants",
                 "layer_rough", "space_backing"):
        scene = data(f"scenes/{name}.toml")
        run(["plan", scene], "plan")
        run(["simulate", scene, "--out", name], "simulate")
        check_object(f"{name}/results.json", pathlib.Path(name, "results.json").read_text(), "viscard-simulate/1")
    run(["simulate", data("seed/table_7_1_modes.toml")], "simulate")
    run(["simulate", data("scenes/pillar_uncertain.toml"), "--uncertainty", "--samples", "200"], "simulate")
    run(["sweep", data("studies/pillar.toml"), "--out", "study.sqlite"], "sweep")
    run(["design", "--out", "limits"], "design")
    check_object("design.json", pathlib.Path("limits/design.json").read_text(), "viscard-design/1")
    run(["design", data("scenes/pillar_sensor.toml"), "--require", data("requirements/human_hand.toml"), "--out", "judged"],
        "design-judge", 1)
    check_object("judgement.json", pathlib.Path("judged/judgement.json").read_text(), "viscard-design-judge/1")
    run(["design", data("designs/longest_pillar.toml"), "--out", "longest"], "design-front")
    check_object("design.json", pathlib.Path("longest/design.json").read_text(), "viscard-design-front/1")
    run(["cost", data("scenes/pillar_modal.toml"), "--budget", "1s"], "cost")
    bench = ["cost", "--rig", data("demo/01_rig.toml"), "--specimen", data("demo/03_pdms_1to10.toml")]
    bench += ["--at-most", "2min", "--test", data("demo/02_test.toml")]
    run([*bench, "--want", "E0=1%", "--want", "g_2=5%", "--out", "tests"], "cost-tests")
    run([*bench, "--want", "E0"], "error", 2)


def check_rest():
    run(["report", data("materials/pdms_1to10_seed.json"), "--out", "page.html"], "report")
    run(["demo", "--speed", "500", "--out", "demo"], "demo")
    ratios = ["10", "13", "20"]
    files = [f"demo/pdms_1to{ratio}.json" for ratio in ratios]
    run(["fit", "--joint", *files, *[word for ratio in ratios for word in ("--ratio", ratio)]], "joint")
    run(["completion", "bash"], "completion")
    run(["--version"], "version")
    for command in [one["name"] for one in run(["help"], "commands")["commands"]]:
        shown = run(["help", command], "help")
        if shown != run([command, "--help"], "help"):
            mistakes.append(f"viscard help {command} and viscard {command} --help differ")
        run([command, "--no-such-option"], "error", 2)
        if command != "demo":
            printed = subprocess.run([VISCARD, command, "/nowhere/no-such-file", "--json"], capture_output=True, text=True)
            check_object(f"viscard {command} /nowhere/no-such-file", printed.stdout, "viscard-error/1")
        if command not in commands_run:
            mistakes.append(f"viscard {command} was not run")
    run(["no-such-command"], "error", 2)
    run(["export", "series", "--out", "/nowhere/run.csv"], "error", 1)


def check_keys():
    """Keys, their types and "?" of those that are not always there are kept in keys.txt."""
    kept = pathlib.Path(__file__).with_name("keys.txt").read_text()
    change = difflib.unified_diff(kept.splitlines(), KEYS.splitlines(), "keys.txt", "viscard help --schemas", n=0, lineterm="")
    mistakes.extend(change)


def check_that_mistakes_are_found():
    """A schema that accepted anything would find nothing wrong."""
    good = json.loads(subprocess.run([VISCARD, "--version", "--json"], capture_output=True, text=True).stdout)
    for change in ({"program": 3}, {"extra": 1}, {"version": None}):
        bad = {**copy.deepcopy(good), **change}
        if validator(SCHEMAS["viscard-version/1"]).is_valid(bad):
            mistakes.append(f"the schema of --version accepts {change}")
    del good["schema"]
    if validator(SCHEMAS["viscard-version/1"]).is_valid(good):
        mistakes.append("the schema of --version accepts an object without schema")


def main():
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for part in (check_rig, check_serve, check_fit, check_card, check_scenes, check_rest, check_keys,
                     check_that_mistakes_are_found):
            try:
                part()
            except Exception as error:  # what follows is still run
                mistakes.append(f"{part.__name__}: {type(error).__name__}: {error}")
        os.chdir("/")
    for name in sorted(set(SCHEMAS) - seen):
        mistakes.append(f"no command printed {name}")
    for mistake in mistakes:
        print(mistake)
    print(f"{len(seen)} of {len(SCHEMAS)} schemas, {len(mistakes)} mistakes")
    sys.exit(1 if mistakes else 0)


main()
