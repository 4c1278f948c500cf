"""Find the command, run it, and turn what went wrong into one line and an exit code."""

from __future__ import annotations

import argparse
import contextlib
import os
import pkgutil
import re
import sys
import traceback
from collections.abc import Callable, Sequence
from functools import cache
from importlib import import_module
from typing import Any, NoReturn

from pysim.cli.command import NO, OUR_BUG, WRONG_USE, Command
from pysim.cli.option import did_you_mean


@cache
def registry() -> dict[str, Command]:
    """Every command by its name: a file in `pysim/cli/commands` each."""
    from pysim.cli import commands

    files = pkgutil.iter_modules(commands.__path__)
    found: list[Command] = [import_module(f"{commands.__name__}.{one.name}").COMMAND for one in files]
    return {command.name: command for command in sorted(found, key=lambda command: command.name)}


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command.

    Args:
        argv: the words behind `pysim`; those of this process by default.
    Returns:
        0 done, 1 the answer is no, 2 wrong use, 3 our bug.
    """
    print_everything()
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # NumPy comes later; its threads spin where runs are simulated
    with contextlib.redirect_stdout(Outlet(sys.stdout)) as outlet:
        code = _run(list(sys.argv[1:] if argv is None else argv))
        outlet.flush()
    return code if outlet.error is None else outlet.ended(code)


def _run(words: list[str]) -> int:
    try:
        parser = argument_parser(words[0] if words else "")
        return _guarded(parser.parse_args(words))
    except SystemExit as end:  # argparse has said what is wrong, or shown the help
        return int(end.code or 0)
    except KeyboardInterrupt as stop:  # some options load libraries to say what they take
        return _stopped(stop)


def print_everything() -> None:
    """Let standard output replace what its encoding has no letters for: a pipe on Windows knows Latin letters only."""
    if sys.stdout is None:  # closed; nothing else may be opened in its place, as all that is printed would go there
        sys.stdout = os.fdopen(os.open(os.devnull, os.O_RDONLY), "w", closefd=False)
    for stream in (sys.stdout, sys.stderr):
        reconfigure = getattr(stream, "reconfigure", None)  # whatever stands in for it may have none
        if reconfigure is not None and stream.errors == "strict":
            reconfigure(errors="replace")


class Outlet:
    """Standard output. Where it is closed or full, or nobody reads it any more, the command still writes its files."""

    error: OSError | None = None

    def __init__(self, stream: Any) -> None:
        self._stream = stream

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)

    def write(self, text: str) -> int:
        """Print, or keep the error."""
        self._tried(self._stream.write, text)
        return len(text)

    def flush(self) -> None:
        """Print what waits, or keep the error."""
        self._tried(self._stream.flush)

    def _tried(self, do: Callable[..., object], *args: str) -> None:
        try:
            do(*args)
        except OSError as error:
            self.error = error

    def ended(self, code: int) -> int:
        """The exit code of a command whose output was lost; `pysim ... | head` has seen enough."""
        with contextlib.suppress(OSError, ValueError):  # what waits goes nowhere, or Python would complain at its end
            os.dup2(os.open(os.devnull, os.O_WRONLY), self.fileno())
        if isinstance(self.error, BrokenPipeError):
            return code
        print(f"pysim: standard output: {self.error}; send it to another place", file=sys.stderr)
        return max(code, WRONG_USE)


class Parser(argparse.ArgumentParser):
    """One that names what is near where a word is not known, and takes `-1e-9,2` for a value."""

    def __init__(self, *args: Any, **more: Any) -> None:
        super().__init__(*args, **more)
        self._negative_number_matcher = re.compile(r"-\.?\d")  # that of argparse knows -1 and -.5 only

    def parse_known_args(self, args=None, namespace=None):  # type: ignore[no-untyped-def] # as argparse has it
        known = [flag for action in self._actions for flag in action.option_strings if flag.startswith("--")]
        leaf = not any(isinstance(action, argparse._SubParsersAction) for action in self._actions)
        for word in args or ():
            flag = word.partition("=")[0]
            if word == "--" or not (leaf or word.startswith("-")):  # what is behind a command's name is its own
                break
            if flag.startswith("--") and not any(one.startswith(flag) for one in known):
                self.error(f"there is no option {flag}{did_you_mean(flag, known)}")
        return super().parse_known_args(args, namespace)

    def error(self, message: str) -> NoReturn:
        bad, found, choices = message.partition("invalid choice: ")
        if found:
            word = choices.split("'")[1] if "'" in choices else ""
            names = [name for action in self._actions for name in action.choices or ()]
            message = f"{bad}there is no {word}{did_you_mean(word, names)}; choose of {', '.join(names)}"
        extra = message.removeprefix("unrecognized arguments: ")
        if extra != message:
            message = f"{extra} is one word too many; leave it out, or put a text with spaces between quotation marks"
        super().error(message.replace("expected one argument", "its value is missing; write it behind"))


class _Version(argparse.Action):
    """Print the version, of the clone or of the installed package."""

    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> None:
        from fmu_build.version import version

        print(f"pysim {version()}")
        parser.exit()


def argument_parser(command: str = "") -> argparse.ArgumentParser:
    """Every command with its options.

    Args:
        command: whose options alone are needed, which takes a twentieth of the time.
    """
    parser = Parser(prog="pysim", description="Simulate FMUs and compare them with a test bench.")
    parser.add_argument("--version", action=_Version, nargs=0, help="print the version")
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    for name, one in registry().items():
        parser_of = commands.add_parser(name, help=one.about, description=one.about)
        if command == name or command not in registry():
            one.add_arguments(parser_of)
    return parser


def _guarded(args: argparse.Namespace) -> int:
    try:
        return registry()[args.command].execute(args)
    except KeyboardInterrupt as stop:
        return _stopped(stop)
    except Exception as error:
        code = _answer(error)
        if code != OUR_BUG:
            print(f"pysim {args.command}: {error}", file=sys.stderr)
            return code
        traceback.print_exc()
        said = "this is our mistake, please report the lines above, with those of `pysim report-bug`"
        print(f"pysim {args.command}: {said}", file=sys.stderr)
        return OUR_BUG


def _stopped(stop: KeyboardInterrupt) -> int:
    """A command that can be gone on with says how."""
    print(f"pysim: stopped{f'; {stop}' if str(stop) else ''}", file=sys.stderr)
    return WRONG_USE


def _answer(error: Exception) -> int:
    """NO for a run that stopped early; WRONG_USE for bad input, a model that does not compile, a place we cannot write;
    OUR_BUG for all whose message is not meant for the user."""
    from pysim.types import BadInput, SimulationError

    if isinstance(error, SimulationError):
        return NO
    if isinstance(error, BadInput | OSError):
        return WRONG_USE
    builder = sys.modules.get("fmu_build.errors")
    return WRONG_USE if builder is not None and isinstance(error, builder.BuildError) else OUR_BUG
