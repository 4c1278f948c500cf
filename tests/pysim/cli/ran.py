"""Commands run in this process: what they leave, and how they refuse."""

import json
import shlex
from collections.abc import Sequence
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import dataclass
from io import StringIO
from pathlib import Path
from typing import Any

import pytest

from pysim.cli import main
from pysim.cli.command import Given
from pysim.cli.main import argument_parser, registry


@dataclass(frozen=True)
class Ran:
    """A command that has ended: exit code, what it printed, its JSON answer and the folder of its report."""

    words: tuple[str, ...]
    code: int
    out: str
    err: str
    answer: dict[str, Any]
    output: Path


def ran(words: Sequence[str], folder: Path) -> Ran:
    """Run a command with its answer in a folder."""
    numbers, output = folder / "answer.json", folder / "out"
    with redirect_stdout(StringIO()) as out, redirect_stderr(StringIO()) as err:
        code = main([*words, "--json", str(numbers), "--output", str(output)])
    return Ran(tuple(words), code, out.getvalue(), err.getvalue(), json.loads(numbers.read_text()), output)


def undraw(patch: pytest.MonkeyPatch) -> None:
    """Draw no picture: it costs a second, and pictures are held to their numbers in tests/pysim/present."""
    from importlib import import_module

    patch.setattr(import_module("pysim.present.render"), "render", lambda figure, form: b"drawn")


def refused(words: Sequence[str], capsys: pytest.CaptureFixture[str], *named: str) -> None:
    """The command is not run, and its last line on standard error names the argument and the cure.

    Raises:
        AssertionError: another exit code, or a word that is missing.
    """
    capsys.readouterr()
    assert main(list(words)) == 2, shlex.join(words)
    said = capsys.readouterr().err
    assert "Traceback" not in said
    line = said.splitlines()[-1]
    missing = [word for word in named if word not in line]
    assert not missing, f"{shlex.join(words)}: {line!r} does not say {missing}"


def parsed(words: Sequence[str]) -> Given:
    """What a command is given; it is not run."""
    return Given(registry()[words[0]], argument_parser(words[0]).parse_args(list(words)), (words[0],))
