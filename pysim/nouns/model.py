"""A model: what it holds, what of it is set or refitted, and how it runs."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from pysim.io.named_columns import optional_package
from pysim.io.prepare import logs_called
from pysim.nouns.common import Input, Measured, dataset_of, libraries_of, signal_of
from pysim.nouns.run import Run
from pysim.nouns.table import EXTRA, Shown, Table
from pysim.types import (
    BadInput,
    Dataset,
    Effect,
    Experiment,
    MeasuredRecord,
    MeasuredSignal,
    Note,
    Record,
    RecordFit,
    Signal,
    Variable,
    rows_every,
)
from pysim.types import Model as Compiled
from pysim.types._frozen import FrozenMapping
from pysim.types.kinds import names_of, number_of, path_of

if TYPE_CHECKING:
    from pysim.effects import Slot
    from pysim.identify.greybox import Problem
    from pysim.workflow import Initial, ModelInside, Variants

_ROWS = 500  # of a run, where nothing says how many
_STEPS = 200  # of a slider
_FINE = 0.01  # of the tolerance that a search has
_OPENED = 20  # models whose slots are known by their names alone
_LISTED = 12  # names on one line of what is printed

opened: list[Model] = []  # in this process, the last one behind; a slot's name alone means one of theirs


class OwnEffect(Protocol):
    """An effect of the user's own, with the file that holds its class."""

    @property
    def name(self) -> str:
        """Its standard name."""
        ...

    @property
    def file(self) -> Path:
        """That holds its class."""
        ...


def model(name: Path | str | Compiled, *, library: Path | str | Sequence[Path | str] = ()) -> Model:
    """Open a model: a class of a library, a .mo file, or an FMU of any tool.

    Args:
        name: full name of a Modelica class, a .mo file with one model, or an .fmu.
        library: with the class or with effects, folders with a package.mo or .mo files; ours is always there.
    Raises:
        BadInput: what cannot be read or does not compile; says where.
    """
    from pysim.workflow import class_in, model_of

    places = libraries_of(library)
    if isinstance(name, Compiled):
        return _opened(Model(name, places))
    text = str(path_of(name, "name"))
    if text.lower().endswith(".mo"):
        file = Path(text).absolute()
        if not file.is_file():
            raise BadInput(f"model {text}: there is no such file; name a .mo file, an .fmu or a class", argument="name")
        return _opened(Model(model_of(class_in(file), [*places, file]), (*places, file)))
    return _opened(Model(model_of(text, places), places))


def model_given(given: Any, verb: str, argument: str = "model") -> Model:
    """The model that a verb was given."""
    if isinstance(given, Model):
        return given
    raise BadInput(
        f"{verb}: a {type(given).__name__} is no model; give what pysim.model(...) returns, and the data behind it",
        argument=argument,
    )


def _opened(one: Model) -> Model:
    opened.append(one)
    del opened[:-_OPENED]
    return one


