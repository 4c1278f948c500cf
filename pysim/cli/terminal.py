"""What the streams of this process can show."""

from __future__ import annotations

import os
import sys


def print_everything() -> None:
    """Let standard output replace what its encoding has no letters for: a pipe on Windows knows Latin letters only."""
    if sys.stdout is None:  # closed; nothing else may be opened in its place, as all that is printed would go there
        sys.stdout = os.fdopen(os.open(os.devnull, os.O_RDONLY), "w", closefd=False)
    for stream in (sys.stdout, sys.stderr):
        reconfigure = getattr(stream, "reconfigure", None)  # whatever stands in for it may have none
        if reconfigure is not None and stream.errors == "strict":
            reconfigure(errors="replace")
