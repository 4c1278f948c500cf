"""A refitted model brought to rest: near, finely integrated, and beside the nuisances that are to blame, no others."""

from __future__ import annotations

from dataclasses import astuple, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pysim.diagnose import decide
from pysim.diagnose.corrections import (
    Settled,
    implausible,
    is_off,
    recounted,
    settled,
    settled_before,
)
from pysim.diagnose.fitted import Fitted
from pysim.diagnose.nuisance import Suspect, undisturbed
from pysim.diagnose.refit import refit_from
from pysim.diagnose.residuals import Ruler
from pysim.diagnose.roughness import roughness
from pysim.diagnose.steps import fine_enough
from pysim.diagnose.story import Story
from pysim.diagnose.wrong_starts import started
from pysim.identify.greybox.residuals import Point

Array = NDArray[np.float64]


def plausible(story: Story, at: Fitted, part: str, start: Fitted) -> Fitted:
    """A model far off refitted without nuisances of sizes that no sensor and no clock has.

    They are left out until a model is near.

    Args:
        at: with every nuisance allowed for that the ruler has.
        part: its name in the journal.
        start: where the refit starts, counted without nuisances: where `at` is, nuisances and parameters hide the
            misfit together.
    """
    what, plain = at.what, list[Fitted]()
    while absurd := implausible(story.ruler_of(what), at.point):
        story.suspect([s for s in story.ruler.suspected if s not in absurd])
        ruler = story.ruler_of(what)

        def found(ruler: Ruler = ruler) -> tuple[Point, Array]:
            if not plain:
                plain.append(Fitted(what, refit_from(ruler.plain, what, start.point, slow_first=False)[0]))
            first = recounted(ruler.plain, ruler, plain[0]).point
            return refit_from(ruler, what, first, slow_first=False)

        part = f"{part} without {', '.join(f'{s.kind} {s.signal}'.strip() for s in absurd)}"
        again = story.fitted(what, part, found)
        assert again is not None  # the start was good, so the end is
        at = again
    return at


def settle(story: Story, at: Fitted, part: str) -> Settled:
    """The model with the nuisances that are to blame beside it taken off the measurements."""
    at, done = _finely(story, _with_all(story, at, part), part), list[Settled]()
    ruler = story.ruler_of(at.what)

    def found() -> Any:
        done.append(settled(ruler, at))
        return {"x": done[0].at.point.x.tolist(), "blame": [astuple(s) for s in done[0].lean.suspected]}

    kept = story.journal.once(f"nuisances beside {part}", found)
    suspected = [Suspect(*row) for row in kept["blame"]]
    end = done[0] if done else settled_before(ruler, at, np.array(kept["x"]), suspected)
    story.count_by(end.ruler)
    if story.held is not None:
        story.held = started(story.held, end.at.what, end.at.point.x)
    for line in story.counting():
        story.note(line)
    story.subject = replace(story.subject, targets=undisturbed(story.measured, end.amounts))
    story.nuisances = end.seen if end.at.point.cost < decide.LEVEL * end.lean.freedom else ()
    for line in story.disturbed():
        story.say(line)
    return end


def _with_all(story: Story, at: Fitted, part: str) -> Fitted:
    """The model with nuisances allowed for again that were left out while models were far off."""
    near = story.ruler_of(at.what)
    if near.suspected == story.suspected or is_off(near, at.point):
        return at
    story.suspect(story.suspected)
    ruler = story.ruler_of(at.what)
    first = recounted(near, ruler, at).point
    again = story.fitted(at.what, f"{part} with all nuisances", lambda: refit_from(ruler, at.what, first))
    assert again is not None  # the start was good, so the end is
    return again


def _finely(story: Story, at: Fitted, part: str) -> Fitted:
    """The model refitted with runs whose error is small beside the noise, as are all that follow."""
    rough = story.ruler_of(at.what)
    if is_off(rough, at.point):
        return at
    fine, first, left = fine_enough(rough, at)
    left = max(left, roughness(fine, replace(at, point=first)))
    if left:
        story.note(
            f"{part}: however fine the steps, the smallest change moves the response by {left:.2g} standard "
            "deviations of the noise in all, as where a plant sticks and slips; intervals are widened for it"
        )
    if fine is rough:
        return replace(at, rough=left)
    story.as_fine(fine)
    again = story.fitted(at.what, f"{part} in finer steps", lambda: refit_from(fine, at.what, first))
    assert again is not None  # the start was good, so the end is
    return replace(again, rough=left)
