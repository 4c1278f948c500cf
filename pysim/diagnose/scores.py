"""What an effect is worth once the model has been refitted with it."""

from __future__ import annotations

from pysim.diagnose import decide
from pysim.diagnose.fitted import Fitted
from pysim.diagnose.story import Story


def score(story: Story, current: Fitted, fitted: Fitted) -> float:
    """What the effects added are worth, less the cost of their parameters."""
    extra = fitted.point.x.size - current.point.x.size
    return gain(story, current, fitted) - decide.price(extra, current.point.residual.size)


def gain(story: Story, current: Fitted, fitted: Fitted) -> float:
    """Fall of the sum of squares, each model with the nuisances that are to blame beside it."""
    return story.blame(fitted).over(story.blame(current))


def share(story: Story, current: Fitted, fitted: Fitted) -> float:
    """Of the avoidable misfit that the effects added take, 0 ... 1."""
    freedom = current.point.residual.size - current.point.x.size
    return decide.explained(gain(story, current, fitted), story.blame(current).cost, freedom)


def by_score(story: Story, current: Fitted, found: dict[str, Fitted]) -> list[str]:
    """Names, the best first."""
    return sorted(found, key=lambda name: -score(story, current, found[name]))
