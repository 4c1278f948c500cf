"""`pysim app`."""

from __future__ import annotations

from pathlib import Path

from pysim.cli.command import DONE, Command, Given
from pysim.cli.option import argument, number, switch, text

_HIGHEST_PORT = 65535


def run(given: Given) -> int:
    """Serve until Ctrl-C."""
    from pysim.types import BadInput

    try:
        from pysim.app import Limits, serve
    except ModuleNotFoundError as error:
        cure = 'pip install "hydraulic-test-bench[app]", or start it with run.py of a clone, whose environment has it'
        raise BadInput(f"the workbench needs {error.name}; {cure}") from error
    if not 0 <= given.port <= _HIGHEST_PORT:
        raise BadInput(f"--port {given.port}: write a number from 0 (any that is free) to {_HIGHEST_PORT}")
    serve(
        given.project,
        host=given.host,
        port=given.port,
        show=not given.no_browser,
        limits=Limits(),
    )
    return DONE


COMMAND = Command(
    "app",
    "Open the workbench in the browser: compare, locate, add an effect, and watch the error fall.",
    run,
    options=(
        argument("PROJECT", "folder of the project (workbench)", convert=Path, nargs="?", default=Path("workbench")),
        number("--port", "N", 0, "port to listen on; 0 takes any free port", convert=int),
        text("--host", "NAME", "address to listen on; by default only this machine reaches it", default="127.0.0.1"),
        switch("--no-browser", "print the address and open nothing"),
    ),
)
