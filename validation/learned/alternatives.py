"""What else a user might do about three of the laws: `python -m validation.learned.alternatives [CASE ...]`.

Each way is told the model and the logs. Network and sparse regression are told the right place too; the curves are not.
A line gives the error on the wave that was not given, as in the table of the learned laws, and the time.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import combinations_with_replacement
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from numpy.typing import NDArray

from pysim.effects import Slot, law_class, read_catalogue, slots
from pysim.effects.law import Moment, read_law
from pysim.effects.learned import learned_class
from pysim.effects.learned.expression import replaced
from pysim.identify.greybox import Parameter, fit, problem
from pysim.identify.greybox.parameters import identifiable
from pysim.simulate import Rodas, simulate
from pysim.types import BadInput, Dataset, Effect, EffectParameter, Experiment, Fit, LearnedLaw, Model, Record, Signal
from pysim.types.factor import Factor
from pysim.workflow import Variants
from validation.asked import PUMP, Step
from validation.learned.answer import error
from validation.learned.cases import CASES, LearnedCase, Measured, measure

Array = NDArray[np.float64]

THREE = ("damping.position-large-1", "friction.position-large-1", "valve.notch-large-1")
_PLACES: Mapping[str, tuple[str, str, float, Mapping[str, str]]] = {
    "pistonForce": ("", "N", 100.0, {"x": "piston.x", "v": "piston.v"}),
    "spoolOpening": ("s + ", "1", 0.01, {"s": "spool.u"}),
}
"""Slot -> what its variable is without a law, unit and size of a disturbance, and the model's names of what it sees."""
_KNOTS = 9  # of a curve
_HIDDEN = 6  # neurons of the network, in one layer
_STARTS = 3  # of the network's weights, drawn at random
_SEED = 1
_RATE = 250.0  # Hz, of the logs
_PULSES = np.arange(3.0, 20.0, 0.85)  # s, times of the pulses whose mean answer is the response to a disturbance
_PULSE, _ANSWER = 0.02, 2.0  # s, width of a pulse, and how long its answer is recorded
_AHEAD = 25  # samples before a pulse, which has begun by then
_FAR = 1e3  # bound of an amount, over its size
_OPEN = 1e9  # bound of what nothing bounds
_HEAVY, _USUAL = 20.0, 3.0  # bound of a weight, and standard deviation of its prior
_SMALL = 0.1  # of the largest standardised term, below which the sparse regression drops a term


@dataclass(frozen=True)
class Tried:
    """What one way gives.

    Args:
        found: the law, or where it was put.
        error: root mean square on the wave not given, over the noise; None if the model cannot be simulated there.
    """

    case: str
    way: str
    found: str
    error: float | None
    seconds: float

    def __str__(self) -> str:
        size = "fails" if self.error is None else f"{self.error:.2f}"
        return f"{self.case}: {self.way}: {self.found}; error {size}; {self.seconds:.0f} s"


@dataclass(frozen=True)
class _Fitted:
    """A fitted model with one effect, or without."""

    fit: Fit
    model: Model
    values: Mapping[str, float]

    def error(self, measured: Measured) -> float | None:
        return error(Step("", self.model, self.values), measured.unseen)

    @property
    def chooses(self) -> float:
        """Mean square residual, over the noise, of the log that may choose."""
        rests = [(r.measured.values - r.simulated.values) / r.noise for r in self.fit.records if r.use == "validate"]
        return float(np.nanmean(np.concatenate([rest.ravel() for rest in rests]) ** 2))


