"""One log, in every form that it may come in: always the same data."""

from collections.abc import Callable
from pathlib import Path, PureWindowsPath
from typing import Any

import numpy as np
import pytest

from pysim.io.load.sources import seen_from_shared
from pysim.nouns.data import load
from pysim.types import Record
from tests.pysim.io.load.files import write_mat73, write_ods, write_xlsx

TIME = np.round(np.arange(300) / 250, 6)
FORCE, PLACE = np.round(np.sin(7 * TIME), 9), np.round(3 * np.cos(5 * TIME), 9)
HEADS = ("t [s]", "F [kN]", "x [mm]")
ROWS = np.column_stack([TIME, FORCE, PLACE]).tolist()
COLUMNS = dict(zip(HEADS, (TIME, FORCE, PLACE), strict=True))


def csv(path: Path) -> Path:
    path = path / "log.csv"
    path.write_text("\n".join([",".join(HEADS), *(",".join(map(repr, row)) for row in ROWS)]))
    return path


def german_csv(path: Path) -> Path:
    path = path / "log.csv"
    lines = [";".join(HEADS), *(";".join(map(repr, row)).replace(".", ",") for row in ROWS)]
    path.write_text("\r\n".join(lines) + "\r\n", encoding="utf-8-sig")
    return path


def text(path: Path) -> Path:
    path = path / "log.txt"
    path.write_text("\n".join(["t/s F/kN x/mm", *(" ".join(map(repr, row)) for row in ROWS)]))
    return path


def lvm(path: Path) -> Path:
    path = path / "log.lvm"
    head = ["LabVIEW Measurement\t", "Writer_Version\t2", "Separator\tTab", "***End_of_Header***\t", "Channels\t2"]
    head += ["Samples\t300\t300", "Y_Unit_Label\tkN\tmm", "X0\t0.0\t0.0", "***End_of_Header***\t\t"]
    path.write_text("\n".join([*head, "X_Value\tF\tx\tComment", *("\t".join(map(repr, row)) + "\t" for row in ROWS)]))
    return path


def xlsx(path: Path) -> Path:
    pytest.importorskip("python_calamine")
    return write_xlsx(path / "log.xlsx", {"Sheet1": [HEADS, *ROWS]})


def ods(path: Path) -> Path:
    pytest.importorskip("python_calamine")
    return write_ods(path / "log.ods", [HEADS, *ROWS])


def mat(path: Path) -> Path:
    scipy = pytest.importorskip("scipy.io")
    scipy.savemat(path / "log.mat", {"t": TIME, "F": FORCE, "x": PLACE})
    return path / "log.mat"


def mat_struct(path: Path) -> Path:
    scipy = pytest.importorskip("scipy.io")
    scipy.savemat(path / "log.mat", {"rig": {"t": TIME, "F": FORCE[:, None], "x": PLACE, "operator": "Eva"}})
    return path / "log.mat"


def mat73(path: Path) -> Path:
    pytest.importorskip("h5py")
    return write_mat73(path / "log.mat", {"rig": {"t": TIME, "F": FORCE, "x": PLACE}, "k": 3.0})


def parquet(path: Path) -> Path:
    pyarrow, parquet = pytest.importorskip("pyarrow"), pytest.importorskip("pyarrow.parquet")
    parquet.write_table(pyarrow.table(COLUMNS), path / "log.parquet")
    return path / "log.parquet"


def tdms(path: Path) -> Path:
    nptdms = pytest.importorskip("nptdms")
    step = {"wf_increment": 0.004, "wf_start_offset": 0.0}
    channels = [
        nptdms.ChannelObject("rig", "F", FORCE, {**step, "unit_string": "kN"}),
        nptdms.ChannelObject("rig", "x", PLACE, {**step, "unit_string": "mm"}),
    ]
    with nptdms.TdmsWriter(path / "log.tdms") as file:
        file.write_segment(channels)
    return path / "log.tdms"


def arrays(path: Path) -> dict[str, Any]:
    return dict(COLUMNS)


def arrow(path: Path) -> Any:
    return pytest.importorskip("pyarrow").table(COLUMNS)


def pandas(path: Path) -> Any:
    return pytest.importorskip("pandas").DataFrame(COLUMNS)


def pandas_index(path: Path) -> Any:
    module = pytest.importorskip("pandas")
    return module.DataFrame({h: COLUMNS[h] for h in HEADS[1:]}, index=module.Index(TIME, name="t [s]"))


def pandas_columns(path: Path) -> Any:
    """A dict whose columns are pandas' own, the first an index."""
    frame = pandas_index(path)
    return {HEADS[0]: frame.index, **{heading: frame[heading] for heading in HEADS[1:]}}


def polars(path: Path) -> Any:
    return pytest.importorskip("polars").DataFrame(COLUMNS)


def xarray(path: Path) -> Any:
    variables = {"F": ("t", FORCE, {"units": "kN"}), "x": ("t", PLACE, {"units": "mm"})}
    return pytest.importorskip("xarray").Dataset(variables, coords={"t": ("t", TIME, {"units": "s"})})


FORMS = (
    *(csv, german_csv, text, lvm, xlsx, ods, mat, mat_struct, mat73, parquet, tdms),
    *(arrays, arrow, pandas, pandas_index, pandas_columns, polars, xarray),
)
NAMED = (mat, mat_struct, mat73)  # whose names hold no unit


@pytest.mark.parametrize(
    "form",
    FORMS,
)
def test_the_same_log_in_any_form_is_the_same_data(form: Callable[[Path], Any], tmp_path: Path) -> None:
    units = {"F": "kN", "x": "mm"} if form in NAMED else None
    data = load(form(tmp_path), inputs="F", outputs="x", units=units, noise={"x": 0.01})
    (record,) = data.dataset.records
    assert isinstance(record.data, Record)
    np.testing.assert_allclose(record.data.time, TIME, rtol=1e-12, atol=1e-15)
    np.testing.assert_allclose(record.data.values, np.column_stack([1e3 * FORCE, 1e-3 * PLACE]), rtol=1e-14)
    assert (record.data.names, record.data.units) == (("F", "x"), ("N", "m"))
    assert [(s.role, s.unit, s.noise) for s in data.dataset.signals] == [("input", "N", None), ("output", "m", 1e-5)]


@pytest.mark.parametrize("source", ["glob", "list", "folder", "dict"])
def test_several_files_are_several_logs(source: str, tmp_path: Path) -> None:
    for name in ("run1", "run2"):
        (tmp_path / f"{name}.csv").write_text(csv(tmp_path).read_text())
    (tmp_path / "log.csv").unlink()
    paths = [tmp_path / "run1.csv", tmp_path / "run2.csv"]
    given = {"glob": str(tmp_path / "*.csv"), "list": paths, "folder": tmp_path, "dict": {p.stem: p for p in paths}}
    data = load(given[source], inputs="F", outputs="x")
    assert data.names == ("run1", "run2")
    assert data.hold_out("run2")["run2"].held_out


@pytest.mark.parametrize(
    ("folders", "seen"),
    [
        (["C:/rig/a/cold", "C:/rig/a", "c:/Rig/b"], ["a/cold", "a", "b"]),
        (["C:/rig/a", "C:/rig/a"], [".", "."]),
        (["C:/rig/a", "D:/rig/b"], [".", "."]),
        ([], []),
    ],
)
def test_logs_are_called_as_seen_from_the_folder_that_they_share(folders: list[str], seen: list[str]) -> None:
    assert seen_from_shared([PureWindowsPath(folder) for folder in folders]) == seen
