"""Find the command, run it, and turn what went wrong into one line and an exit code."""

from __future__ import annotations

import argparse
import contextlib
import os
import pkgutil
import sys
import traceback
from collections.abc import Sequence
from functools import cache
from importlib import import_module
from typing import NoReturn

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
    words = list(sys.argv[1:] if argv is None else argv)
    try:
        parser = argument_parser(words[0] if words else "")
        args = parser.parse_args(words)
    except SystemExit as end:  # argparse has said what is wrong, or shown the help
        return int(end.code or 0)
    except KeyboardInterrupt as stop:  # some options load libraries to say what they take
        return _stopped(stop)
    return _guarded(args)


def print_everything() -> None:
    """Let standard output replace what its encoding has no letters for: a pipe on Windows knows Latin letters only."""
    if sys.stdout is None:  # closed; nothing else may be opened in its place, as all that is printed would go there
        sys.stdout = os.fdopen(os.open(os.devnull, os.O_RDONLY), "w", closefd=False)
    for stream in (sys.stdout, sys.stderr):
        reconfigure = getattr(stream, "reconfigure", None)  # whatever stands in for it may have none
        if reconfigure is not None and stream.errors == "strict":
            reconfigure(errors="replace")


class Parser(argparse.ArgumentParser):
    """One that names what is near where a word is not known."""

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
        code = registry()[args.command].execute(args)
        sys.stdout.flush()  # here, where a reader that went away can still be dealt with
        return code
    except BrokenPipeError:  # `pysim ... | head` has seen enough
        _silence()
        return WRONG_USE
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


def _silence() -> None:
    """Send what is still to be printed nowhere, or Python would complain when it ends."""
    with contextlib.suppress(OSError, ValueError):  # a standard output that has no file behind it
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


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
