"""How the initial state of a log is left free, and how it is held at rest: the one place that knows."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from pysim.identify.greybox import Parameter, Treatment
from pysim.types import MeasuredRecord, Model


@dataclass(frozen=True)
class Way:
    """What a fit is given beside its model parameters.

    Args:
        records: of the data set.
        free: start values, as parameters of their log.
        treatment: how logs are compared.
    """

    records: tuple[MeasuredRecord, ...]
    free: tuple[Parameter, ...] = ()
    treatment: Treatment | None = None


def freed(model: Model, records: Sequence[MeasuredRecord], states: Sequence[str]) -> Way:
    """Each log begins where it may; `states` are those that last."""
    return Way(tuple(records))


def at_rest(records: Sequence[MeasuredRecord]) -> Way:
    """Each log begins at rest."""
    return Way(tuple(replace(record, initial="rest") for record in records))
