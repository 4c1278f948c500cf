"""Texts that are made to hang a reader, to fill the memory, or to command the terminal that shows a message."""

import os
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from fmu_build.errors import BuildError
from fmu_build.text.libraries import read_text as read_modelica
from fmu_build.text.tokens import TextError
from pysim.io import read_text, read_toml
from pysim.types import BadInput

posix = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such files")


@posix
@pytest.mark.parametrize("read", [lambda path: read_text(path, "a log"), read_modelica])
def test_a_pipe_and_a_device_are_refused_and_not_waited_for(read: Callable[[Path], str], tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe.csv")
    for path in (tmp_path / "pipe.csv", Path("/dev/zero")):
        with pytest.raises(
            (BadInput, TextError), match="a pipe or a device, which may never end; write it into a file"
        ):
            read(path)


def test_a_line_without_end_is_refused(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text("time,u\n" + "1," * 600_000)
    with pytest.raises(BadInput, match=r"a\.csv, line 2 is longer than a million characters; break it into rows"):
        read_text(tmp_path / "a.csv", "a log")


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("x = " + "[" * 100_000 + "]" * 100_000, "its brackets stand too deep"),
        ("x" + ".x" * 100_000 + " = 1", "a name has more than a hundred points"),
        ("[x" + " . 'x'" * 200 + "]", "a name has more than a hundred points"),
    ],
)
def test_what_is_nested_without_end_is_one_sentence(text: str, fault: str, tmp_path: Path) -> None:
    (tmp_path / "a.toml").write_text(text)
    with pytest.raises(BadInput, match=f"{fault}.*; correct the TOML"):
        read_toml(tmp_path / "a.toml", "a plan")


@pytest.mark.parametrize("error", [BadInput, BuildError, TextError])
def test_a_message_commands_no_terminal_and_breaks_no_line(error: type[Exception]) -> None:
    shown = str(error("a\x1b[2J b\x1c c\u2028d \u202ee \udcff: 5 µm, 2°"))
    assert shown == r"a\x1b[2J b\x1c c\u2028d \u202ee \udcff: 5 µm, 2°"
    assert len(shown.splitlines()) == 1