@dataclass(frozen=True)
class _Place:
    """The right slot of a case, as network and sparse regression are told it.

    Args:
        own: what its variable is without the law, ahead of it; "" for nothing.
        unit, size: of a disturbance there.
        samples: variable of the slot -> (n,) along the fitted waves, of the model without a law.
        scales: variable -> its standard deviation and unit.
    """

    slot: Slot
    own: str
    unit: str
    size: float
    samples: Mapping[str, Array]
    scales: Mapping[str, tuple[float, str]]

    @classmethod
    def of(cls, case: LearnedCase, base: _Fitted, data: Dataset) -> _Place:
        (name, *_) = case.kind.places[0]
        own, unit, size, signals = _PLACES[name]
        seen = _seen(base, data, list(signals.values()))
        samples = {one: seen[full] for one, full in signals.items()}
        scales = {
            one: (float(f"{np.std(samples[one]):.3g}"), base.model[full].unit or "1") for one, full in signals.items()
        }
        return cls(_slots()[name], own, unit, size, samples, scales)

    @property
    def far(self) -> float:
        """Bound of a disturbance."""
        return _FAR * self.size

    @property
    def over(self) -> dict[str, str]:
        """Variable -> itself over its scale, as a law writes it."""
        return {one: f"({one}/n_{one})" for one in self.scales}

    @property
    def held(self) -> dict[str, float]:
        """The scales as parameters of an effect."""
        return {f"n_{one}": scale for one, (scale, _) in self.scales.items()}

    @contextmanager
    def effect(self, law: str, parameters: Sequence[EffectParameter]) -> Iterator[tuple[Effect, Variants]]:
        """The law as an effect, beside what the slot has, and what builds models with it."""
        scales = [
            EffectParameter(f"n_{one}", unit, 0.0, _FAR * scale, scale, scale, None)
            for one, (scale, unit) in self.scales.items()
        ]
        text = law_class("Tried", self.slot, self.own + law, [*scales, *parameters], PUMP.variants.libraries,
                         effect="tried.law")  # fmt: skip
        with _effect(text, "Tried") as made:
            yield made


def tried(case: LearnedCase) -> Iterator[Tried]:
    """Every way on one case, the model without a law first."""
    measured, begun = measure(case), time.monotonic()
    base = _fitted(measured.given)
    yield Tried(case.name, "no law", "-", base.error(measured), time.monotonic() - begun)
    ways: Sequence[tuple[str, Callable[[LearnedCase, Dataset, _Fitted], tuple[str, _Fitted]]]] = (
        ("curve over one variable at every slot", _curves),
        ("neural network in the right place", _network),
        ("sparse regression of a smoothed disturbance", _sparse),
    )
    for way, answer in ways:
        begun = time.monotonic()
        found, fitted = answer(case, measured.given, base)
        took = time.monotonic() - begun
        yield Tried(case.name, way, found, fitted.error(measured), took)


def _fitted(
    data: Dataset, effect: Effect | None = None, more: Callable[[str], Sequence[Parameter]] | None = None,
    variants: Variants = PUMP.variants, held: Mapping[str, float] | None = None,
) -> _Fitted:  # fmt: skip
    """The pump with an effect, its own parameters and some of the effect's free.

    Args:
        more: free parameters of the effect; the prefix of their names is given.
        held: other parameters of the effect.
    """
    model, places = variants.build([effect] if effect else [])
    place = places[effect.name] if effect else ""
    free = [Parameter(name) for name in identifiable(PUMP.model)] + list(more(place) if more else ())
    fixed = {f"{place}.{name}": value for name, value in (held or {}).items()}
    found = fit(problem(model, [data], free, fixed=fixed))
    return _Fitted(found, model, {**fixed, **{one.name: found.values[one.name] for one in free}})


@contextmanager
def _effect(text: str, name: str) -> Iterator[tuple[Effect, Variants]]:
    """The effect of the class of that name, and what builds models with it."""
    with TemporaryDirectory(prefix="learned-") as folder:
        file = Path(folder) / f"{name}.mo"
        file.write_text(text, encoding="utf-8")
        libraries = (*PUMP.variants.libraries, file)
        effect = next(one for one in read_catalogue(*libraries) if one.class_name == name)
        yield effect, Variants(PUMP.class_name, libraries)


def _slots() -> dict[str, Slot]:
    return {one.name: one for one in slots(PUMP.class_name, PUMP.variants.libraries)}


def _curves(case: LearnedCase, data: Dataset, base: _Fitted) -> tuple[str, _Fitted]:
    """A curve over each variable of each slot, by itself; the log that may choose picks one."""
    best, found = None, "-"
    for slot in _slots().values():
        names = [f"{slot.name}.{one}" for one in slot.sees]
        known = [name for name in names if any(v.name == name for v in base.model.variables)]
        seen = _seen(base, data, known)
        for name in known:
            low, high = float(seen[name].min()), float(seen[name].max())
            if not low < high:
                continue
            given = next(one for one in slot.gives if not one.endswith("_t"))
            unit = base.model[f"{slot.name}.{given}"].unit
            law = LearnedLaw(
                slot.name, Factor(), name, np.linspace(low, high, _KNOTS), np.zeros(_KNOTS),
                np.zeros((_KNOTS, _KNOTS)), 0.0, base.model[name].unit or "1", unit or "1",
            )  # fmt: skip
            try:
                text = learned_class(law, slot, "Curve", PUMP.variants.libraries, effect="tried.curve")
                with _effect(text, "Curve") as (effect, variants):
                    one = _fitted(data, effect, _coefficients, variants)
            except BadInput:
                continue
            if best is None or one.chooses < best.chooses:
                best, found = one, f"{slot.name} over {name}"
    return found, best or base