@dataclass(frozen=True, repr=False)
class Model(Shown):
    """A model with what the user said of it. Nothing changes it: each method gives another one.

    Args:
        base: as it was compiled, without effects.
        libraries: of the user.
        values: parameters that differ from the model's own, in their units.
        chosen: parameters to refit; where none is named, all to which the model gives min, max and nominal.
        bounds: parameter -> lower and upper bound, in place of the model's.
        priors: parameter -> mean and standard deviation of what is known of it beforehand.
        held: parameters that are not refitted.
        effects_in: that were added.
        candidates: effects of the user's own that a diagnosis considers too.
        label: what a comparison calls it; the last words of its name where empty.
        measured: what it was fitted to; the runs of these logs begin where the fit had them begin.
        initial: what that fit knew of the first samples.
    """

    base: Compiled
    libraries: tuple[Path, ...] = ()
    values: Mapping[str, float] = field(default_factory=dict)
    chosen: tuple[str, ...] = ()
    bounds: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    priors: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    held: frozenset[str] = frozenset()
    effects_in: tuple[Effect, ...] = ()
    candidates: tuple[Effect, ...] = ()
    label: str = ""
    measured: Dataset | None = field(default=None, compare=False)
    initial: Initial = field(default=None, compare=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "values", FrozenMapping(self.values))
        for name in ("bounds", "priors"):
            pairs = {parameter: (low, high) for parameter, (low, high) in getattr(self, name).items()}
            object.__setattr__(self, name, FrozenMapping(pairs))
        object.__setattr__(self, "chosen", tuple(self.chosen))
        object.__setattr__(self, "held", frozenset(self.held))

    # --- what it is --------------------------------------------------------------------------------------------------

    @property
    def name(self) -> str:
        """The class, or the FMU's model, with the effects that were added."""
        return " + ".join([self.inside.class_name or self.base.name, *(effect.name for effect in self.effects_in)])

    @property
    def shown(self) -> str:
        """What a comparison calls it."""
        first = self.inside.class_name or self.base.name
        return self.label or " + ".join([first.rpartition(".")[2], *(effect.name for effect in self.effects_in)])

    @cached_property
    def inside(self) -> ModelInside:
        """What the libraries know of it."""
        from pysim.workflow import inside

        return inside(self.base, self.libraries)

    @cached_property
    def variants(self) -> Variants | None:
        """Builds it with effects; None where its class is in no library."""
        from pysim.workflow import Variants, with_standard

        known = self.inside.class_name
        return Variants(known, tuple(with_standard(self.libraries))) if known else None

    @cached_property
    def _built(self) -> tuple[Compiled, Mapping[str, str]]:
        if not self.effects_in:
            return self.base, {}
        assert self.variants is not None
        return self.variants.build(self.effects_in)

    @property
    def compiled(self) -> Compiled:
        """The FMU that runs, with the effects that were added."""
        return self._built[0]

    @property
    def places(self) -> Mapping[str, str]:
        """Effect that was added -> the name ahead of its parameters."""
        return self._built[1]

    @property
    def free_names(self) -> tuple[str, ...]:
        """Parameters that a fit may change."""
        from pysim.workflow import suggested

        names = self.chosen or suggested(self.compiled)
        return tuple(name for name in names if name not in self.held)

    @property
    def inputs(self) -> Table:
        """Name, unit, start value and description."""
        return self._variables("input")

    @property
    def outputs(self) -> Table:
        """Name, unit, start value and description."""
        return self._variables("output")

    @property
    def states(self) -> Table:
        """Name, unit, start value and description, in the order of the state vector."""
        model = self.compiled
        return _variable_table("states", (model[name] for name in model.abilities.states))

    @property
    def parameters(self) -> Table:
        """Name, value, min, max, unit, description, and whether a fit may change it."""
        free = set(self.free_names)
        rows = [
            (v.name, self.values.get(v.name, v.start), *self._bounds(v), _unit(v), v.description, v.name in free)
            for v in self.compiled.variables
            if v.causality == "parameter"
        ]  # fmt: skip
        return Table.of(("name", "value", "min", "max", "unit", "description", "free"), rows, key="name")

    @property
    def slots(self) -> Table:
        """Replaceable parts: what a missing term may depend on there, and what it gives."""
        rows = [(s.name, ", ".join(s.sees), ", ".join(s.gives), s.description) for s in self.inside.slots]
        return Table.of(("name", "sees", "gives", "description"), rows, key="name")

    @property
    def effects(self) -> Table:
        """Effects that the slots take."""
        own = (*self.inside.taken, *(one for one in self.candidates if one not in self.inside.taken))
        rows = [(e.name, e.slot, ", ".join(p.name for p in e.parameters), e.description) for e in own]
        return Table.of(("name", "slot", "parameters", "description"), rows, key="name")

    def slot(self, name: str) -> Slot:
        """The replaceable part of that name.

        Raises:
            BadInput: there is none; lists those there are.
        """
        for one in self.inside.slots:
            if one.name == name:
                return one
        raise BadInput(f"{self.name} has no slot {name!r}; its slots: {', '.join(self.slots['name']) or 'none'}")

    # --- what is said of it ------------------------------------------------------------------------------------------

    def set(self, **values: float) -> Model:
        """Give parameters a value, in their units; a fit leaves them there unless they are named as free.

        A state that is set is where runs begin, those of logs too unless `initial` says otherwise.

        Raises:
            BadInput: no such parameter, or a value outside its bounds: those that `free` gave, else the model's.
        """
        from pysim.simulate import check_override

        for name, value in values.items():
            check_override(self.compiled, name, value)
            low, high = self._bounds(self.compiled[name])
            if not (-np.inf if low is None else low) <= value <= (np.inf if high is None else high):
                unit = self.compiled[name].unit
                raise BadInput(
                    f"set: {name} = {value:g} is outside its bounds, {low} to {high} {unit}; correct the value, or the "
                    f"bounds ahead: model.free({name}=(lowest, highest))",
                    argument=name,
                )
        held = self.held | {name for name in values if name not in self.chosen}
        begins = any(name in values for name in self.compiled.abilities.states)  # elsewhere than its fit had it
        values = {**self.values, **{n: float(v) for n, v in values.items()}}
        return replace(self, values=values, held=held, initial=None if begins else self.initial)

    def free(
        self, *names: str, prior: Mapping[str, tuple[float, float]] | None = None, **bounds: tuple[float, float]
    ) -> Model:
        """Let a fit change these parameters and no others, those of an earlier call besides.

        Args:
            names: with the model's own bounds.
            prior: parameter -> (mean, standard deviation) of what is known of it beforehand, in its unit; it counts as
                one more measurement. It frees the parameter too.
            bounds: parameter = (lowest, highest), in its unit.
        Raises:
            BadInput: nothing named, no such parameter, or bounds that are not two increasing numbers around its value.
        """
        prior = prior or {}
        names = (*names_of(names, "free"), *prior)
        if not (names or bounds):
            own = ", ".join(map(repr, self.free_names[:3])) or "'m'"
            raise BadInput(f"free: nothing is named; name what a fit may change: model.free({own})", argument="names")
        for name in (*names, *bounds):
            self._settable(name)
        checked = {}
        for name, pair in bounds.items():
            checked[name] = low, high = _pair(name, pair, "range", "lowest, highest")
            if not low < high:
                raise BadInput(
                    f"free: {name} = {pair!r} does not increase; write {name}=(lowest, highest)", argument=name
                )
        prior = {name: _pair(name, pair, "prior", "mean, standard deviation") for name, pair in prior.items()}
        chosen = tuple(dict.fromkeys([*self.chosen, *names, *bounds]))
        grown = replace(self, bounds={**self.bounds, **checked}, priors={**self.priors, **prior})
        grown = replace(grown, chosen=chosen, held=self.held - {*names, *bounds})
        for name, ends in checked.items():
            self._refuse_outside(name, ends, grown.values.get(name, grown.usual().get(name, self.compiled[name].start)))
        return grown

    def _refuse_outside(self, name: str, ends: tuple[float, float], value: float | None) -> None:
        """Say how a value comes inside new bounds: at once if the old ones let it, else over bounds that hold both."""
        if value is None or ends[0] <= value <= ends[1]:
            return
        least, most = self._bounds(self.compiled[name])
        low = ends[0] if least is None else max(ends[0], least)
        high = ends[1] if most is None else min(ends[1], most)
        way = "" if low <= high else f".free(**{{'{name}': ({min(ends[0], value):g}, {max(ends[1], value):g})}})"
        inside = sum(ends if way else (low, high)) / 2
        cure = f"model{way}.set(**{{'{name}': {inside:g}}}).free(**{{'{name}': ({ends[0]:g}, {ends[1]:g})}})"
        raise BadInput(
            f"free: {name} = {value:g} is outside {ends[0]:g} to {ends[1]:g} {self.compiled[name].unit}; set a value "
            f"inside, too: {cure}",
            argument=name,
        )

    def fix(self, *names: str, **values: float) -> Model:
        """Let a fit leave these parameters where they are, or at these values."""
        from pysim.workflow import suggested

        names = names_of(names, "fix")
        for name in names:
            self._settable(name)
        gone = {*names, *values}
        chosen = tuple(name for name in self.chosen if name not in gone)
        bounds = {name: pair for name, pair in self.bounds.items() if name not in gone}
        held = self.held | gone
        if self.chosen and not chosen:  # nothing is left, which is not the same as nothing chosen
            held |= set(suggested(self.compiled))
        return replace(self, chosen=chosen, bounds=bounds, held=held).set(**values)

    def with_effects(self, *effects: str | OwnEffect) -> Model:
        """Add effects of the catalogue by their names, or effects of your own.

        Their parameters become free, but for the curve of a law that was learned: that has its values already. Values
        of an FMU that its class does not have stay.

        Raises:
            BadInput: the model's class is not at hand or cannot be what its FMU is, no slot takes the effect, or it is
                there already.
        """
        if not effects:
            return self
        from pysim.workflow.built_in import built_in

        wider, found = self._taking(effects)
        names = [one.name for one in (*self.effects_in, *found)]
        for name in names:
            if names.count(name) > 1:
                raise BadInput(f"effect {name}: named twice, or there already; name each effect once")
        values = {**built_in(self.base, wider.libraries), **self.values}
        grown = replace(wider, effects_in=(*self.effects_in, *found), values=values, label="")
        strengths = [(e, p) for e in found for p in e.strengths if p.default != p.off]
        curve = {f"{grown.places[e.name]}.{p.name}" for e, p in strengths if p.name.endswith("]")}
        grown = replace(grown, held=grown.held | curve)
        if self.chosen:
            more = [f"{grown.places[e.name]}.{p.name}" for e in found for p in e.parameters]
            grown = replace(grown, chosen=(*self.chosen, *more))
        return grown

    def with_candidates(self, *effects: OwnEffect) -> Model:
        """Let a diagnosis consider effects of your own beside those of the catalogue."""
        wider, found = self._taking(effects)
        return replace(wider, candidates=tuple(dict.fromkeys([*self.candidates, *found])))

    def refitted(self) -> dict[str, Any]:
        """What a fit may change, with the bounds and the prior knowledge that were given."""
        free = self.free_names
        own = {"bounds": self.bounds, "priors": self.priors}
        return {"free": free, **{k: {n: pair for n, pair in v.items() if n in free} for k, v in own.items()}}

    def first_sample(self, initial: Initial) -> Initial:
        """What is known of it in each log: as given, else as its fit had it, else its own start once a state is set."""
        given = self.initial if initial is None else initial
        is_set = any(name in self.values for name in self.compiled.abilities.states)
        return {} if given is None and is_set else given

    def usual(self) -> dict[str, float]:
        """Where a fit begins with the effects that were added: at usual sizes, as off may be no start."""
        found = {}
        for effect in self.effects_in:
            for parameter in effect.strengths:
                name = f"{self.places[effect.name]}.{parameter.name}"
                if name in self.free_names and name not in self.values and parameter.default == parameter.off:
                    found[name] = float(min(max(parameter.nominal, parameter.min), parameter.max))
        return found

    # --- what it does ------------------------------------------------------------------------------------------------

    def simulate(
        self,
        what: float | MeasuredRecord | None = None,
        /,
        *,
        dt: float | None = None,
        record: Sequence[str] = (),
        check: bool = True,
        initial: Initial = None,
        **inputs: Input,
    ) -> Run:
        """Run it.

        The run of a log begins where `fit` and `compare` have it begin, so that its curve is the one they show: a log
        that the model was fitted to at the states of that fit, any other at states that are estimated from what it
        measures, at rest or near it where the data say so. The model's own start values hold where a state was set,
        where a log measures nothing that the model gives, where `inputs` are given beside it, and without a log.

        Args:
            what: end of the run in s, the FMU's own or 1 s by default; or a log, `data["run3"]`, whose columns that are
                named like inputs drive them, over the log's time.
            dt: s between two rows, less before the last; a 500th of the run by default, and of a log its own.
            record: variables; all outputs by default, else the states.
            check: False gives back what a run that failed has reached, in place of an error.
            initial: state -> value, `{}` for the model's own start; of a log also "rest" or "estimate"; None as above.
            inputs: input = number, pairs (s, value), a row of values, a pandas column, or a function of time.
        Raises:
            BadInput: an unknown name, or an input that is no signal.
            SimulationError: the run stopped early.
        """
        from pysim.simulate import Rodas, simulate
        from pysim.workflow import recorded_of
        from pysim.workflow.fitting import refuse_unknown

        model, names = self.compiled, recorded_of(self.compiled, names_of(record, "record"))
        drives: dict[str, Signal] = {}
        if isinstance(what, MeasuredRecord):
            dt = None if dt is None else number_of(dt, "dt")
            if not (dt is None or dt > 0):
                raise BadInput(f"simulate: there are no rows every {dt:g} s; give a time above zero", argument="dt")
            refuse_unknown(initial)
            begun = None if inputs else self._begun(what, self.first_sample(initial))
            if begun is not None:
                assert isinstance(what.data, Record)
                whole, first = begun
                later = first - float(what.data.time[0])  # on the clock of all logs
                times = np.maximum(_times(what.data, dt) + later, whole.start)
                found = simulate(model, replace(whole, times=times, record=names), solver=Rodas(), check=check)
                return Run(replace(found, time=found.time - later), self.name)
            times, start, drives = self._log(what, dt)
        else:
            if what is not None and not isinstance(what, int | float | np.number):
                raise BadInput(
                    f"simulate: a {type(what).__name__} is neither a time in s nor one log; write simulate(2.0), or "
                    'simulate(data["run3"])', argument="what",
                )  # fmt: skip
            if isinstance(initial, str):
                raise BadInput(
                    f"simulate: no log is there to begin at {initial!r}; write state = value", argument="initial"
                )
            stop = float(what if what is not None else model.stop_time or 1.0)
            dt = None if dt is None else number_of(dt, "dt")
            if not 0 < stop < np.inf or not 0 < (dt or stop) <= stop:
                raise BadInput(
                    f"simulate: the run ends at {stop:g} s in steps of {dt} s; give times above zero", argument="what"
                )
            times, start = rows_every(dt or stop / _ROWS, 0.0, stop), 0.0
        for name, value in inputs.items():
            drives[model[name].name] = signal_of(value, float(times[-1]), name)
        values = self.set(**initial).values if isinstance(initial, Mapping) else self.values
        experiment = Experiment(times, names, drives, values, start, rates=model.rate_inputs(drives))
        return Run(simulate(model, experiment, solver=Rodas(), check=check), self.name)

    def _begun(self, log: MeasuredRecord, initial: Initial) -> tuple[Experiment, float] | None:
        """The run of a log as `compare` has it, and its time at the log's first sample; None where nothing of the model
        was measured."""
        from pysim.identify.greybox import Simulation
        from pysim.identify.greybox.comparison import compared

        dataset = self._holding(log)
        if dataset is None or initial == {}:
            return None
        problem, here = self._problem(dataset, initial), np.zeros(0)
        for one in problem.observations:
            for run in one.runs:
                if run.record == log.source:
                    found = compared(replace(problem, observations=(one,)), here, Simulation().finer(_FINE))
                    offset = None if run.orbit else found.states.get(id(run))
                    return run.over_time(problem.space.overrides(here, run.record), offset), run.begins
        return None

    def _holding(self, log: MeasuredRecord) -> Dataset | None:
        """The data set that the log is of, or one of it alone; None where only its inputs are in the model."""
        data = log.data
        if not isinstance(data, Record):
            return None
        for one in self.measured.logs() if self.measured else ():
            assert isinstance(one.data, Record)
            if one.source == log.source and set(one.data.names) <= set(data.names):
                values = data.values[:, [data.names.index(name) for name in one.data.names]]
                if np.array_equal(one.data.values, values, equal_nan=True):
                    return self.measured
        own = {v.name: v for v in self.compiled.variables}
        columns = [(name, unit) for name, unit in zip(data.names, data.units, strict=True) if name in own]
        roles = {name: "input" if own[name].causality == "input" else "output" for name, _ in columns}
        if set(roles.values()) != {"input", "output"}:
            return None
        signals = tuple(MeasuredSignal(name, roles[name], unit, name, name) for name, unit in columns)
        kept = replace(log, use="fit", data=replace(
            data, names=tuple(roles), units=tuple(unit for _, unit in columns),
            values=data.values[:, [data.names.index(name) for name in roles]],
        ))  # fmt: skip
        return Dataset(log.source, "", self.name, signals, (kept,))

    def beside(self, dataset: Dataset, initial: Initial = None) -> tuple[tuple[RecordFit, ...], tuple[Note, ...]]:
        """Every log beside the model as it is, with the use that the data set says; and what was assumed."""
        from pysim.identify.greybox import Simulation
        from pysim.identify.greybox.comparison import compared

        uses, problem = [record.use for record in dataset.logs()], self._problem(dataset, initial)
        found = compared(problem, np.zeros(0), Simulation().finer(_FINE))  # one run each: no error of it may count
        if not found.records and not found.responses:
            raise BadInput(
                f"{self.name} could not be simulated along any log; try model.simulate(data[...]) to see why"
            )
        records = (replace(record, use=uses[record.index]) for record in found.records)
        return tuple(records), (*problem.notes, *found.notes)

    def _problem(self, dataset: Dataset, initial: Initial) -> Problem:
        """The model as it is beside every log."""
        from pysim.workflow import fit_problem, reference_of

        all_fit = replace(dataset, records=tuple(replace(record, use="fit") for record in dataset.records))
        return fit_problem(
            self.compiled, [all_fit], values=self.values, nothing_free=True, initial=self.first_sample(initial),
            reference_hz=reference_of(dataset.responses()),
        )  # fmt: skip

    def explore(self, data: Measured, log: str = "") -> Any:
        """Sliders for what is free, in a notebook, and one log beside the model at what they say.

        Args:
            data: what `pysim.load` gives.
            log: its name; the first one by default.
        Raises:
            BadInput: no such log, nothing is free between two bounds, or ipywidgets is not installed.
        """
        from pysim.present.overlay import logs_figure

        dataset = dataset_of(data)
        one = replace(dataset, records=logs_called(dataset, log) if log else dataset.logs()[:1])
        widgets = optional_package("ipywidgets", "sliders need ipywidgets", EXTRA)
        rows = [row for row in self.table if row["lowest"] is not None and row["highest"] is not None]
        if not rows:
            raise BadInput(f"explore: nothing of {self.name} is free between bounds; write model.free('m', d=(20, 60))")
        sliders = {
            row["free"]: widgets.FloatSlider(
                value=row["value"], min=row["lowest"], max=row["highest"], description=row["free"],
                step=(row["highest"] - row["lowest"]) / _STEPS, readout_format=".4g", continuous_update=False,
            )
            for row in rows
        }  # fmt: skip

        def shown(**values: float) -> Any:
            records, _ = self.set(**values).beside(one)
            return logs_figure({self.shown: records[0]})

        return widgets.interactive(shown, {"auto_display": True}, **sliders)

    def export(self, folder: Path | str, *, fmi: int = 2, platforms: str | Sequence[str] = "host") -> dict[str, Path]:
        """Write the model with its values: class, FMU, and parameters.toml; name -> path.

        Args:
            fmi: version 2 or 3.
            platforms: that the FMU runs on; "host", or "all".
        """
        from pysim.workflow import export_model

        systems = names_of(platforms, "platforms")
        return export_model(
            self.base,
            self.variants,
            self.effects_in,
            self.values,
            path_of(folder, "folder"),
            fmi=fmi,
            platforms=systems,
        )

    def _log(self, log: MeasuredRecord, dt: float | None) -> tuple[Any, float, dict[str, Signal]]:
        """Times, start and inputs of a log."""
        from pysim.identify.logged import logged_command

        if not isinstance(log.data, Record):
            raise BadInput(f"simulate: {log.source} is a table over frequency; give a log over time")
        model, data = self.compiled, log.data
        wanted = {v.name: v for v in model.variables if v.causality == "input"}
        columns = [(name, unit) for name, unit in zip(data.names, data.units, strict=True) if name in wanted]
        if not columns:
            raise BadInput(
                f"simulate: no column of {log.source} is named like an input of {self.name}; it has "
                f"{', '.join(data.names)}, the inputs are {', '.join(wanted) or 'none'}: rename the column"
            )
        drives = {}
        for name, unit in columns:
            scale = model.scale(wanted[name], unit)
            if scale is None:
                raise BadInput(f"simulate: {name} of {log.source} is in {unit}, the input in {wanted[name].unit}")
            drives[name] = logged_command(log, name).times(scale[0]).plus(Signal.constant(scale[1]))
        return _times(data, dt), float(data.time[0]), drives

    def _taking(self, effects: Iterable[str | OwnEffect]) -> tuple[Model, list[Effect]]:
        """The model whose libraries hold these effects, and the effects as its slots take them."""
        listed = [e for one in effects for e in (one if isinstance(one, list | tuple) else [one])]
        for one in listed:
            if not isinstance(one, str) and not hasattr(one, "file"):
                raise BadInput(
                    f"effects: a {type(one).__name__} is none; name one of the catalogue, or give one of pysim.effect"
                )
        files = [e.file for e in listed if not isinstance(e, str) and e.file not in self.libraries]
        wider = replace(self, libraries=(*self.libraries, *files)) if files else self
        if not wider.inside.class_name:
            raise BadInput(
                f"nothing can be added to {self.name}: its class is in no library; name it with library=",
                argument="library",
            )
        from pysim.workflow.session import named

        return wider, list(named([e if isinstance(e, str) else e.name for e in listed], wider.inside))

    def _bounds(self, v: Variable) -> tuple[float | None, float | None]:
        """Those that the user gave, else the model's."""
        return self.bounds.get(v.name, (v.min, v.max))

    def _settable(self, name: str) -> None:
        variable = self.compiled[name]
        if variable.causality != "parameter" and name not in self.compiled.abilities.states:
            names = [v.name for v in self.compiled.variables if v.causality == "parameter"]
            raise BadInput(f"{name} is no parameter of {self.name}, which computes or takes it; it has {_some(names)}")

    def _variables(self, causality: str) -> Table:
        return _variable_table(f"{causality}s", (v for v in self.compiled.variables if v.causality == causality))

    # --- how it looks ------------------------------------------------------------------------------------------------

    @property
    def table(self) -> Table:
        """What a fit may change: value and bounds."""
        own = [self.compiled[name] for name in self.free_names]
        rows = [(v.name, self.values.get(v.name, v.start), *self._bounds(v), _unit(v)) for v in own]
        return Table.of(("free", "value", "lowest", "highest", "unit"), rows, key="free")

    @property
    def _words(self) -> list[str]:
        model = self.compiled
        lines = [f"{self.name}: FMI {model.abilities.fmi}, {len(model.abilities.states)} states"]
        for causality in ("input", "output"):
            names = [f"{v.name} [{v.unit}]" for v in model.variables if v.causality == causality]
            lines.append(f"{causality}s: {_some(names)}")
        own = [name for name in self.values if name not in self.free_names]
        lines += [f"set: {_some([f'{name} = {self.values[name]:g}' for name in own])}"] if own else []
        takes = {slot.name: [e.name for e in self.inside.taken if e.slot == slot.name] for slot in self.inside.slots}
        if takes:
            lines.append(f"slots: {_some([f'{name} ({len(its)} effects)' for name, its in takes.items()])}")
        elif not self.inside.class_name:
            lines.append("slots: none, as its class is in no library")
        return lines

    def plot(self, *, interactive: bool = False) -> Any:
        """A sketch: inputs, outputs, what is free, and slots with the effects in them.

        Args:
            interactive: a Plotly figure in place of Matplotlib's.
        """
        from pysim.present.charts import as_plotly
        from pysim.present.model import model_chart, model_figure

        inputs, outputs = ([f"{v.name} [{v.unit}]" for v in self.compiled.variables if v.causality == causality]
                           for causality in ("input", "output"))  # fmt: skip
        free = [f"{row['free']} = {row['value']:.4g} {row['unit']}" for row in self.table]
        inside = [f"{len(self.compiled.abilities.states)} states", *(free[:_LISTED] or ["nothing is free"])]
        filled = {slot: [e.name for e in self.effects_in if e.slot == slot] for slot in self.slots["name"]}
        slots = ["\n".join([name, *(own or ["empty"])]) for name, own in filled.items()]
        if interactive:
            return as_plotly(model_chart(self.name, inputs, outputs, inside, slots))
        return model_figure(self.name, inputs, outputs, inside, slots)

    def to_dataframe(self) -> Any:
        """Its parameters, as a pandas DataFrame."""
        return self.parameters.to_dataframe()


def _times(data: Record, dt: float | None) -> Any:
    """Of the rows of a log's run, s."""
    return data.time if dt is None else rows_every(dt, float(data.time[0]), float(data.time[-1]))


def _pair(name: str, given: Any, what: str, words: str) -> tuple[float, float]:
    """Two numbers that are given for a parameter."""
    if isinstance(given, tuple | list) and len(given) == 2:
        return number_of(given[0], name), number_of(given[1], name)
    raise BadInput(f"free: {given!r} is no {what} of {name}; write {name}=({words})", argument=name)


def _some(texts: Sequence[str]) -> str:
    more = f" and {len(texts) - _LISTED} more" if len(texts) > _LISTED else ""
    return f"{', '.join(texts[:_LISTED]) or 'none'}{more}"


def _unit(v: Variable) -> str:
    return "" if v.unit == "1" else v.unit


def _variable_table(title: str, variables: Iterable[Variable]) -> Table:
    rows = [(v.name, _unit(v), v.start, v.description) for v in variables]
    return Table.of(("name", "unit", "start", "description"), rows, key="name", title=title)
