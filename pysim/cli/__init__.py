"""The command line: `pysim COMMAND`, a file per command."""

from pysim.cli.main import main

__all__ = ["main"]
