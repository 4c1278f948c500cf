"""A search while it runs, on every page that can start one: what each model leaves, and the numbers of the best."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from pysim.app.desk import Desk
from pysim.app.jobs import QUICK
from pysim.app.live import live
from pysim.app.parts import Chart, Table, box, card, text
from pysim.app.records import followed_overlay
from pysim.present.diagnosis.figures.search import left_over, search_chart


def moving(desk: Desk) -> None:
    """The search that runs, or that was stopped, point by point; nothing where there is none."""
    live(lambda: (desk.beat, desk.version, _is_quick(desk)), lambda: _build(desk), "gap")


def _is_quick(desk: Desk) -> bool:
    return desk.runner.running is not None and desk.runner.running.seconds < QUICK


def _build(desk: Desk) -> None:
    job = desk.runner.running or desk.unfinished()
    if job is None or not job.trials or _is_quick(desk):
        return
    ranked = left_over(job.trials)
    best = min(job.trials, key=lambda one: float(one["error"]))
    with card(job.work.title):
        words = f"Best so far: {ranked[0][0]} leaves {ranked[0][1]:.3g} times the noise."
        text("p", words, "statement").props('aria-live="polite"')
        Chart(search_chart(job.trials), "Residual over noise, point by point", height=300)
        if job.curves and not best["names"]:  # they are the base model's
            overlay = followed_overlay(job.curves)
            Chart(overlay.figure(), "The log with the best values", height=70 + 170 * len(overlay.names))
        with box("two"):
            _table("What each model leaves", ("model", "× noise"), ranked)
            _table("Parameters of the best one", ("parameter", "value"), best["values"].items())


def _table(label: str, columns: tuple[str, str], rows: Iterable[tuple[str, float]]) -> None:
    cells: list[list[Any]] = [[name, {"text": f"{value:.4g}", "value": value}] for name, value in rows]
    Table(label, [(columns[0], "words"), (columns[1], "number")], cells, height="240px")
