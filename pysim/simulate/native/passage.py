"""What a run with derivatives has in common with one without: breaks of the inputs, and its end."""

from __future__ import annotations

from typing import Any

import numpy as np

from pysim.simulate.native.compiled import doubles, native
from pysim.simulate.native.point import set_point
from pysim.simulate.native.state import DONE, RUNNING, TOO_MANY_STEPS


@native
def at_break(job: Any) -> bool:
    """Whether the point reached is a break of the inputs with a segment behind it."""
    return bool(job.run.t >= job.run.horizon and job.run.segment + 1 < job.breaks.count)


@native
def next_segment(job: Any) -> None:
    """Enter the first segment of the inputs, or the one behind the break that was reached."""
    run = job.run
    run.segment += 1
    run.horizon = doubles(job.breaks.times)[run.segment]
    run.inputs_at = np.nan


@native
def offset_here(job: Any) -> bool:
    """Add the offset to the states where its time has come; whether it had. The model takes it as an event."""
    run = job.run
    if not (run.t >= run.offset_at):
        return False
    run.offset_at = np.nan
    x, more = doubles(job.work.x), doubles(run.offset)
    for i in range(job.work.n):
        x[i] += more[i]
    run.status = max(run.status, set_point(job, run.t, job.work.x))
    return True


@native
def ended(job: Any) -> int:
    """Whether the point reached is the last one: DONE, TOO_MANY_STEPS or RUNNING."""
    run = job.run
    if run.t >= run.end:
        return DONE
    return TOO_MANY_STEPS if run.steps >= job.control.max_steps else RUNNING
