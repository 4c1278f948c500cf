"""Modelica text from files."""

from pathlib import Path

import pytest

from fmu_build.text import Libraries, TextError
from fmu_build.text.libraries import read_text

TEXT = 'model M\r\n  Real x "Größe";\r\nend M;\n'


def test_a_byte_order_mark_and_the_ends_of_lines_mean_nothing(tmp_path: Path) -> None:
    (tmp_path / "M.mo").write_bytes(TEXT.encode("utf-8-sig"))
    assert read_text(tmp_path / "M.mo") == TEXT.replace("\r\n", "\n")


def test_another_encoding_is_refused_with_its_line_and_the_cure(tmp_path: Path) -> None:
    file = tmp_path / "M.mo"
    file.write_bytes(TEXT.encode("latin-1"))
    with pytest.raises(TextError, match=r"M\.mo:2: 'ö' is in another encoding than UTF-8, .*; save the file as UTF-8$"):
        Libraries([file]).find("M")


def test_a_file_that_is_not_there_is_named(tmp_path: Path) -> None:
    with pytest.raises(TextError, match=r"x\.mo: cannot be read: "):
        read_text(tmp_path / "x.mo")
