"""A model fitted to measurements, with how well its parameters are known and when not to trust them."""

from __future__ import annotations

import json
import math
import shutil
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pysim.nouns.common import Measured, dataset_of, libraries_of
from pysim.nouns.model import Model, model_given
from pysim.nouns.run import Run
from pysim.nouns.table import Shown, Table
from pysim.present.progress import Progress, showing
from pysim.types import BadInput, Dataset, FitOutcome, ProgressEvent
from pysim.types import Fit as Found
from pysim.types.kinds import names_of, path_of, whole_number_of

if TYPE_CHECKING:
    from pysim.identify.greybox import Problem, Profile, Tried
    from pysim.workflow import Initial

_CLOSE = 0.9  # correlation from which on a pair is printed
_SAID = ("values", "chosen", "bounds", "priors", "held", "label")  # of a model, that is saved with its fit
_KEPT, _FMU, _DATA = "fit.json", "model.fmu", "data"  # of a fit that is saved


def fit(
    model: Model,
    data: Measured,
    *,
    initial: Initial = None,
    starts: int = 0,
    seed: int = 0,
    outputs: Sequence[str] = (),
    folder: Path | str | None = None,
    progress: Progress = None,
) -> Fit:
    """Fit the free parameters of a model to the logs whose use is "fit"; the others are compared alone.

    Args:
        model: its `free_names` are changed, from their values on.
        data: what `pysim.load` gives.
        initial: of the model at each log's first sample: "rest", "estimate" from the log, or state -> value; None at
            states that were set, else as an earlier fit of the model had it, else as the data say, and near rest where
            they say nothing. It holds for logs that are not fitted too.
        starts: more searches, from starts drawn between the bounds.
        seed: of the draw.
        outputs: columns to compare; all that are measured by default.
        folder: keeps the search, so that one that was stopped goes on from there.
        progress: see `pysim.present.progress.showing`.
    Raises:
        BadInput: nothing free, what does not fit together, or a model that cannot be simulated.
    """
    from pysim.identify.greybox import Effort, of_outputs
    from pysim.workflow import fitted

    model, dataset, outputs = model_given(model, "fit"), dataset_of(data), names_of(outputs, "outputs")
    dataset = of_outputs(dataset, outputs)
    initial = model.first_sample(initial)
    problem = _problem(model, dataset, initial)
    drawn = whole_number_of(seed, "seed")
    if drawn < 0:
        raise BadInput(f"fit: the seed {drawn} is negative; give 0 or more", argument="seed")
    log = None if folder is None else path_of(folder, "folder")
    if log is not None and log.is_file():
        raise BadInput(f"fit: {log} is a file; name a folder that keeps the search", argument="folder")
    with showing(progress, f"fitting {model.name}") as say:

        def heard(tried: Tried) -> None:
            say(ProgressEvent(f"{tried.search}: point {tried.tried}, cost {tried.best:.6g}"))

        effort = Effort(whole_number_of(starts, "starts"), drawn, log=log, resume=log is not None)
        return Fit(fitted(problem, effort=effort, progress=heard), model, dataset, problem, initial, outputs)


def _problem(model: Model, dataset: Dataset, initial: Initial) -> Problem:
    from pysim.workflow import fit_problem, reference_of

    if not model.free_names:
        raise BadInput(f"fit: no parameter of {model.name} is free; name some: model.free('m', d=(20, 60))")
    return fit_problem(
        model.compiled, [dataset], **model.refitted(), values=model.values, starts=model.usual(),
        reference_hz=reference_of(dataset.responses()), initial=initial,
    )  # fmt: skip