def _coefficients(prefix: str) -> list[Parameter]:
    """Values of the curve at its knots, free."""
    return [Parameter(f"{prefix}.c[{k}]", 0.0, -_OPEN, _OPEN, log=False) for k in range(1, _KNOTS + 1)]


def _network(case: LearnedCase, data: Dataset, base: _Fitted) -> tuple[str, _Fitted]:
    """A universal differential equation: a layer of neurons that see all variables of the slot.

    Source: Rackauckas et al. 2020, arXiv:2001.04385. It is trained as all models are, with exact derivatives.
    """
    place, neurons = _Place.of(case, base, data), range(1, _HIDDEN + 1)
    inner = [
        f"w_{k}*tanh(" + " + ".join(f"a_{k}_{one}*{one}/n_{one}" for one in place.scales) + f" + b_{k})"
        for k in neurons
    ]
    weights = [*(f"w_{k}" for k in neurons), *(f"b_{k}" for k in neurons)]
    weights += [f"a_{k}_{one}" for k in neurons for one in place.scales]
    declared = [EffectParameter("n", place.unit, 0.0, place.far, place.size, place.size, 0.0)]
    declared += [EffectParameter(one, "1", -_HEAVY, _HEAVY, 1.0, 0.0, None) for one in weights]
    rng, best = np.random.default_rng(_SEED), None
    with place.effect(f"n*({' + '.join(inner)})", declared) as (effect, variants):
        for _ in range(_STARTS):
            start = {name: 0.1 * rng.standard_normal() if name[0] == "w" else rng.standard_normal() for name in weights}

            def free(prefix: str, start: Mapping[str, float] = start) -> list[Parameter]:
                return [
                    Parameter(f"{prefix}.{name}", value, -_HEAVY, _HEAVY, log=False, prior=(0.0, _USUAL))
                    for name, value in start.items()
                ]

            one = _fitted(data, effect, free, variants, {"n": place.size, **place.held})
            if best is None or one.chooses < best.chooses:
                best = one
    assert best is not None
    return f"{_HIDDEN} neurons, {len(weights)} weights, best of {_STARTS} starts", best


def _sparse(case: LearnedCase, data: Dataset, base: _Fitted) -> tuple[str, _Fitted]:
    """The disturbance that explains the residual, smoothed; a few terms of a library for it; their sizes refitted.

    Source: Brunton, Proctor and Kutz 2016, PNAS 113:3932 (sparse identification of nonlinear dynamics).
    """
    place = _Place.of(case, base, data)
    disturbance, library = _smoothed(base, data, place), _library(list(place.scales))
    z = {one: samples / place.scales[one][0] for one, samples in place.samples.items()}
    table = np.column_stack([Moment(read_law(f"y = {term}"), z)["y"] + 0 * disturbance for term in library])
    terms = [library[k] for k in _few(table, disturbance)]
    law = " + ".join(f"c_{k}*{replaced(term, place.over)}" for k, term in enumerate(terms))
    declared = [
        EffectParameter(f"c_{k}", place.unit, -place.far, place.far, place.size, 0.0, 0.0) for k in range(len(terms))
    ]

    def free(prefix: str) -> list[Parameter]:
        return [Parameter(f"{prefix}.{one.name}", 0.0, one.min, one.max, log=False) for one in declared]

    with place.effect(law, declared) as (effect, variants):
        return " + ".join(terms), _fitted(data, effect, free, variants, place.held)


def _library(names: Sequence[str]) -> list[str]:
    """Powers and products up to the third degree, sizes, and signs of a speed times powers of the position."""
    found = ["1"]
    for degree in (1, 2, 3):
        found += ["*".join(some) for some in combinations_with_replacement(names, degree)]
    found += [f"abs({one})" for one in names]
    return found + (["tanh(20*v)", "tanh(20*v)*x", "tanh(20*v)*x*x"] if "v" in names else [])


