"""The four models of one pump, each fitted to the same logs; what is held out is seen by none of them."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

from pysim.diagnosis import diagnose
from pysim.identify.greybox import Parameter, fit, problem
from pysim.thesis import pump_model
from pysim.types import Dataset, Fit, Model
from validation.accuracy.judged import HELD_OUT, Judged, judged
from validation.accuracy.transfer import black_box
from validation.asked import PUMP
from validation.diagnosis.intervals import named
from validation.diagnosis.sets import read_set
from validation.fit_thesis.case import LOCKED, NAMES

SET = "bench-03"  # its pump has a dead band in the valve, which the base model has not
HELD_TEST = (75.0, 10.0)  # % offset and amplitude of the stepped sines that are held out, all frequencies
WAVE = "stochastic/Tp0.5_heldout.txt"  # H_s = 100 %, T_p = 0.5 s: the wave of Table 4.9
DIAGNOSED = "diagnosed"


@cache
def dataset() -> Dataset:
    """As measured, with one working point held out besides what the data set itself holds out: wave and chirp."""
    whole = read_set(SET)
    records = (replace(r, use=HELD_OUT) if (r.offset, r.amplitude) == HELD_TEST else r for r in whole.records)
    return replace(whole, records=tuple(records))


@cache
def fitted(label: str) -> Fit:
    """The grey-box fit of the "locked", "free" or "diagnosed" model, each from the values of its own class."""
    free = [Parameter(name) for name in NAMES if label != "locked" or name not in LOCKED]
    if label != DIAGNOSED:
        return fit(problem(pump_model(label), [dataset()], free))
    model, strengths = diagnosed()
    return fit(problem(model, [dataset()], [*free, *strengths]))


def diagnosed() -> tuple[Model, list[Parameter]]:
    """The base model with the effects that a diagnosis of these logs adds, and their strengths as it finds them."""
    withheld = tuple(replace(r, use="test" if r.use == HELD_OUT else r.use) for r in dataset().records)
    found = named(diagnose(PUMP.session(replace(dataset(), records=withheld))))
    model, places = PUMP.variants.build([one.effect for one in found])
    strengths = [
        Parameter(f"{places[one.effect.name]}.{parameter.name}", estimate.value)
        for one in found
        for parameter, estimate in zip(one.effect.parameters, one.estimates, strict=True)
    ]
    return model, strengths


@cache
def models() -> tuple[Judged, ...]:
    """Black box, locked, free, diagnosed."""
    grey = (judged(label, fitted(label), WAVE) for label in ("locked", "free", DIAGNOSED))
    return black_box(dataset(), WAVE), *grey
