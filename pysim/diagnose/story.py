"""What the steps of a diagnosis share and write down as they go."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import astuple, dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pysim.diagnose.adapter import Target
from pysim.diagnose.blame import Blame
from pysim.diagnose.contenders import Contender, suited
from pysim.diagnose.corrections import (
    Nuisance,
    allowing,
    blamed,
    held_beside,
    leaning,
    recounted,
    told_apart,
)
from pysim.diagnose.doubt import held_still
from pysim.diagnose.fitted import Fitted
from pysim.diagnose.journal import Journal, identity
from pysim.diagnose.jumps import without
from pysim.diagnose.ledger import after, beside, ledger_step
from pysim.diagnose.nuisance import Suspect
from pysim.diagnose.nuisance_words import counting_in_words, in_words
from pysim.diagnose.residuals import Ruler, rulers
from pysim.diagnose.steps import as_fine, with_tolerance
from pysim.diagnose.subject import Extended, Subject, extended
from pysim.diagnosis.failures import failures
from pysim.identify.greybox.residuals import Point
from pysim.identify.greybox.time_log import TimeLog
from pysim.types import Candidate, Effect, LedgerStep, Note, Stage, Told

Array = NDArray[np.float64]
Say = Callable[[Told], None]

# Tolerances of runs of what is held out, over those of the others.
_FINER = 0.1


@dataclass
class Story:
    """One diagnosis while it runs; it stays within this package.

    Args:
        subject: model, measurements, catalogue.
        tell: gets what is being done and what was learned.
        seed: of every draw.
        ruler, held: count what is fitted, and what is held out if anything is.
        journal: of finished parts.
        refused: why the leader of the last round was not added; "" where there was none.
    """

    subject: Subject
    tell: Say
    seed: int
    ruler: Ruler
    held: Ruler | None
    journal: Journal
    ledger: list[LedgerStep] = field(default_factory=list)
    seconds: dict[str, float] = field(default_factory=dict)
    notes: list[Note | str] = field(default_factory=list)
    ranking: list[Candidate] = field(default_factory=list)
    ties: list[tuple[str, ...]] = field(default_factory=list)
    stages: list[Stage] = field(default_factory=list)
    doing: str = ""
    begun: float = field(default_factory=time.monotonic)
    suits: dict[tuple[str, ...], Ruler] = field(default_factory=dict)
    nuisances: tuple[Nuisance, ...] = ()
    tied: tuple[Fitted, Fitted] | None = None
    refused: str = ""
    blames: dict[tuple[object, ...], Blame] = field(default_factory=dict)
    measured: tuple[Target, ...] = ()
    suspected: tuple[Suspect, ...] = ()
    first: Ruler = field(init=False)

    def __post_init__(self) -> None:
        self.measured, self.first = self.subject.targets, self.ruler.plain

    def now(self, doing: str) -> None:
        """A new stage begins, in a few words."""
        self.doing = doing
        self.tell(Told(doing))

    def say(self, text: str, step: LedgerStep | None = None) -> None:
        """Something was learned."""
        self.tell(Told(self.doing, text, step))

    def note(self, text: Note | str) -> None:
        """What a reader must know, once."""
        if text not in self.notes:
            self.notes.append(text)

    def stage(self, name: str) -> None:
        """A stage of that name has ended."""
        now = time.monotonic()
        self.seconds[name] = self.seconds.get(name, 0.0) + now - self.begun
        self.begun = now

    def afresh(self) -> None:
        """The last model entered was no good: what was learned from it is forgotten."""
        self.ledger.pop()
        self.stages.pop()
        self.ranking, self.ties, self.tied = [], [], None
        self.journal.afresh()

    def without(self, sources: Sequence[str]) -> Story:
        """The same diagnosis begun again without these logs."""
        targets = without(self.measured, sources)
        ruler, held = rulers(targets, self.ruler.workers, told=self.subject.specified)
        self.journal.afresh()
        subject = replace(self.subject, targets=targets)
        return Story(
            subject, self.tell, self.seed, ruler, held, self.journal, notes=list(subject.notes), seconds=self.seconds
        )

    def enter(self, name: str, at: Fitted) -> LedgerStep:
        """A model joins the ledger."""
        found = beside(self.subject, at.what, at.point.x, self.ruler.workers)
        counted = [self.ruler, *([self.held] if self.held else [])]
        each = [pair for one in counted for pair in zip(one.targets, one.skips, strict=True)]
        skips = {target.source: skip for target, skip in each if isinstance(target, TimeLog)}
        step = ledger_step(name, found, at.point.cost, skips)
        self.ledger.append(step)
        estimates, directions = ((), ()) if name == "prior" else held_still(self.subject, at)
        where = failures([after(record, skips) for record in found.records], self.subject.dataset)
        self.stages.append(Stage(name, estimates, directions, found.records, found.responses, where))
        for note in found.notes:
            self.note(note)
        held = "" if step.validate is None else f", held out {step.validate:.3f}"
        fitted = "" if step.fit is None else f" {step.fit:.3f}{held};"
        self.say(f"{name}: residual over noise{fitted} sum of squares {step.cost:.6g}", step)
        self.stage("ledger")
        return step

    def ruler_of(self, what: Extended) -> Ruler:
        """The ruler with the method of integration that suits a model."""
        return self.suits.get(_key(what.effects), self.ruler)

    def extended(self, current: Fitted, *effects: Effect) -> Contender:
        """The model so far with more effects.

        Raises:
            BadInput: it cannot be made.
        """
        what = extended(self.subject, [*current.what.effects, *effects])
        key = _key(what.effects)
        if key not in self.suits:
            self.suits[key] = suited(self.ruler, current, what, effects)
        return Contender(effects[-1], what, self.suits[key])

    def fitted(
        self,
        what: Extended,
        part: str,
        find: Callable[[], tuple[Point, Array] | None],
        lean: Ruler | None = None,
    ) -> Fitted | None:
        """A refit that is done once, as the ruler of the model counts it; None where it came to nothing.

        Args:
            part: its name in the journal.
            find: a point with slopes, and where these were run.
            lean: the ruler of that point where it is not the model's, because it allows for fewer nuisances.
        """
        point: list[Point] = []
        ruler = self.ruler_of(what)

        def found() -> Any:
            end = find()
            if end is None:
                return None
            point.append(end[0])
            suspects = [astuple(s) for s in (lean or ruler).suspected]
            return {"x": end[0].x.tolist(), "slopes": end[1].tolist(), "nuisances": suspects}

        kept = self.journal.once(part, found)
        if kept is None:
            return None
        lean = ruler.only([Suspect(*row) for row in kept["nuisances"]])
        if not point:
            point.append(_again(lean, what, np.array(kept["x"]), slopes_at=np.array(kept["slopes"])))
        return recounted(lean, ruler, Fitted(what, point[0]))

    def allow(self, what: Extended, x: Array) -> Point:
        """From now on residuals are counted across nuisances, and without wrong starts.

        Args:
            x: (n,) of the base model, near the plant.
        Returns:
            the point there.
        """
        self.ruler, self.held = allowing(self.ruler, self.held, what, x)
        point = self.ruler.evaluation(what, x)
        if point.good:
            self.ruler, point = told_apart(self.ruler, point)
        self.suspected, self.first = self.ruler.suspected, self.ruler.plain
        return point

    def suspect(self, suspects: Sequence[Suspect]) -> None:
        """From now on these nuisances are allowed for."""
        self._count(lambda one: one.with_other(suspected=tuple(suspects)))

    def as_fine(self, fine: Ruler) -> None:
        """From now on runs are integrated no more roughly than by that ruler."""
        self._count(lambda one: as_fine(one, fine))

    def count_by(self, ruler: Ruler) -> None:
        """From now on residuals are counted as that ruler does; each model keeps its method of integration."""
        self._count(lambda one: replace(ruler, solver=one.solver))

    def _count(self, changed: Callable[[Ruler], Ruler]) -> None:
        self.ruler = changed(self.ruler)
        self.suits = {key: changed(one) for key, one in self.suits.items()}
        self.blames.clear()

    def blame(self, at: Fitted) -> Blame:
        """Who is to blame beside a model that was refitted with every suspect allowed for."""
        key = _where(at)
        if key not in self.blames:
            self.blames[key] = blamed(self.ruler_of(at.what), at.point)
        return self.blames[key]

    def know(self, at: Fitted, blame: Blame) -> None:
        """Who is to blame was found out before."""
        self.blames[_where(at)] = blame

    def disturbed(self) -> list[str]:
        """The nuisances that were taken off, in words."""
        return in_words(self.nuisances, self._units)

    def counting(self) -> list[str]:
        """How residuals are counted, where that is not as told, in words."""
        return counting_in_words(self.ruler, self.held, self._units, told=self.subject.specified)

    @property
    def _units(self) -> dict[str, str]:
        return {s.name: s.unit for s in self.subject.dataset.signals} if self.subject.dataset is not None else {}

    def held_out(self, at: Fitted) -> Array | None:
        """Residuals of what is held out, (n,); None where nothing is or where it could not be simulated.

        The model is taken as it is beside the nuisances that are to blame: others that were allowed for have loosened
        its parameters, and what is held out is read without them.
        """
        if self.held is None:
            return None
        ruler = self.ruler_of(at.what)
        lean = ruler.only(self.blame(at).suspects)
        counted = recounted(ruler, lean, at)
        right = replace(held_beside(lean, self.held, counted), solver=ruler.solver)
        x = at.point.x if lean.suspected == ruler.suspected else leaning(lean, counted)
        # one run, in finer steps, so that what speaks for or against is not its error
        return with_tolerance(right, _FINER).at(at.what, x)


def begin(
    subject: Subject,
    *,
    seed: int,
    workers: int | None,
    progress: Say | None,
    journal: Path | None = None,
    settings: dict[str, object] | None = None,
) -> Story:
    """A story that has not begun.

    Raises:
        BadInput: the journal is that of another diagnosis.
    """
    kept = Journal(journal, identity(subject, {"seed": seed, **(settings or {})}))
    ruler, held = rulers(subject.targets, workers, told=subject.specified)
    return Story(subject, progress or (lambda told: None), seed, ruler, held, kept, notes=list(subject.notes))


def _again(ruler: Ruler, what: Extended, x: Array, *, slopes_at: Array) -> Point:
    """A point of an earlier run, bit for bit, with slopes that were run at another (n,)."""
    near = ruler.evaluation(what, slopes_at)
    residual = near.residual if np.array_equal(x, slopes_at) else ruler.at(what, x)
    assert residual is not None  # it was there when it was written
    return replace(near, x=x, cost=float(residual @ residual), residual=residual)


def _where(at: Fitted) -> tuple[object, ...]:
    return (*_key(at.what.effects), at.point.x.tobytes())


def _key(effects: tuple[Effect, ...]) -> tuple[str, ...]:
    return tuple(effect.name for effect in effects)
