"""Data as a user holds them: steps that leave the files alone, are saved, and are done again."""

from pathlib import Path

import numpy as np
import pytest

from pysim.io import read_dataset
from pysim.io.prepare import step_typed
from pysim.nouns.data import Data, load
from pysim.types import BadInput, Record

TIME = np.arange(500) / 100


def logs() -> Data:
    """Two runs of a force and a position, the second with an empty cell."""
    frames = {}
    for k, name in enumerate(("run1", "run2")):
        x = 3 * np.sin(2 * np.pi * (k + 1) * TIME)
        x[120] = np.nan if k else x[120]
        frames[name] = {"t [s]": TIME, "F [kN]": np.cos(2 * np.pi * TIME), "x [mm]": x}
    return load(frames, inputs="F", outputs="x", noise={"x": 0.02})


def log_of(data: Data, name: str) -> Record:
    found = data[name].data
    assert isinstance(found, Record)
    return found


def test_headings_give_units_and_everything_is_in_si() -> None:
    data = logs()
    np.testing.assert_allclose(log_of(data, "run1")["x"], 3e-3 * np.sin(2 * np.pi * TIME), atol=1e-15)
    assert log_of(data, "run1").units == ("N", "m")
    assert data.now.signal("x").noise == pytest.approx(2e-5)


def test_an_empty_cell_of_an_input_is_refused_with_the_line_that_fills_it() -> None:
    frame = {"t [s]": TIME, "F [N]": np.where(TIME == 1.2, np.nan, TIME**2), "x [m]": TIME}
    raw = load(frame, inputs="F", outputs="x", time="t")
    with pytest.raises(BadInput) as refused:
        _ = raw.dataset
    line = str(refused.value).partition("data = data.")[2].partition(" fills")[0]
    data = eval(f"data.{line}", {"data": raw})
    force = data.dataset.records[0].data["F"]
    assert force[120] == pytest.approx(0.5 * (force[119] + force[121]))


def test_an_empty_cell_of_an_output_stays_empty_until_it_is_asked_to_be_filled() -> None:
    assert np.isnan(log_of(logs().fill_gaps(0.03), "run2")["x"][120])
    assert np.isnan(logs().dataset.records[1].data["x"][120])
    x = log_of(logs().fill_gaps(0.03, "x"), "run2")["x"]
    assert x[120] == pytest.approx(0.5 * (x[119] + x[121]))


def test_every_step_gives_a_new_one_and_is_listed() -> None:
    raw = logs()
    data = raw.trim(start=0.5).fill_gaps(0.03).flip("x").hold_out("run2")
    assert raw.history == ()
    assert np.isnan(log_of(raw, "run2")["x"][120])
    assert [step.word for step in data.history] == ["trim", "fill_gaps", "flip", "hold_out"]
    assert [record.use for record in data.now.records] == ["fit", "test"]
    np.testing.assert_array_equal(log_of(data, "run1")["x"], -log_of(raw, "run1")["x"][50:])


def test_names_may_stand_in_a_list_and_other_kinds_are_refused() -> None:
    raw = logs()
    assert raw.hold_out(["run1", "run2"]).history == raw.hold_out("run1", "run2").history
    assert raw.flip(["x"]).history == raw.flip("x").history
    for ask, said in (
        (lambda: raw.trim("a"), "start: 'a' is no number"),
        (lambda: raw.resample(None), "hz: None is no number"),
        (lambda: raw.lowpass("x", "F"), "hz: 'x' is no number"),
        (lambda: raw.rename(["x"]), "names: a list has no names"),
        (lambda: raw[0], "there is no log 0; name one of run1, run2"),
        (lambda: raw.save(3), "folder: 3 is no path"),
        (lambda: load({"t": [0, 1], "x": [0, 1]}, inputs="F", outputs="x", noise=0.1), "noise: 0.1 has no names"),
    ):
        with pytest.raises(BadInput, match=said):
            ask()  # type: ignore[no-untyped-call]


def test_some_logs_alone_are_turned_and_scaled(tmp_path: Path) -> None:
    """The word of the command line does the same, and a saved folder does it again."""
    raw = logs().fill_gaps(0.03)
    for k, (data, gain) in enumerate(
        (
            (raw.flip("x", logs="run2"), -1.0),
            (raw.after(step_typed("flip:x,logs=run2")), -1.0),
            (raw.scale("x", 10.0, logs=["run2"]), 10.0),
            (raw.after(step_typed("scale:x,factor=10,logs=run2")), 10.0),
        )
    ):
        for one in (data, load(data.save(tmp_path / str(k)))):
            np.testing.assert_allclose(log_of(one, "run1")["x"], log_of(raw, "run1")["x"], rtol=1e-12)
            np.testing.assert_allclose(log_of(one, "run2")["x"], gain * log_of(raw, "run2")["x"], rtol=1e-12)
            assert one.now.signal("x").noise == pytest.approx(2e-5)
            assert one.to_dataframe().columns.tolist() == raw.to_dataframe().columns.tolist()


