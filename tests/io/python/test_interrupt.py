"""Ctrl-C in long work, as a user has it: in a process of its own."""
import os
import signal
import subprocess
import sys
import time

import viscard

LONG = """
import viscard
def working(*news):
    print("ready", flush=True)
try:
    {call}
except KeyboardInterrupt:
    print("interrupted", flush=True)
    raise
"""
SIMULATE = "print('ready', flush=True); viscard.simulate('data/scenes/array_tap.toml', tol=3e-3)"  # minutes


def interrupted(call):
    """Interrupts what has printed "ready", somewhat later."""
    # A shell starts background work with SIGINT ignored, which children would inherit.
    process = subprocess.Popen([sys.executable, "-c", LONG.format(call=call)], stdout=subprocess.PIPE, text=True,
                               stderr=subprocess.PIPE, preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
    assert process.stdout.readline() == "ready\n"
    time.sleep(0.4)
    assert process.poll() is None, process.stderr.read()  # still at work
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=60)
    return process.returncode, out.replace("ready\n", ""), err


def test_a_simulation_ends_at_once_and_by_the_signal():
    status, out, err = interrupted(SIMULATE)
    assert out == "interrupted\n" and "KeyboardInterrupt" in err
    assert status == -signal.SIGINT


def test_a_bootstrap_ends_at_once():
    status, out, err = interrupted("print('ready', flush=True); viscard.fit('data/demo/example_relaxation.csv', bootstrap=100000)")
    assert out == "interrupted\n" and status == -signal.SIGINT, err


def test_a_capture_brakes_the_stage_and_keeps_the_record(tmp_path):
    file = tmp_path / "run.viscap"
    status, out, err = interrupted(f"viscard.capture({str(file)!r}, emulate=True, speed=5, sample=working)")
    assert out == "interrupted\n" and status == -signal.SIGINT
    capture = viscard.read_capture(file)
    assert capture.status == "interrupted" and len(capture.load["time_s"]) > 0


def test_a_program_that_goes_on_after_CtrlC_ends_well():
    code = f"""
import viscard
def stop(*news):
    raise KeyboardInterrupt
try:
    viscard.simulate('data/scenes/pillar_press.toml', progress=stop)
except KeyboardInterrupt:
    pass
print(viscard.simulate('data/scenes/pillar_press.toml')['top_force'] != 0)
"""
    found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=120)
    assert (found.returncode, found.stdout) == (0, "True\n"), found.stderr
