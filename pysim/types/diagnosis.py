"""The answer of `pysim.diagnose`. It goes with that package; what everything else reads is `pysim.types.answer`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from pysim.types._frozen import FrozenMapping
from pysim.types.answer import NONE, UNKNOWN, Failure, NextTest  # noqa: F401  the old package reads them here
from pysim.types.effect import Effect
from pysim.types.errors import BadInput
from pysim.types.fit import Direction, Estimate, RecordFit, ResponseFit
from pysim.types.note import Note

Array = NDArray[np.float64]


@dataclass(frozen=True)
class AddedEffect:
    """One effect that was added to the model, with the size the data give it.

    Args:
        effect: of the catalogue.
        place: name ahead of its parameters' names in the extended model.
        estimates: of its parameters, by their names as the class declares them.
    """

    effect: Effect
    place: str
    estimates: tuple[Estimate, ...]


@dataclass(frozen=True)
class Candidate:
    """One effect that was considered.

    Args:
        effect: its standard name.
        score: by how much the sum of squares over noise falls once everything is refitted with it, less the cost of
            its parameters.
        p_value: chance of such a fall where the effect is absent, for this candidate alone.
        explained: share of the avoidable misfit, 0 ... 1.
        refitted: whether the fall was reached by a refit, not promised by the screening alone.
        parameters: the effect's parameters there, by their names as declared.
        round: of the search: 1 where it was to mend the base model, 2 where an effect was in already.
    """

    effect: str
    score: float
    p_value: float
    explained: float
    refitted: bool = True
    parameters: Mapping[str, float] = field(default_factory=dict)
    round: int = 1

    def __post_init__(self) -> None:
        object.__setattr__(self, "parameters", FrozenMapping(self.parameters))


@dataclass(frozen=True)
class LedgerStep:
    """One step of the story.

    Args:
        step: "prior", "refit", or the effect that was added.
        fit, validate: root-mean-square residual over noise; None where there is no such record.
        criteria: worst value of each criterion of thesis Tables 1.3 and 1.4 over all records, by symbol.
        passes: whether all of these are within their limits.
        cost: sum of squares over noise of what is fitted.
        not_simulated: records that the model could not be run through: their part in the criteria is not known.
    """

    step: str
    fit: float | None
    validate: float | None
    criteria: Mapping[str, float]
    passes: bool
    cost: float
    not_simulated: int = 0

    def __post_init__(self) -> None:
        object.__setattr__(self, "criteria", FrozenMapping(self.criteria))


@dataclass(frozen=True)
class Shape:
    """A missing term tabulated over what it depends on.

    Args:
        argument: (n,) increasing, in `argument_unit`.
        value: (n,) of the term there, in `unit`.
        low, high: (n,) its 95 percent band.
        argument_unit, unit: SI, or as the model counts.
        absorbed: (n, k) terms that the model's own parameters do as well: any amount of them may be added without a
            trace in the data, and the band holds for the amount shown.
    """

    argument: Array
    value: Array
    low: Array
    high: Array
    argument_unit: str
    unit: str
    absorbed: Array = field(default_factory=lambda: np.zeros((0, 0)))


@dataclass(frozen=True)
class Missing:
    """What a place of the model would need to close the gap, estimated without naming an effect.

    Args:
        slot: replaceable part, state equation, input or output that was probed.
        share: of the avoidable misfit that the best term there takes, 0 ... 1.
        depends_on: variable over which the term is best described; "time" where none describes it.
        shape: of the term over that variable.
        formula: a short expression for it, "" where none fits.
        alike: other places whose best term these data do not tell from this one.
        parameters: free numbers of the model, by name, refitted beside the term.
    """

    slot: str
    share: float
    depends_on: str
    shape: Shape
    formula: str = ""
    alike: tuple[str, ...] = ()
    parameters: Mapping[str, float] = field(default_factory=dict)

    def __post_init__(self) -> None:
        object.__setattr__(self, "parameters", FrozenMapping(self.parameters))


@dataclass(frozen=True)
class Stage:
    """The model at one step of the story, beside every record: what can be drawn of it.

    Args:
        step: as in the ledger: "prior", "refit", or the effect that was added.
        estimates: its free parameters with intervals, one parameter of each direction in `undetermined` held where it
            stands; none of the untouched model, whose values are their starts.
        undetermined: products of parameters that change nothing, the first of each the one that was held.
        records: logs beside the model, those held out too.
        responses: frequency responses, from tables or from stepped sines.
        where: it fails, worst first.
    """

    step: str
    estimates: tuple[Estimate, ...] = ()
    undetermined: tuple[Direction, ...] = ()
    records: tuple[RecordFit, ...] = field(default=(), repr=False)
    responses: tuple[ResponseFit, ...] = field(default=(), repr=False)
    where: tuple[Failure, ...] = field(default=(), repr=False)

    def on_the_scale_of(self, other: Stage) -> dict[str, float]:
        """Its values, moved along what changes nothing until the parameters held have the other stage's values."""
        values, ends = {e.name: e.value for e in self.estimates}, {e.name: e.value for e in other.estimates}
        for direction in self.undetermined:
            held, exponent = next(iter(direction.exponents.items()))
            if values.get(held, 0.0) > 0 and ends.get(held, 0.0) > 0:
                factor = (ends[held] / values[held]) ** (1 / exponent)
                values |= {name: values[name] * factor**e for name, e in direction.exponents.items()}
        return values

    def moves_from(self, before: Stage) -> dict[str, float | None]:
        """By how many half widths of its 95 percent interval here each parameter has moved; None where it has none."""
        ends = {e.name: e for e in self.estimates}
        return {name: _moved(value, ends[name]) for name, value in before.on_the_scale_of(self).items() if name in ends}