def test_a_saved_folder_reads_as_the_same_data(tmp_path: Path) -> None:
    data = logs().fill_gaps(0.03, "x").trim(stop=4).scale("x", 2.0, 1.0).rename(x="y").delay("y", 0.013)
    data = data.detrend("y").resample(50).lowpass(20).drop_outliers(9, "y").split(0.7)
    data.save(tmp_path / "saved")
    again = read_dataset(tmp_path / "saved")
    assert [r.source for r in again.records] == [f"run{k}~{use}.txt" for k in (1, 2) for use in ("fit", "test")]
    for record, same in zip(data.dataset.records, again.records, strict=True):
        assert isinstance(record.data, Record)
        assert isinstance(same.data, Record)
        assert (record.use, record.initial, record.data.names) == (same.use, same.initial, same.data.names)
        np.testing.assert_allclose(same.data.time, record.data.time, rtol=1e-12)
        np.testing.assert_allclose(same.data.values, record.data.values, rtol=1e-9, atol=1e-12)
    opened = load(tmp_path / "saved")
    assert opened.history == data.history
    assert np.isnan(opened.raw.records[1].data.values).sum() == 1


def test_steps_of_a_log_find_it_in_the_file_of_text_that_it_becomes(tmp_path: Path) -> None:
    rows = "\n".join(f"{t:.2f},{np.cos(t):.6f},{np.sin(t):.6f}" for t in TIME)
    for name in ("run1.dat", "run2.dat"):
        (tmp_path / name).write_text(f"t [s],F [N],x [m]\n{rows}\n")
    data = load(str(tmp_path / "*.dat"), inputs="F", outputs="x").split(0.5).hold_out("run2.dat", "run1~fit.dat")
    data.save(tmp_path / "saved")
    assert [r.use for r in load(tmp_path / "saved").dataset.records] == [r.use for r in data.dataset.records]
    with pytest.raises(BadInput, match="not finite"):
        data.fill_gaps(float("inf"))


def test_logs_that_differ_in_their_ending_alone_are_saved_apart(tmp_path: Path) -> None:
    """Also where the names that they would get are those of others, and by a step that names a part of one of them."""
    for k, name in enumerate(("run.dat", "run.asc", "run.txt", "dat/run.txt", "asc/run.dat", "other.dat")):
        path = tmp_path / "logs" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("\n".join(["t [s],F [N],x [m]", *(f"{t:.2f},{t * t:.6f},{k * t:.6f}" for t in TIME)]))
    raw = load(tmp_path / "logs", inputs="F", outputs="x")
    names = [record.source for record in raw.raw.records]
    assert len({*names}) == 6
    for k, data in enumerate((raw, raw.split(0.5).hold_out("run~fit.asc"))):
        again = load(data.save(tmp_path / str(k)))
        saved = dict(zip(names, (record.source for record in again.raw.records), strict=True))
        assert len({*saved.values()}) == 6
        assert (saved["run.txt"], saved["dat/run.txt"], saved["other.dat"]) == ("run.txt", "dat/run.txt", "other.txt")
        assert [*saved.values()] == [one.source for one in load(data.save(tmp_path / f"{k} again")).raw.records]
        assert [one.use for one in again.now.records] == [one.use for one in data.now.records]
        for one, same in zip(data.now.logs(), again.now.logs(), strict=True):
            np.testing.assert_allclose(log_of(again, same.source).values, log_of(data, one.source).values, rtol=1e-12)


def test_an_empty_cell_is_saved_and_read(tmp_path: Path) -> None:
    logs().detrend("x").save(tmp_path / "saved")
    again = read_dataset(tmp_path / "saved")
    assert np.flatnonzero(np.isnan(again.records[1].data["x"])).tolist() == [120]


def test_the_second_part_of_a_split_is_found_by_its_use() -> None:
    data = load({"t [s]": TIME, "F [N]": TIME**2, "x [m]": TIME}, inputs="F", outputs="x", time="t").split(0.7)
    assert data["test"].held_out
    assert log_of(data, "test").time[0] == pytest.approx(3.5)
    assert data["fit"].use == "fit"
    assert log_of(data, "fit").time.size == 350


def test_what_is_shown_is_short_and_has_a_line_a_log() -> None:
    data = logs().fill_gaps(0.03).hold_out("run2")
    lines = repr(data).splitlines()
    assert [line.split()[:4] for line in lines[-2:]] == [
        ["run1", "fit", "500", "4.99"],
        ["run2", "test", "500", "4.99"],
    ]
    empty = np.where(TIME == 1, np.nan, TIME)
    names = [f"output number {k}" for k in range(40)]
    frame = {"t [s]": TIME**1.1, "F [N]": TIME, **{f"{name} [m]": empty for name in names}}
    many = load({f"{'long' * 10}{k}": frame for k in range(60)}, inputs="F", outputs=names).flip(*names)
    assert len(repr(many)) < 2000
    assert len(many._repr_html_()) < 2000
    assert repr(many).endswith("... and 50 more")


def test_a_table_has_the_units_of_the_logs() -> None:
    pytest.importorskip("pandas")
    frame = logs().to_dataframe()
    assert list(frame.columns) == ["F [kN]", "x [mm]"]
    assert frame.loc[("run1", 0.0), "F [kN]"] == pytest.approx(1.0)
    pytest.importorskip("xarray")
    assert logs().to_xarray()["x [mm]"].sel(log="run1").size == TIME.size
