"""What headings say, and the column that a name means."""

from __future__ import annotations

import numpy as np
import pytest

from pysim.io.load.foreign_units import scale_of
from pysim.io.load.headings import heading_of, name_and_unit
from pysim.io.load.table import RawTable
from pysim.nouns.data import load
from pysim.types import BadInput, Record


@pytest.mark.parametrize(
    ("heading", "name", "unit"),
    [
        ("x [mm]", "x", "mm"),
        ("x (mm)", "x", "mm"),
        ("x / mm", "x", "mm"),
        ("x/mm", "x", "mm"),
        ("x in mm", "x", "mm"),
        ("v [mm/s]", "v", "mm/s"),
        ("v / mm/s", "v", "mm/s"),
        ("Q_A/l/min", "Q_A", "l/min"),
        ("p A [bar]", "p A", "bar"),
        ("ratio / furlong", "ratio / furlong", ""),  # no unit behind a stroke
        ("A/B", "A/B", ""),
        ("x [furlong]", "x", "furlong"),  # in brackets stands a unit, known or not
        ("plain", "plain", ""),
    ],
)
def test_a_heading_is_a_name_and_a_unit(heading: str, name: str, unit: str) -> None:
    assert name_and_unit(heading) == (name, unit)


def test_letters_count() -> None:
    table = RawTable("log.csv", "log.csv", ("p [bar]", "P [W]", "x [mm]", "x [V]"), (np.zeros(2),) * 4)
    assert (heading_of(table, "p"), heading_of(table, "P"), heading_of(table, "x [V]")) == ("p [bar]", "P [W]", "x [V]")
    with pytest.raises(BadInput, match=r"which column is 'x', 'x \[mm\]' or 'x \[V\]'\? Write it as it stands there"):
        heading_of(table, "x")
    with pytest.raises(BadInput, match=r"no column 'X'; did you mean"):
        heading_of(table, "X")


@pytest.mark.parametrize(
    ("unit", "si", "gain", "zero"),
    [
        ("inHg", "Pa", 3386.389, 0.0),
        ("kgf", "N", 9.80665, 0.0),
        ("lbf*ft", "N.m", 1.3558179483, 0.0),
        ("kWh", "J", 3.6e6, 0.0),
        ("gallon/minute", "m3/s", 6.30901964e-5, 0.0),
        ("day", "s", 86400.0, 0.0),
        ("degreeR", "K", 5 / 9, 0.0),
        ("psig", None, 0.0, 0.0),
    ],
)
def test_units_that_are_not_in_our_table_are_asked_of_pint(unit: str, si: str | None, gain: float, zero: float) -> None:
    pytest.importorskip("pint")
    if si is None:
        with pytest.raises(BadInput, match=f"x: '{unit}' is no unit; did you mean psi"):
            scale_of(unit, "x")
        return
    found = scale_of(unit, "x")
    assert found.unit == si
    assert (found.gain, found.zero) == (pytest.approx(gain, rel=1e-6), pytest.approx(zero, abs=1e-9))


def test_without_pint_the_message_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    def absent(name: str) -> None:
        raise ImportError(name)

    monkeypatch.setattr("pysim.io.named_columns.import_module", absent)
    with pytest.raises(BadInput, match=r'log.csv, x: the unit \'inHg\' .* pip install "hydraulic-test-bench\[data\]"'):
        scale_of("inHg", "log.csv, x")


@pytest.mark.parametrize("key", ["place", "x", "x [mm]"])
def test_a_unit_that_the_heading_contradicts_is_taken_and_said(key: str) -> None:
    log = {"t [s]": np.arange(5.0), "F [N]": np.ones(5), "x [mm]": np.full(5, 2.0)}
    data = load(log, inputs="F", outputs={"place": "x"}, units={key: "cm"})
    record = data.now.records[0]
    assert isinstance(record.data, Record)
    assert record.data["place"].tolist() == [0.02] * 5
    assert {"cm", "mm"} <= set(str(data.table["warnings"][0]).replace(",", "").split())


@pytest.mark.parametrize("name", ["log.xlsx", "log.parquet", "log.tdms", "log.mat"])
def test_a_missing_package_is_named(name: str, monkeypatch: pytest.MonkeyPatch, tmp_path: object) -> None:
    from pathlib import Path

    from pysim.io.load import READERS

    def absent(module: str) -> None:
        raise ImportError(module)

    monkeypatch.setattr("pysim.io.named_columns.import_module", absent)
    path = Path(str(tmp_path)) / name
    path.write_bytes(b"MATLAB 7.3".ljust(512) + b"\x89HDF\r\n\x1a\n")
    with pytest.raises(BadInput, match=r'the package for it is missing; run: pip install "?hydraulic-test-bench'):
        READERS[path.suffix](path)