@dataclass(frozen=True, repr=False)
class Fit(Shown):
    """A fitted model. Read `warnings` first: `ok` says that there are none.

    Args:
        found: all numbers.
        begun: the model as it was before.
        dataset: the measurements.
        problem: what was fitted, for profiles.
        initial, outputs: as asked for.
    """

    found: Found
    begun: Model
    dataset: Dataset
    problem: Problem
    initial: Initial = None
    outputs: tuple[str, ...] = ()

    @property
    def values(self) -> Mapping[str, float]:
        """Parameter -> estimate, in its unit."""
        return {one.name: one.value for one in self.found.estimates}

    @property
    def intervals(self) -> Mapping[str, tuple[float, float]]:
        """Parameter, and state at the first sample of a log, -> ends of its 95 percent interval, in its unit."""
        return {one.name: one.interval for one in (*self.found.estimates, *self.found.initial)}

    @property
    def table(self) -> Table:
        """A row per parameter: value, standard deviation, 95 percent interval, unit, start, bounds.

        Below them the states "x@run1.csv" at the first sample of logs whose initial states were estimated.
        """
        rows = [
            (e.name, e.value, e.std, *e.interval, "" if e.unit == "1" else e.unit, e.start,
             *(end if math.isfinite(end) else None for end in (e.lower, e.upper)),
             "AT BOUND" if e.at else "" if e.determined else "not determined")
            for e in (*self.found.estimates, *self.found.initial)
        ]  # fmt: skip
        head = ("parameter", "value", "s.d.", "95 % from", "to", "unit", "start", "lower", "upper", "remark")
        return Table.of(head, rows, key="parameter")

    @property
    def correlation(self) -> Table:
        """Correlations of the estimates."""
        names = [one.name for one in self.found.estimates]
        rows = [(name, *row) for name, row in zip(names, self.found.correlation.tolist(), strict=True)]
        return Table.of(("parameter", *names), rows, key="parameter")

    @property
    def warnings(self) -> tuple[str, ...]:
        """Why not to trust it, in sentences; none where nothing speaks against it."""
        from pysim.identify.greybox import fit_warnings
        from pysim.present.notes import sentences

        return tuple(sentences(fit_warnings(self.found)))

    @property
    def _alarms(self) -> tuple[str, ...]:
        return self.warnings

    @property
    def ok(self) -> bool:
        """Whether nothing speaks against it."""
        return not self.warnings

    @property
    def notes(self) -> tuple[str, ...]:
        """What was assumed, in sentences."""
        from pysim.present.notes import words

        return tuple(words(note) for note in self.found.notes)

    @property
    def model(self) -> Model:
        """The model at the estimates, which simulates the logs as they are shown here; it stays as free as it was."""
        values = {name: value for name, value in self.found.values.items() if "@" not in name}
        fitted = replace(self.begun, values={**self.begun.values, **values}, label=f"{self.begun.shown} fitted")
        return replace(fitted, measured=self.dataset, initial=self.initial)

    @property
    def residuals(self) -> Mapping[str, Run]:
        """Log -> measured minus simulated, in standard deviations of the noise."""
        return {one.source: Run(one.residual, f"residual of {one.source}") for one in self.found.records}

    @property
    def signals(self) -> Table:
        """A row per log and signal: use, fit percent, rms in the signal's unit, and over the noise."""
        from pysim.nouns.comparison import Comparison

        return Comparison({self.begun.name: self.found.records}, self.dataset).table

    def profile(self, name: str) -> Profile:
        """The exact 95 percent interval of a parameter, with the cost along it; takes as long as the fit."""
        from pysim.identify.greybox import profile

        return profile(self.problem, self.found, name)

    def summary(self) -> str:
        """All of it as text."""
        from pysim.present.fit import text

        return text(self._whole())

    def plot(self, what: str = "log", log: str = "", *, interactive: bool = False) -> Any:
        """Draw the fit.

        Args:
            what: "log" (measured and fitted, and what is left), "parameters" (between their bounds), "correlation".
            log: its name; the one with the largest residual by default.
            interactive: a Plotly figure in place of Matplotlib's.
        """
        from pysim.nouns.comparison import Comparison
        from pysim.present.charts import as_plotly
        from pysim.present.fit.figures import fit_correlation_chart, fit_correlation_figure, fit_parameters_figure
        from pysim.present.parameters import parameters_chart

        if what == "log":
            records = self.found.records
            if not log and records:
                records = (max(records, key=lambda one: max(one.rms.values())),)
            return Comparison({"fitted": records}, self.dataset).plot(log, interactive=interactive)
        if what not in ("parameters", "correlation"):
            raise BadInput(f'plot: {what!r} is not known; write "log", "parameters" or "correlation"')
        if not interactive:
            return (fit_parameters_figure if what == "parameters" else fit_correlation_figure)(self.found)
        if what == "correlation":
            found = fit_correlation_chart([*self.values], self.found.correlation.tolist())
        else:
            bounded = [e for e in self.found.estimates if math.isfinite(e.lower) and math.isfinite(e.upper)]
            found = parameters_chart([
                {"name": e.name, "lower": e.lower, "upper": e.upper, "after": (e.value, *e.interval)} for e in bounded
            ])  # fmt: skip
        return as_plotly(found)

    def save(self, folder: Path | str) -> Path:
        """Keep the fit: measurements, FMU, what was asked and what was found. `Fit.load(folder)` gives it back.

        Args:
            folder: a new or empty one.
        Returns:
            the path of its fit.json.
        """
        from pysim.io import write_dataset, write_file
        from pysim.nouns.data import as_text
        from pysim.present.report import joining

        place, begun = path_of(folder, "folder"), self.begun
        asked = {
            **{name: getattr(begun, name) for name in _SAID},
            "libraries": [str(one) for one in begun.libraries],
            "effects": [one.name for one in begun.effects_in],
            "initial": self.initial,
            "outputs": self.outputs,
            "found": self.values,
            "tolerance": self.found.tolerance,
            "outcome": self.found.outcome.value,
            "search": {name: getattr(self.found, name) for name in ("message", "iterations", "start_cost")},
        }
        plain = json.dumps(asked, indent=1, default=lambda one: {**one} if isinstance(one, Mapping) else sorted(one))
        if place.is_dir() and any(place.iterdir()):
            raise BadInput(f"{place} holds files already; name a new folder", argument="folder")
        with joining(place) as new:
            write_dataset(new / _DATA, as_text(self.dataset), exact=True)
            shutil.copyfile(begun.base.path, new / _FMU)
            write_file(new / _KEPT, plain)
        return place / _KEPT

    @classmethod
    def load(cls, folder: Path | str) -> Fit:
        """A fit that was saved. The model is simulated once more at what was found, which gives all the rest.

        Raises:
            BadInput: no fit was saved there, it is damaged, or a library of its model is not there any more.
        """
        from pysim.identify.greybox import Simulation, fit_at
        from pysim.io import read_model

        place = Path(folder)
        if not (place / _KEPT).is_file():
            raise BadInput(f"{place} holds no {_KEPT}; name the folder that fit.save(...) wrote")
        asked = _asked(place / _KEPT)
        plain = Model(read_model(place / _FMU), libraries_of(asked["libraries"]))
        grown = plain.with_effects(*asked["effects"]) if asked["effects"] else plain
        begun = replace(grown, **{name: asked[name] for name in _SAID})
        dataset, initial, outputs = dataset_of(place / _DATA), asked["initial"], asked["outputs"]
        problem = _problem(begun, dataset, initial)
        for name in problem.space.keys:
            if name not in asked["found"]:
                raise _damaged(place / _KEPT, f"found has no {name}")
        found = fit_at(problem, asked["found"], Simulation().as_fine_as(asked["tolerance"]))
        found = replace(found, outcome=asked["outcome"], **asked["search"])
        return cls(found, begun, dataset, problem, initial, outputs)

    def report(self, folder: Path | str) -> dict[str, Path]:
        """Write report.html, its pictures and parameters.toml; name -> path."""
        from pysim.present import write_report
        from pysim.present.report import joining

        place = path_of(folder, "folder")
        with joining(place) as new:
            files = write_report(new, self._whole(), redo=self._again(place))
        return {name: place / path.name for name, path in files.items()}

    def _again(self, folder: Path) -> str:
        """The lines that make the report again; none where starts were drawn, whose seed is not kept."""
        if {one.name for one in self.found.starts} not in ({"given"}, {"given", "nominal"}):
            return ""
        initial = dict(self.initial) if isinstance(self.initial, Mapping) else self.initial
        asked = {"initial": initial, "outputs": list(self.outputs)}
        words = ", ".join(["model", "data", *(f"{name}={value!r}" for name, value in asked.items() if value)])
        return (
            f"# model is {self.begun.name} with the starts, bounds and values above; data is {self.dataset.name}\n"
            f"fitted = pysim.fit({words})\nfitted.report({str(folder)!r})"
        )

    def _whole(self) -> Any:
        from pysim.present.fit import Fitted

        return Fitted(self.found, (self.dataset,))

    @property
    def _words(self) -> list[str]:
        one = self.found
        return [f"{self.begun.name} fitted to {self.dataset.name}: {one.outcome.value}, {one.iterations} points tried"]

    @property
    def _tables(self) -> tuple[Table, ...]:
        return (self.table.of_columns("parameter", "value", "95 % from", "to", "unit", "start", "remark"),)

    @property
    def _more(self) -> list[str]:
        """Fit of each signal over all logs, and correlations."""
        from pysim.io import shown_value
        from pysim.present.diagnosis.words import signal_rows

        lines = []
        for name, use, noise, percent, away, unit in signal_rows(self.found.records):
            fit = "never moves" if math.isnan(percent) else f"fit {percent:.2f} %"
            lines.append(f"{name} ({use}): {fit}, rms {shown_value(away, unit, '.3g')}, {noise:.3g} x noise")
        names, matrix = [one.name for one in self.found.estimates], self.found.correlation
        pairs = [
            f"{names[i]} and {names[j]} {matrix[i, j]:.2f}"
            for i in range(len(names)) for j in range(i) if abs(matrix[i, j]) > _CLOSE
        ]  # fmt: skip
        return [*lines, *([f"correlations above {_CLOSE}: {', '.join(pairs[:4])}"] if pairs else [])]


