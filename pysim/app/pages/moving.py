"""A search while it runs, on every page that can start one: what each model leaves, and the numbers of the best."""

from __future__ import annotations

from typing import Any

from pysim.app.desk import Desk
from pysim.app.jobs import Job
from pysim.app.live import live
from pysim.app.parts import Chart, Table, box, card, text
from pysim.app.records import followed_overlay
from pysim.present.diagnosis.figures.search import left_over, search_chart

_QUICK = 1.0  # s; drawing a search that takes less would only hold it up


def moving(desk: Desk) -> None:
    """The search that runs, or that was stopped; nothing where there is none."""
    live(lambda: (desk.version, _slow(desk.runner.running)), lambda: _build(desk), "gap")


def _slow(job: Job | None) -> bool:
    return job is not None and bool(job.trials) and job.seconds > _QUICK


def _job(desk: Desk) -> Job | None:
    return desk.runner.running or desk.unfinished()


def _build(desk: Desk) -> None:
    running = desk.runner.running
    if _slow(running) or (running is None and (job := desk.unfinished()) and job.trials):
        _Moving(desk)


class _Moving:
    """One figure and two tables that follow the points."""

    def __init__(self, desk: Desk) -> None:
        self._desk = desk
        with card():
            self._head = text("h2", "")
            self._words = text("p", "", "statement").props('aria-live="polite"')
            self._chart = Chart(search_chart(()), "Residual over noise, point by point", height=300)
            self._curves: Chart | None = None
            self._beside = box("")
            with box("two"):
                self._left = _table("What each model leaves", "model", "× noise")
                self._values = _table("Parameters of the best one", "parameter", "value")
        live(lambda: (desk.beat, desk.version), self.show)

    def show(self) -> None:
        """What is known now."""
        job = _job(self._desk)
        if job is None or not job.trials:
            return
        ranked = left_over(job.trials)
        best = min(job.trials, key=lambda one: float(one["error"]))
        self._head.set_text(job.work.title)
        self._words.set_text(f"Best so far: {ranked[0][0]} leaves {ranked[0][1]:.3g} times the noise.")
        self._chart.show(search_chart(job.trials), f"Residual over noise: {ranked[0][0]} {ranked[0][1]:.3g}")
        self._left.show([[name, _cell(error)] for name, error in ranked])
        self._values.show([[name, _cell(value)] for name, value in best["values"].items()])
        if not job.curves:
            return
        overlay = followed_overlay(job.curves)
        label, figure = f"The log with the best values, {job.curves['error']:.3g} times the noise", overlay.figure()
        if self._curves is None:
            with self._beside:
                self._curves = Chart(figure, label, height=70 + 170 * len(overlay.names))
        else:
            self._curves.show(figure, label)


def _table(label: str, *columns: str) -> Table:
    return Table(label, [(columns[0], "words"), (columns[1], "number")], (), height="240px")


def _cell(value: float) -> dict[str, Any]:
    return {"text": f"{value:.4g}", "value": value}
