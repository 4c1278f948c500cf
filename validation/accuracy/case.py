"""One pump, four models: who meets thesis Tables 1.3 and 1.4, on what was fitted and on what was held out."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from matplotlib.figure import Figure

from pysim.identify import FREQUENCY_CRITERIA, TIME_CRITERIA
from pysim.types import Criterion
from validation.accuracy.judged import ANGLE, COLUMNS, FIT, HELD_OUT, STEADY, VALVE, Judged, table
from validation.accuracy.models import DIAGNOSED, WAVE, fitted, models
from validation.accuracy.pictures import criteria_figure, wave_figure
from validation.findings import Finding

_ERROR = 1.05  # of the noise: what is left of a model that misses nothing, over the few logs that are held out
_LOCKED_TIMES = 0.5  # of Table 4.9's numbers at least: another pump, whose valve the locked model misses as well


def notes() -> Sequence[str]:
    """The table, a line per model and use."""
    return tuple(" | ".join(row).replace("**", "") for row in table(models()))


def run() -> Iterator[Finding]:
    """Claims about each model; the table they are about is printed first."""
    black, locked, free, diagnosed = models()
    print("\n".join(notes()), flush=True)
    yield _beyond(black, FIT, ANGLE, "at its own working points", FREQUENCY_CRITERIA)
    for use, words in ((FIT, "fitted to sines, in a wave"), (HELD_OUT, "in the logs held out")):
        yield _beyond(black, use, ANGLE, words, TIME_CRITERIA)
    over = max(_over(black, criterion, HELD_OUT, ANGLE) for criterion in FREQUENCY_CRITERIA)
    claim = f"black box: where it was not fitted its neighbour's is {over:.1f} times Table 1.3; short of missing by"
    yield Finding(claim, max(0.0, 1.0 - over), 0.0, "of the limit")
    yield from _locked(locked)
    for model in (free, diagnosed):
        for use, words in ((FIT, "fitted"), (HELD_OUT, "held out")):
            yield _beyond(model, use, ANGLE, words, (*FREQUENCY_CRITERIA, *TIME_CRITERIA))
            yield _beyond(model, use, VALVE, words, TIME_CRITERIA)
    yield from _better(diagnosed, free)
    yield from _better(free, locked)
    steady = max(diagnosed.worst(STEADY, use, ANGLE) or 0.0 for use in (FIT, HELD_OUT))
    yield Finding("diagnosed: no steady-state error that the angle's reading can show", steady, STEADY.limit, "%")
    logs = [r for r in fitted(DIAGNOSED).records if r.use == HELD_OUT and not r.harmonics]
    left = max(size for record in logs for size in record.rms.values())
    yield Finding("diagnosed: residual over noise in held-out logs over time", left, _ERROR, "times the noise")


def _over(model: Judged, criterion: Criterion, use: str, signal: str) -> float:
    """The worst value as a share of its limit."""
    value = model.worst(criterion, use, signal)
    return float("nan") if value is None else value / criterion.limit


def _beyond(model: Judged, use: str, signal: str, words: str, criteria: Sequence[Criterion]) -> Finding:
    over = {criterion: _over(model, criterion, use, signal) for criterion in criteria}
    over = {criterion: value for criterion, value in over.items() if value == value}
    worst = max(over, key=lambda criterion: over[criterion])
    name = {ANGLE: "angle", VALVE: "valve"}[signal]
    return Finding(f"{model.label}: {name} {words}, worst is the {worst.name}", over[worst], 1.0, "of the limit")


def _locked(locked: Judged) -> Iterator[Finding]:
    """Table 4.9: 7.86 and 18.49 percent, and it fails."""
    for criterion, printed in zip(TIME_CRITERIA, (7.86, 18.49), strict=True):
        found = locked.worst(criterion, HELD_OUT, VALVE) or 0.0
        claim = f"locked: valve in the wave of Table 4.9, {criterion.name} {found:.2f} % (printed {printed}); short of"
        least = max(criterion.limit, _LOCKED_TIMES * printed)
        yield Finding(f"{claim} failing as there by", max(0.0, least - found), 0.0, "%")


def _better(model: Judged, other: Judged) -> Iterator[Finding]:
    """On what is held out, in every number."""
    ratios = {}
    for criterion, signal in COLUMNS:
        one, two = model.worst(criterion, HELD_OUT, signal), other.worst(criterion, HELD_OUT, signal)
        if one is not None and two is not None:
            ratios[f"{criterion.symbol} {signal}"] = one / two
    worst = max(ratios, key=lambda name: ratios[name])
    yield Finding(f"{model.label} over {other.label}, held out, at worst ({worst})", ratios[worst], 1.0, "")


def pictures() -> Mapping[str, Figure]:
    """The table as a figure, and the held-out wave."""
    return {
        "Every model against the limits of thesis Tables 1.3 and 1.4, worst of its tests and logs.": criteria_figure(
            models()
        ),
        f"{WAVE}, which no model has seen: the valve as in Figures 4.6 and 4.7.": wave_figure(models()),
    }
