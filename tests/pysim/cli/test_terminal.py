"""Streams that can less than a terminal of today."""

import io
import sys
from pathlib import Path

import pytest

from pysim.cli import main
from pysim.cli.main import print_everything


def test_letters_that_an_encoding_lacks_are_replaced(monkeypatch: pytest.MonkeyPatch) -> None:
    raw = io.BytesIO()
    monkeypatch.setattr(sys, "stdout", io.TextIOWrapper(raw, encoding="cp1252"))
    print_everything()
    print("Öl ± 5, Σ Ωmega")
    sys.stdout.flush()
    assert raw.getvalue().decode("cp1252").rstrip() == "Öl ± 5, ? ?mega"


def test_a_command_prints_names_that_the_stream_cannot_hold(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "a.txt").write_text("".join(f"{k / 10} {k % 7} {k % 5}\n" for k in range(50)), encoding="utf-8")
    (tmp_path / "dataset.toml").write_text(
        '[dataset]\nname = "πρέσα"\n[signals.u]\nrole = "input"\nunit = "%"\n[signals.y]\nrole = "output"\nunit = "%"\n'
        '[[records]]\nfile = "a.txt"\ncolumns = ["time", "u", "y"]\nkind = "other"\n',
        encoding="utf-8",
    )
    raw = io.BytesIO()
    monkeypatch.setattr(sys, "stdout", io.TextIOWrapper(raw, encoding="cp1252"))
    assert main(["data", "check", str(tmp_path)]) == 0
    sys.stdout.flush()
    assert raw.getvalue().decode("cp1252").splitlines()[0] == "?????"
