"""Tables and captures as arrays."""
import sqlite3

import numpy as np
import pytest

import viscard


def test_a_table_is_in_SI_and_keeps_what_the_file_says(tmp_path):
    path = tmp_path / "t.csv"
    path.write_text("# rig 7\nTime [ms],Force [mN]\n0,1\n500,2.5\n")
    table = viscard.read_table(path)
    assert sorted(table) == ["force_N", "time_s"]
    np.testing.assert_array_equal(table["time_s"], [0.0, 0.5])
    np.testing.assert_allclose(table["force_N"], [1e-3, 2.5e-3], rtol=1e-15)
    assert table.columns[1]["unit"] == "mN"
    np.testing.assert_array_equal(table.columns[1]["values"], [1.0, 2.5])
    with pytest.raises(KeyError, match="has no depth_m; it has time_s, force_N"):
        table["depth_m"]


def test_a_column_can_be_named(tmp_path):
    path = tmp_path / "t.csv"
    path.write_text("a,b\n0,7\n1,8\n")
    table = viscard.read_table(path, column=["time_s=a", "modulus_Pa=1e3*b"])
    np.testing.assert_array_equal(table["modulus_Pa"], [7e3, 8e3])


def test_arrays_own_their_memory(tmp_path):
    path = tmp_path / "t.csv"
    path.write_text("time_s,modulus_Pa\n1,2\n3,4\n")
    values = viscard.read_table(path)["modulus_Pa"]  # the table itself is gone
    np.testing.assert_array_equal(values, [2.0, 4.0])


def test_a_capture_equals_its_database_and_is_not_copied(run):
    capture = viscard.read_capture(run)
    with sqlite3.connect(f"file:{run}?mode=ro", uri=True) as database:
        rows = database.execute("select host_time_s, counts from load_samples order by rowid").fetchall()
    np.testing.assert_array_equal(capture.load["time_s"], [row[0] for row in rows])
    np.testing.assert_array_equal(capture.load["counts"], [row[1] for row in rows])
    assert capture.load["time_s"].base is not None and capture.load["time_s"].strides[0] > 8  # a view
    time_s = capture.load["time_s"]
    first = time_s[0]
    del capture  # the view keeps the record alive
    assert time_s[0] == first and np.all(np.diff(time_s) >= 0)


def test_the_table_of_a_capture_is_what_export_writes(run, program, tmp_path):
    import subprocess
    out = tmp_path / "run.csv"
    subprocess.run([program, "export", run, "--out", str(out)], check=True, capture_output=True)
    ours, theirs = viscard.read_capture(run).table(), viscard.read_table(out)
    for name in ("time_s", "force_N", "depth_m"):
        np.testing.assert_array_equal(ours[name], theirs[name])


def test_every_reading_reaches_the_callback_in_this_thread(tmp_path, short_test):
    import threading
    readings, threads, steps = [], set(), []

    def sample(*reading):
        readings.append(reading)
        threads.add(threading.get_ident())

    path = tmp_path / "run.viscap"
    outcome = viscard.capture(path, test=short_test, emulate=True, speed=200, sample=sample,
                              progress=lambda done, phase: steps.append(phase))
    assert outcome.status == "finished" and threads == {threading.get_ident()}
    time_s, force_N, depth_m = np.array(readings).T
    assert np.all(np.diff(time_s) > 0) and force_N.max() == pytest.approx(outcome["peak_force_N"], rel=0.02)
    assert len(readings) <= len(outcome.read().load["time_s"])
    assert "ramp" in steps


def test_a_sample_that_returns_False_ends_the_run_and_keeps_the_record(tmp_path, short_test):
    outcome = viscard.capture(tmp_path / "run.viscap", test=short_test, emulate=True, speed=50,
                              sample=lambda t, force, depth: force < 0.2)
    assert outcome.status == "interrupted"
    assert outcome.read().status == "interrupted"


def test_an_exception_of_a_callback_ends_the_run_and_is_raised(tmp_path, short_test):
    def sample(time_s, force_N, depth_m):
        if force_N > 0.2:
            raise ZeroDivisionError("mine")

    path = tmp_path / "run.viscap"
    with pytest.raises(ZeroDivisionError, match="mine"):
        viscard.capture(path, test=short_test, emulate=True, speed=50, sample=sample)
    assert viscard.read_capture(path).status == "interrupted"


def test_damage_of_a_capture_goes_with_its_table_into_every_use(tmp_path, relaxation):
    time_s, modulus_Pa = relaxation
    path = tmp_path / "damaged.csv"
    head = "# load-cell samples of a capture, written by viscard 0.1.0\n# damage: unverified: its moves are damaged\n"
    path.write_text(head + "time_s,modulus_Pa\n" + "".join(f"{t},{m}\n" for t, m in zip(time_s, modulus_Pa)))
    table = viscard.read_table(path)
    assert "damage: unverified: its moves are damaged" in table.comments
    material = viscard.Material(1.5e6, 0.49, terms=[(1 / 3, 2.0)])
    for one in (path, table):
        with pytest.raises(viscard.Error, match="damaged capture"):
            viscard.fit(one)
        with pytest.raises(viscard.Error, match="damaged capture"):
            viscard.predict(material, against=one)
        with pytest.warns(viscard.DoubtWarning):
            found = viscard.fit(one, unverified=True)
        assert not found.is_trustworthy and "unverified" in [flag["name"] for flag in found.json["flags"]]
        assert any("unverified" in note for note in viscard.predict(material, against=one, unverified=True).notes)


def test_a_frame_of_pandas_keeps_the_damage_of_its_table(tmp_path):
    pytest.importorskip("pandas")
    path = tmp_path / "damaged.csv"
    path.write_text("# load-cell samples of a capture, written by viscard 0.1.0\n# damage: unverified: its moves\n"
                    "time_s,modulus_Pa\n" + "".join(f"{t},{1e6 + t}\n" for t in range(40)))
    with pytest.raises(viscard.Error, match="damaged capture"):
        viscard.fit(viscard.read_table(path).to_frame())