def _moved(before: float, after: Estimate) -> float | None:
    half = (after.interval[1] - after.interval[0]) / 2
    return abs(after.value - before) / half if after.determined and half > 0 else None


@dataclass(frozen=True)
class Told:
    """What a diagnosis tells while it works; as text, what was learned or is being done.

    Args:
        stage: what it is doing now, in a few words.
        text: what was learned, a line; "" where only the stage is new.
        step: of the ledger, where one is done.
    """

    stage: str
    text: str = ""
    step: LedgerStep | None = None

    def __str__(self) -> str:
        return self.text or f"{self.stage} ..."


@dataclass(frozen=True)
class Diagnosis:
    """The whole answer.

    Args:
        verdict: NONE, UNKNOWN, or the standard name of the first effect the data demand.
        reason: the same as a sentence.
        added: effects, in the order in which they were added.
        ranking: candidates, best first.
        confusable: groups of candidates that the data do not tell apart.
        error: the ledger.
        parameters: of the final model.
        where: where the base model fails, worst first.
        seconds: wall time by stage.
        notes: what a reader must know: what could not be tried, noise that had to be estimated.
        missing: per probed place, the largest share first; empty where nothing was probed.
        next_test: where two answers are left that another experiment would tell apart.
        stages: the models of the ledger beside every record.
        conditions: what it takes to repeat it, in words: model, data, seed, solver, versions.
        complete: whether nothing but noise is left after `added`; None where that was not judged.
        left: rms over floor of what is left, fitted and held out; share of it that follows the model's own signals, and
            its t.
    """

    verdict: str
    reason: str
    added: tuple[AddedEffect, ...]
    ranking: tuple[Candidate, ...]
    confusable: tuple[tuple[str, ...], ...]
    error: tuple[LedgerStep, ...]
    parameters: tuple[Estimate, ...]
    where: tuple[Failure, ...]
    seconds: Mapping[str, float]
    notes: tuple[Note | str, ...] = ()
    missing: tuple[Missing, ...] = ()
    next_test: NextTest | None = None
    stages: tuple[Stage, ...] = field(default=(), repr=False)
    conditions: Mapping[str, str] = field(default_factory=dict)
    complete: bool | None = None
    left: tuple[float | None, float | None, float | None, float | None] | None = None

    def __post_init__(self) -> None:
        for name in ("seconds", "conditions"):
            object.__setattr__(self, name, FrozenMapping(getattr(self, name)))
        if self.verdict in (NONE,) and self.added:
            raise BadInput(f"diagnosis: the verdict is {NONE}, but effects were added; name the first of them")
