"""The command line: `pysim COMMAND`, a file per command."""

from pysim.cli._main import main

__all__ = ["main"]
