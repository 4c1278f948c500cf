"""What a command is: data and one public function.

A command stands in `pysim/cli/commands/<name>.py`, which is all it takes to be found:

    def run(given: Given) -> Responses:
        from pysim.identify import measured_responses           # heavy imports stay inside
        return Responses(given.dataset.name, measured_responses(given.dataset, output=given.signal))

    COMMAND = Command(
        "frf", "Frequency responses from the stepped-sine logs of a data set", run,
        options=(DATASET, SIGNAL, number("--settle", "SECONDS", 0.5, "left out after the sine starts"), JSON, OUTPUT),
    )

`given.NAME` is the value of an option. Where the option says how to read it, as DATASET and MODEL do, it is what was
read; `given.typed["dataset"]` stays the path. All that writes is looked at before `run` starts. What `run` returns is
printed, written to `--json`, and as pictures and a page to `--output`, by what `pysim.present` has for its type.
`run` raises BadInput for what the user can mend.

- `passes` says of a result whether the answer is yes (exit code 0) or no (1).
- `files(given, result, folder)` writes what lies in the folder of `--output` beside the page and needs more than the
  result to be made; it returns the result with the names of these files.
- `done(given, result)` is called once all is written: for further files, and to take away what an interrupted run would
  have gone on from.
- `goes_on` are the names in the folder of `--output` from which a stopped run goes on.
- A command without a result, such as `app`, prints and writes by itself, and returns the exit code. So may a run that
  has none, such as `cosim --export-ssp`.
- `parts` are commands of their own behind this one's name, as in `pysim data check`.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pysim.cli.option import Option, Role
from pysim.cli.outputs import LOG, answer_folder, prepare_answer, prepare_file, refuse_same, refuse_twice
from pysim.present.report import no_empty_folders
from pysim.workflow import command_line

if TYPE_CHECKING:
    from pysim.present.progress import ProgressBar

DONE, NO, WRONG_USE, OUR_BUG = 0, 1, 2, 3  # exit codes


@dataclass(frozen=True)
class Command:
    """See the head of this file."""

    name: str
    about: str
    run: Callable[[Given], Any] | None = None
    options: tuple[Option, ...] = ()
    passes: Callable[[Any], bool] | None = None
    files: Callable[[Given, Any, Path], Any] | None = None
    done: Callable[[Given, Any], None] | None = None
    goes_on: tuple[str, ...] = ()
    parts: tuple[Command, ...] = ()

    def add_arguments(self, parser: argparse.ArgumentParser) -> None:
        """Let a parser take its options, or its parts with theirs."""
        for option in self.options:
            option.add_to(parser)
        if self.parts:
            parts = parser.add_subparsers(dest="part", required=True, metavar="ACTION")
            for part in self.parts:
                part.add_arguments(parts.add_parser(part.name, help=part.about, description=part.about))

    def execute(self, parsed: argparse.Namespace, ahead: tuple[str, ...] = ()) -> int:
        """Run it, show what it found, and write that where it was asked for.

        Args:
            ahead: names of the commands that this one is a part of.
        Returns:
            the exit code.
        """
        for part in self.parts:
            if part.name == parsed.part:
                return part.execute(parsed, (*ahead, self.name))
        assert self.run is not None
        given = Given(self, parsed, (*ahead, self.name))
        with no_empty_folders(_flat(given.paths(Role.FOLDER, Role.FILE, Role.PLACE))):
            _prepare(given)
            result = self.run(given)
            return result if isinstance(result, int) else _shown(given, result)


class Given:
    """What the command line gives a command: the value of each option, by its name."""

    def __init__(self, command: Command, parsed: argparse.Namespace, words: tuple[str, ...]) -> None:
        self._options = {option.key: option for option in command.options}
        self._parsed = parsed
        self._read: dict[str, Any] = {}
        self._words = words
        self.command = command
        self.opened: Any = None  # what `run` hands on to `files` and `done` beside its result
        self.typed = {key: option.value(getattr(parsed, key)) for key, option in self._options.items()}

    def __getattr__(self, key: str) -> Any:
        option = self.__dict__.get("_options", {}).get(key)
        if option is None:
            raise AttributeError(f"the command has no option {key}")
        if option.read is None:
            return self.typed[key]
        if key not in self._read:
            self._read[key] = option.read(self)
        return self._read[key]

    def __contains__(self, key: str) -> bool:
        return key in self._options

    @property
    def repeated(self) -> str:
        """The line that runs the command again: what differs from the defaults."""
        ordered = sorted(self._options.values(), key=lambda option: not option.positional)
        words = [word for option in ordered for word in option.words(getattr(self._parsed, option.key))]
        return command_line([*self._words, *words])

    def paths(self, *roles: Role) -> dict[str, list[Path]]:
        """Option as typed -> paths, of the options with these roles."""
        found: dict[str, list[Path]] = {}
        for key, option in self._options.items():
            value = self.typed[key]
            if option.role in roles and value:
                found[option.flags[-1]] = [Path(one) for one in (value if isinstance(value, list) else [value])]
        return found

    def keep(self, result: Any) -> None:
        """Write the JSON of a result that is not complete yet, for the case that the rest is stopped."""
        _write_numbers(self, result)

    @contextmanager
    def going_on(self, what: str) -> Iterator[None]:
        """Where the user stops what is done within, the message says how to go on.

        Args:
            what: is stopped, in a word.
        """
        try:
            yield
        except KeyboardInterrupt:
            cure = f"with --output DIR a {what} can be gone on with"
            raise KeyboardInterrupt("the same command goes on where it was" if self.output else cure) from None

    @contextmanager
    def progress(self, title: str) -> Iterator[ProgressBar]:
        """A bar on standard error that takes (done, total)."""
        from pysim.present.progress import ProgressBar

        with ProgressBar(title) as bar:
            yield bar


def _prepare(given: Given) -> None:
    """See that all results can be written, before the work starts.

    Raises:
        BadInput: one cannot; names the option.
    """
    data, read = (_flat(given.paths(role)) for role in (Role.DATA, Role.READ))
    written = given.paths(Role.FILE)
    for folder in _flat(given.paths(Role.FOLDER)):
        prepare_answer(folder, data=data, read=read, beside=_flat(written), goes_on=given.command.goes_on)
    taken: dict[Path, str] = {}
    for flag, paths in written.items():
        refuse_twice(paths[0], flag, taken)
        option = next(one for one in given.command.options if one.flags[-1] == flag)
        refuse_same(paths[0], flag, read)
        prepare_file(paths[0], flag, option.suffixes, read=data)


def _flat(paths: dict[str, list[Path]]) -> list[Path]:
    return [path for several in paths.values() for path in several]


def _write_numbers(given: Given, result: Any) -> None:
    """To `--json`, where that was asked for."""
    from pysim.io import write_file
    from pysim.present import data

    if "json" in given and given.json:
        write_file(given.json, json.dumps(data(result), indent=1, allow_nan=False))


def _shown(given: Given, result: Any) -> int:
    """Print a result, and write it where that was asked for."""
    from pysim.present import text
    from pysim.types import printable

    command = given.command
    print(printable(text(result)))
    if "output" in given and given.output:
        result = _reported(given, result)
    _write_numbers(given, result)
    if command.done is not None:
        command.done(given, result)
    return DONE if command.passes is None or command.passes(result) else NO


def _reported(given: Given, result: Any) -> Any:
    """Write the folder of a result; the result, with the places of its files where its JSON tells them."""
    from pysim.present.progress import Working
    from pysim.present.report import with_places, write_report

    folder = given.output
    beside = [*_flat(given.paths(Role.FILE)), *(folder / name for name in given.command.goes_on if name == LOG)]
    with answer_folder(folder, beside=beside) as new:
        if given.command.files is not None:
            result = given.command.files(given, result, new)
        with Working("Drawing the report"):
            written = write_report(new, result, redo=given.repeated)
    written = {name: folder / path.name for name, path in written.items()}
    more = ", ".join(path.name for path in written.values() if path.suffix not in (".html", ".png"))
    print(f"Report: {written['report']}{f'; beside it: {more}' if more else ''}")
    return with_places(result, written, given.json.parent if "json" in given and given.json else folder)
