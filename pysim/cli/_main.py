"""Find the command, run it, and turn what went wrong into one line and an exit code."""

from __future__ import annotations

import argparse
import contextlib
import os
import sys
import traceback
from collections.abc import Sequence

from pysim.cli import (
    add,
    app,
    bench,
    blackbox,
    check_fmu,
    chirp,
    compare,
    cosim,
    data,
    demo,
    diagnose,
    fit,
    frf,
    friction,
    locate,
    model,
    multisine,
    rig,
    signal,
    simulate,
    tune,
    validate,
)
from pysim.cli._terminal import print_everything

DONE, NO, WRONG_USE, OUR_BUG = 0, 1, 2, 3
_COMMANDS = {
    "add": add,
    "app": app,
    "bench": bench,
    "blackbox": blackbox,
    "check-fmu": check_fmu,
    "chirp": chirp,
    "compare": compare,
    "cosim": cosim,
    "data": data,
    "demo": demo,
    "diagnose": diagnose,
    "fit": fit,
    "frf": frf,
    "friction": friction,
    "locate": locate,
    "model": model,
    "multisine": multisine,
    "rig": rig,
    "signal": signal,
    "simulate": simulate,
    "tune": tune,
    "validate": validate,
}


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command.

    Args:
        argv: the words behind `pysim`; those of this process by default.
    Returns:
        0 done, 1 the answer is no, 2 wrong use, 3 our bug.
    """
    print_everything()
    words = list(sys.argv[1:] if argv is None else argv)
    try:
        args = argument_parser(words[0] if words else "").parse_args(words, argparse.Namespace(words=words))
    except SystemExit as end:  # argparse has said what is wrong, or shown the help
        return int(end.code or 0)
    return _guarded(args)


def argument_parser(command: str = "") -> argparse.ArgumentParser:
    """Every command with its options.

    Args:
        command: whose options alone are needed, which takes a twentieth of the time.
    """
    parser = argparse.ArgumentParser(prog="pysim", description="Simulate FMUs and compare them with a test bench.")
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    for name, module in _COMMANDS.items():
        help_text = (module.__doc__ or "").strip().splitlines()[0]
        parser_of = commands.add_parser(name, help=help_text, description=help_text)
        if command == name or command not in _COMMANDS:
            module.add_arguments(parser_of)
    return parser


def _guarded(args: argparse.Namespace) -> int:
    try:
        code = int(_COMMANDS[args.command].run(args))
        sys.stdout.flush()  # here, where a reader that went away can still be dealt with
        return code
    except BrokenPipeError:  # `pysim ... | head` has seen enough
        _silence()
        return WRONG_USE
    except KeyboardInterrupt as stop:  # a command that can be gone on with says how
        print(f"pysim: stopped{f'; {stop}' if str(stop) else ''}", file=sys.stderr)
        return WRONG_USE
    except Exception as error:
        code = _answer(error)
        if code != OUR_BUG:
            print(f"pysim {args.command}: {error}", file=sys.stderr)
            return code
        traceback.print_exc()
        print(f"pysim {args.command}: this is our mistake, please report the lines above", file=sys.stderr)
        return OUR_BUG


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
