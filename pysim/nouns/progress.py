"""What a verb says while it works: a bar, lines of a log, nothing, or whatever the user does with it."""

from __future__ import annotations

import logging
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from pysim.types import ProgressEvent

Listener = Callable[[ProgressEvent], None]
Progress = Callable[[ProgressEvent], object] | bool | None
LOG = logging.getLogger("pysim")


@contextmanager
def showing(progress: Progress, title: str) -> Iterator[Listener]:
    """Take what is being done, and show it.

    Every stage goes to the logger "pysim" as INFO, every result on the way as DEBUG.

    Args:
        progress: True draws a bar on standard error; None does so where that is a terminal or a notebook; False shows
            nothing; a callable gets every ProgressEvent, and what it raises ends the work.
        title: of the work.
    """
    LOG.info("%s", title)
    wanted = _is_watched() if progress is None else progress is True
    if wanted:
        with _bar(title) as shown:
            yield _logged(shown)
    else:
        yield _logged(progress if callable(progress) else lambda event: None)
    LOG.info("%s: done", title)


def _logged(listener: Callable[[ProgressEvent], object]) -> Listener:
    last = ""

    def heard(event: ProgressEvent) -> None:
        nonlocal last
        if event.stage != last:
            LOG.info("%s", event.stage)
            last = event.stage
        if event.text:
            LOG.debug("%s", event.text)
        listener(event)

    return heard


@contextmanager
def _bar(title: str) -> Iterator[Listener]:
    """A line with what is being done and for how long; results stay above it."""
    from rich.console import Console
    from rich.progress import Progress as Bar
    from rich.progress import SpinnerColumn, TextColumn, TimeElapsedColumn

    columns = (SpinnerColumn(), TextColumn("{task.description}", markup=False), TimeElapsedColumn())
    with Bar(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task(title, total=None)

        def heard(event: ProgressEvent) -> None:
            bar.update(task, description=f"{title}: {event.stage}")
            if event.text:
                bar.console.print(event.text, markup=False, highlight=False)

        yield heard


def _is_watched() -> bool:
    """Whether somebody looks: at a terminal, or at a notebook."""
    shell: Any = sys.modules.get("IPython")
    in_notebook = shell is not None and getattr(shell.get_ipython(), "kernel", None) is not None
    return in_notebook or (sys.stderr is not None and sys.stderr.isatty())
