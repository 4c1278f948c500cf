"""What a model lacks, asked of measurements."""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pysim.nouns.common import Measured, dataset_of
from pysim.nouns.fit import Fit
from pysim.nouns.law import Law, laws_of
from pysim.nouns.model import Model, model_given
from pysim.nouns.table import Shown, Table
from pysim.nouns.where import Where
from pysim.present.progress import Progress, showing
from pysim.types import BadInput, Dataset
from pysim.types import Diagnosis as Answer
from pysim.types.kinds import names_of, path_of

if TYPE_CHECKING:
    from pysim.workflow import Initial, SessionParts

Subject = Model | Fit


def diagnose(
    subject: Subject,
    data: Measured | None = None,
    *,
    effects: Sequence[str] | None = None,
    max_effects: int = 3,
    initial: Initial = None,
    checkpoint: Path | str | None = None,
    progress: Progress = None,
) -> Diagnosis:
    """Say which physical effect a model lacks, or that none is missing, or that what is missing is not known.

    Args:
        subject: a fit, which brings its data, or a model.
        data: what `pysim.load` gives; of a fit its own by default.
        effects: names of the effects to consider; all that the model's slots take where None.
        max_effects: that are added at most.
        initial: of each log: "rest", "estimate", or state -> value; None as the fit had it, else as the data say.
        checkpoint: file that a diagnosis which was stopped goes on from.
        progress: see `pysim.present.progress.showing`.
    Raises:
        BadInput: what does not fit together, or measurements that cannot carry a diagnosis.
    """
    from pysim.diagnosis import Settings
    from pysim.diagnosis import diagnose as searched

    model, dataset, begin, begins = _given(subject, data, initial)
    if model.effects_in:
        names = ", ".join(one.name for one in model.effects_in)
        raise BadInput(
            f"diagnose: the model has {names} already; diagnose the one without, which has it as a candidate"
        )
    parts = _parts(model, dataset, begin, begins, None if effects is None else names_of(effects, "effects"))
    work = partial(searched, checkpoint=None if checkpoint is None else path_of(checkpoint, "checkpoint"))
    found = _asked(parts, work, progress, f"diagnosing {model.name}", Settings(max_effects=max_effects))
    return Diagnosis(found, replace(model, measured=dataset, initial=begin), parts)


def locate(
    subject: Subject,
    data: Measured | None = None,
    *,
    initial: Initial = None,
    checkpoint: Path | str | None = None,
    progress: Progress = None,
) -> tuple[Law, ...]:
    """Where a law is missing that no catalogue has, and what it looks like: of each place the best, likeliest first.

    Args:
        subject, data, initial, checkpoint, progress: as of `diagnose`; effects that the model has stay in.
    Raises:
        BadInput: the model's class is not at hand, or what `diagnose` refuses.
    """
    from pysim.diagnosis import learn

    model, dataset, begin, begins = _given(subject, data, initial)
    parts = _parts(replace(model, effects_in=()), dataset, begin, begins)
    work = partial(
        learn, effects=model.effects_in, checkpoint=None if checkpoint is None else path_of(checkpoint, "checkpoint")
    )
    return laws_of(_asked(parts, work, progress, f"locating what {model.name} lacks"), model)


def _given(
    subject: Subject, data: Measured | None, initial: Initial
) -> tuple[Model, Dataset, Initial, Mapping[str, float]]:
    """Model before it was fitted, measurements, what is known of each log's first sample, and what was fitted."""
    if isinstance(subject, Fit):
        dataset = subject.dataset if data is None else dataset_of(data)
        return subject.begun, dataset, subject.initial if initial is None else initial, subject.values
    subject = model_given(subject, "diagnose and locate", "subject")
    if data is None:
        raise BadInput(
            "a model alone has no measurements; write diagnose(model, data), or diagnose(fit)", argument="data"
        )
    return subject, dataset_of(data), subject.first_sample(initial), {}


def _parts(
    model: Model, dataset: Dataset, initial: Initial, begins: Mapping[str, float], effects: Sequence[str] | None = None
) -> SessionParts:
    """All that a session is made of."""
    from pysim.workflow import beginning, initial_values, reference_of, session_parts

    begun: dict[str, float] = {}
    is_given = isinstance(initial, Mapping)  # {} is the model's own start
    if isinstance(initial, Mapping):
        begun, initial = initial_values(model.base, initial), "rest"
    parts = session_parts(
        model.base, beginning(dataset, initial), libraries=model.libraries, **model.refitted(),
        values={**model.values, **begun}, effects=effects, reference_hz=reference_of(dataset.responses()),
    )  # fmt: skip
    return replace(parts, rested=not is_given, begins={name: begins[name] for name in parts.free if name in begins})


def _asked(
    parts: SessionParts, work: Callable[..., Answer], progress: Progress, title: str, settings: Any = None
) -> Answer:
    """Run a step of the diagnosis and make its answer whole."""
    from pysim.simulate import one_blas_thread
    from pysim.workflow import session_of, whole_answer

    with showing(progress, title) as say, one_blas_thread():
        return whole_answer(work(session_of(parts, settings), progress=say), parts)