def _text(given: Any) -> str:
    if not isinstance(given, str):
        raise TypeError
    return given


def _texts(given: Any) -> tuple[str, ...]:
    if not isinstance(given, list):
        raise TypeError
    return tuple(map(_text, given))


def _numbers(given: Any) -> dict[str, float]:
    return {name: float(one) for name, one in given.items()}


def _pairs(given: Any) -> dict[str, tuple[float, float]]:
    return {name: (float(low), float(high)) for name, (low, high) in given.items()}


_SAVED: Mapping[str, Callable[[Any], Any]] = {  # what a saved fit holds, each taken as its kind
    "values": _numbers, "chosen": _texts, "bounds": _pairs, "priors": _pairs, "held": _texts, "label": _text,
    "libraries": _texts, "effects": _texts, "outputs": _texts, "found": _numbers, "tolerance": float,
    "initial": lambda one: one if one is None or isinstance(one, str) else _numbers(one), "outcome": FitOutcome,
    "search": lambda one: {name: kind(one[name]) for name, kind in _SEARCH.items()},
}  # fmt: skip
_SEARCH: Mapping[str, Callable[[Any], Any]] = {"message": _text, "iterations": int, "start_cost": float}


def _asked(file: Path) -> dict[str, Any]:
    """What stands in the file of a saved fit.

    Raises:
        BadInput: it cannot be read, or is damaged.
    """
    from pysim.io import read_text

    text, asked, key = read_text(file, "a saved fit"), dict[str, Any](), ""
    try:
        said = json.loads(text)
        for key, kind in _SAVED.items():
            asked[key] = kind(said[key])
    except (AttributeError, KeyError, TypeError, ValueError, RecursionError) as error:
        raise _damaged(file, f"{key} is missing or wrong" if key else str(error)) from error
    return asked


def _damaged(file: Path, why: str) -> BadInput:
    return BadInput(f"{file} is damaged ({why}); fit again, and save that in a new folder")
