"""Open the workbench in the browser: compare, locate, add an effect, and watch the error fall."""

from __future__ import annotations

import argparse
from pathlib import Path

_HIGHEST_PORT = 65535


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The words behind `pysim app`."""
    parser.add_argument(
        "project", metavar="PROJECT", type=Path, nargs="?", default=Path("workbench"), help="its folder (workbench)"
    )
    parser.add_argument("--port", metavar="N", type=int, default=0, help="to listen at; a free one by default")
    parser.add_argument(
        "--host", metavar="NAME", default="127.0.0.1", help="to listen at (127.0.0.1: this machine alone)"
    )
    parser.add_argument("--no-browser", action="store_true", help="print the address and open nothing")


def run(args: argparse.Namespace) -> int:
    """Serve until Ctrl-C; 0."""
    from pysim.cli.outputs import command_line
    from pysim.types import BadInput

    try:
        from pysim.app import Limits, serve
    except ModuleNotFoundError as error:
        cure = 'pip install ".[app]" in the checkout, or start it with run.py, whose environment has it'
        raise BadInput(f"the workbench needs {error.name}; {cure}") from error
    if not 0 <= args.port <= _HIGHEST_PORT:
        raise BadInput(f"--port {args.port}: write a number from 0 (any that is free) to {_HIGHEST_PORT}")
    serve(
        args.project,
        redo=lambda words: command_line(words, args.project),
        host=args.host,
        port=args.port,
        show=not args.no_browser,
        limits=Limits(),
    )
    return 0