@dataclass(frozen=True, repr=False)
class Diagnosis(Shown):
    """The answer.

    Args:
        found: all numbers.
        begun: the model that was asked about.
        parts: with what it was asked.
    """

    found: Answer
    begun: Model
    parts: SessionParts

    @property
    def verdict(self) -> str:
        """Name of the first effect that is missing; "none", or "unknown"."""
        return self.found.verdict

    @property
    def sentence(self) -> str:
        """The verdict in words, with what it does to the error."""
        from pysim.present.diagnosis.words import verdict_sentence

        return verdict_sentence(self.found)

    @property
    def steps(self) -> Table:
        """The error, model by model: rms residual over noise on logs fitted, used to choose, and held out."""
        from pysim.present.diagnosis.words import step_name
        from pysim.present.notes import USES

        rows = [(step_name(one.step), one.fit, one.validate, one.test) for one in self.found.history]
        return Table.of(("model", *USES.values()), rows, key="model")

    @property
    def effects(self) -> Table:
        """Parameters of the effects that were found: value and 95 percent interval."""
        from pysim.present.diagnosis.words import sizes

        rows = [
            (one.effect.name, name, value, *ends, "" if unit == "1" else unit, one.share)
            for one in self.found.effects
            for name, value, ends, unit in sizes(one)
        ]
        return Table.of(("effect", "parameter", "value", "95 % from", "to", "unit", "share"), rows)

    @property
    def candidates(self) -> Table:
        """What was compared, best first: share of the avoidable misfit, gain less penalty (nats), and how far tried."""
        from pysim.present.diagnosis.words import candidates_shown

        rows = [
            (" + ".join(one.effects), one.explained, one.score, "refitted" if one.refitted else "screened")
            for one in candidates_shown(self.found)
        ]
        return Table.of(("effects", "explains", "gain less penalty", "how"), rows)

    @property
    def missing(self) -> tuple[Law, ...]:
        """Laws that no catalogue has, learned where effects do not explain the measurements; likeliest place first."""
        return laws_of(self.found, self.begun)

    @property
    def model(self) -> Model:
        """The model with what was found, refitted; it simulates the logs as the diagnosis began them."""
        effects = [one for one in self.found.effects if one.effect.class_name]
        laws = {law.slot: law for law in self.missing[: len(self.found.learned)] if law.found.modelica}
        grown = self.begun.with_effects(*(one.effect.name for one in effects if one.effect.slot not in laws))
        for slot, law in laws.items():
            inner = [one.effect for one in effects if one.effect.slot == slot]  # become part of the law's class
            grown = grown.with_effects(law.to_effect(f"learned.{slot}", inner=inner))
        values = {e.name: e.value for e in self.found.estimates if "@" not in e.name}
        for one in effects:
            slot, place = one.effect.slot, one.place
            part = place.removeprefix(slot)  # of a pair, ".first"
            ahead = f"{grown.places[f'learned.{slot}']}{part}" if slot in laws else grown.places[one.effect.name]
            values = {name: value for name, value in values.items() if not name.startswith(f"{place}.")} | {
                f"{ahead}.{p.name}": e.value for p, e in zip(one.effect.parameters, one.estimates, strict=True)
            }
        known = {v.name for v in grown.compiled.variables}
        return replace(grown, values={**grown.values, **{n: v for n, v in values.items() if n in known}})

    def where(self) -> Where:
        """Where the model fails before anything was added, the worst region first."""
        return Where(self.found.failures)

    def summary(self) -> str:
        """All of it as text."""
        from pysim.present.diagnosis import text, whole

        return text(whole(self.found))

    def plot(self, *, interactive: bool = False) -> Any:
        """The error, step by step; a Plotly figure where `interactive`."""
        from pysim.present.charts import as_plotly
        from pysim.present.diagnosis.figures.error import error_chart, error_figure

        history = self.found.history
        return as_plotly(error_chart(history)) if interactive else error_figure(history)

    def report(self, folder: Path | str) -> dict[str, Path]:
        """Write report.html with its pictures, the fitted values, and class and FMU where effects were added."""
        from pysim.present import write_report
        from pysim.present.diagnosis import answered
        from pysim.present.report import joining
        from pysim.workflow import write_extended

        place = path_of(folder, "folder")
        with joining(place) as new:
            files = write_extended(self.found, self.parts, new)
            beside = {name: path.name for name, path in files.items()}
            result = answered("diagnose", self.found, self.parts.dataset, self.parts.model_name, beside)
            files = write_report(new, result) | files
        return {name: place / path.name for name, path in files.items()}

    @property
    def table(self) -> Table:
        """The steps."""
        return self.steps

    @property
    def _words(self) -> list[str]:
        from pysim.present.diagnosis.words import verdict_words

        sentence = self.sentence if len(self.sentence) < 700 else f"{self.sentence[:697]}..."
        return [f"Verdict: {verdict_words(self.found)}", *textwrap.wrap(sentence, 100)]

    @property
    def _tables(self) -> tuple[Table, ...]:
        return self.steps, self.effects, self.candidates