def _few(table: Array, target: Array) -> list[int]:
    """Columns that remain where small terms are dropped again and again (sequentially thresholded least squares)."""
    size = np.sqrt(np.mean(table**2, axis=0))
    kept = list(range(table.shape[1]))
    while True:
        amounts = np.abs(np.linalg.lstsq(table[:, kept] / size[kept], target, rcond=1e-9)[0])
        large = [k for k, amount in zip(kept, amounts, strict=True) if amount >= _SMALL * amounts.max()]
        if large == kept:
            return kept
        kept = large


def _waves(data: Dataset) -> list[Record]:
    return [r.data for r in data.records if r.use == "fit" and r.frequency is None and isinstance(r.data, Record)]


def _run(model: Model, wave: Record, values: Mapping[str, float], record: Sequence[str]) -> Record:
    """A wave as the model simulates it, from rest."""
    command = {"alphaCMD": Signal.lines(wave.time, wave["alphaCMD"])}
    run = Experiment(wave.time, tuple(record), command, values, start=float(wave.time[0]) - 1.0,
                     rates=model.rate_inputs(command))  # fmt: skip
    return simulate(model, run, solver=Rodas(1e-6, 1e-6))


def _seen(base: _Fitted, data: Dataset, names: Sequence[str]) -> dict[str, Array]:
    """Samples of the model's own variables along the fitted waves."""
    runs = [_run(base.model, wave, base.values, names) for wave in _waves(data)] if names else []
    return {name: np.concatenate([run[name] for run in runs]) for name in names}


def _smoothed(base: _Fitted, data: Dataset, place: _Place) -> Array:
    """The disturbance at a slot along the fitted waves, from the angle's residual by a Wiener filter.

    Source: Wiener 1949, Extrapolation, Interpolation, and Smoothing of Stationary Time Series.
    """
    response, found = _response(base, _waves(data)[0], place), []
    for wave in _waves(data):
        rest = wave["alphaPercent"] - _run(base.model, wave, base.values, ["alphaPercent"])["alphaPercent"]
        n = 2 * rest.size
        of = np.fft.rfft(response, n) * np.exp(2j * np.pi * np.fft.rfftfreq(n) * _AHEAD)
        power = np.mean(rest**2) / max(float(np.mean(np.abs(of) ** 2)), np.finfo(float).tiny)
        whole = np.fft.rfft(rest, n) * np.conj(of) / (np.abs(of) ** 2 + _noise(rest) ** 2 / power)
        found.append(np.fft.irfft(whole, n)[: rest.size])
    return np.concatenate(found)


def _response(base: _Fitted, wave: Record, place: _Place) -> Array:
    """Mean answer of the angle to one sample of disturbance 1, from _AHEAD samples before it on."""
    declared = [
        EffectParameter("d", place.unit, -place.far, place.far, place.size, 0.0, 0.0),
        EffectParameter("t", "s", -_OPEN, _OPEN, 1.0, 0.0, None),
        EffectParameter("w", "s", 0.0, 1.0, _PULSE, _PULSE, None),
    ]
    with place.effect("d*exp(-((time - t)/w)^2)", declared) as (effect, variants):
        model, places = variants.build([effect])
    ahead, answers = places[effect.name], []
    calm = _run(model, wave, base.values, ["alphaPercent"])["alphaPercent"]
    for at in _PULSES.tolist():
        pulse = {f"{ahead}.d": place.size, f"{ahead}.t": float(wave.time[0]) + at}
        moved = _run(model, wave, {**base.values, **pulse}, ["alphaPercent"])["alphaPercent"]
        first = round(at * _RATE)
        answers.append((moved - calm)[first - _AHEAD : first + round(_ANSWER * _RATE)])
    return np.asarray(np.mean(answers, axis=0) / (place.size * np.sqrt(np.pi) * _PULSE * _RATE))


def _noise(rest: Array) -> float:
    """Standard deviation of white noise, from second differences."""
    return float(np.std(np.diff(rest, 2)) / np.sqrt(6))


if __name__ == "__main__":
    names = sys.argv[1:] or THREE
    for name in names:
        for one in tried(next(case for case in CASES if case.name == name)):
            print(one, flush=True)
