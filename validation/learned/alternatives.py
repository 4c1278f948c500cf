"""What else a user might do about three of the laws: `python -m validation.learned.alternatives [CASE ...]`.

Each way is told the model and the logs. Network and sparse regression are told the right place too; the curves are not.
A line gives the error on the wave that was not given, as in the table of the learned laws, and the time.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
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
from pysim.identify.greybox import Effort, Parameter, fit, problem
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
_SIGNALS = {"pistonForce": {"x": "piston.x", "v": "piston.v"}, "spoolOpening": {"s": "spool.u"}}
_OF_SLOT = {"pistonForce": ("N", 100.0), "spoolOpening": ("1", 0.01)}  # unit and size of a disturbance
_KNOTS = 9  # of a curve
_HIDDEN = 6  # neurons of the network, in one layer
_STARTS = 3  # of the network's weights, drawn at random
_SEED = 1
_RATE = 250.0  # Hz, of the logs
_PULSES = np.arange(3.0, 20.0, 0.85)  # s, times of the pulses whose mean answer is the response to a disturbance
_PULSE, _ANSWER = 0.02, 2.0  # s, width of a pulse, and how long its answer is recorded
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


def tried(case: LearnedCase) -> Iterator[Tried]:
    """Every way on one case, the model without a law first."""
    measured = measure(case)
    ways: Sequence[tuple[str, Callable[[LearnedCase, Dataset], tuple[str, _Fitted]]]] = (
        ("no law", lambda case, data: ("-", _fitted(data))),
        ("curve over one variable at every slot", _curves),
        ("neural network in the right place", _network),
        ("sparse regression of a smoothed disturbance", _sparse),
    )
    for way, answer in ways:
        begun = time.monotonic()
        found, fitted = answer(case, measured.given)
        took = time.monotonic() - begun
        yield Tried(case.name, way, found, fitted.error(measured), took)


def _fitted(
    data: Dataset, effect: Effect | None = None, more: Callable[[str], Sequence[Parameter]] | None = None,
    variants: Variants = PUMP.variants, effort: Effort | None = None, held: Mapping[str, float] | None = None,
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
    found = fit(problem(model, [data], free, fixed=fixed), effort=effort)
    return _Fitted(found, model, {**fixed, **{one.name: found.values[one.name] for one in free}})


def _effect(text: str, folder: Path) -> tuple[Effect, Variants]:
    """The effect of a class, and what builds models with it."""
    name = text.split("model ", 1)[1].split(None, 1)[0]
    file = folder / f"{name}.mo"
    file.write_text(text, encoding="utf-8")
    libraries = (*PUMP.variants.libraries, file)
    effect = next(one for one in read_catalogue(*libraries) if one.class_name == name)
    return effect, Variants(PUMP.class_name, libraries)


def _slots() -> dict[str, Slot]:
    return {one.name: one for one in slots(PUMP.class_name, PUMP.variants.libraries)}


def _curves(case: LearnedCase, data: Dataset) -> tuple[str, _Fitted]:
    """A curve over each variable of each slot, by itself; the log that may choose picks one."""
    base, best = _fitted(data), None
    found = "-"
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
            with TemporaryDirectory(prefix="learned-") as folder:
                try:
                    text = learned_class(law, slot, "Curve", PUMP.variants.libraries, effect="tried.curve")
                    effect, variants = _effect(text, Path(folder))
                    one = _fitted(data, effect, _coefficients(float(np.ptp(seen[name]))), variants)
                except BadInput:
                    continue
            if best is None or one.chooses < best.chooses:
                best, found = one, f"{slot.name} over {name}"
    return found, best or base


def _coefficients(size: float) -> Callable[[str], list[Parameter]]:
    """Values of the curve at its knots, free."""
    return lambda place: [Parameter(f"{place}.c[{k}]", 0.0, -1e9, 1e9, log=False) for k in range(1, _KNOTS + 1)]


def _network(case: LearnedCase, data: Dataset) -> tuple[str, _Fitted]:
    """A universal differential equation: a layer of neurons that see all variables of the slot.

    Source: Rackauckas et al. 2020, arXiv:2001.04385. It is trained as all models are, with exact derivatives.
    """
    (place, *_) = case.kind.places[0]
    slot, base = _slots()[place], _fitted(data)
    names, (unit, size) = _SIGNALS[place], _OF_SLOT[place]
    seen = _seen(base, data, list(names.values()))
    scales = {one: float(f"{np.std(seen[full]):.3g}") for one, full in names.items()}
    units = {one: base.model[full].unit or "1" for one, full in names.items()}
    inner = [
        f"w_{k}*tanh(" + " + ".join(f"a_{k}_{one}*{one}/n_{one}" for one in names) + f" + b_{k})"
        for k in range(1, _HIDDEN + 1)
    ]
    law = f"n*({' + '.join(inner)})"
    weights = [f"w_{k}" for k in range(1, _HIDDEN + 1)] + [f"b_{k}" for k in range(1, _HIDDEN + 1)]
    weights += [f"a_{k}_{one}" for k in range(1, _HIDDEN + 1) for one in names]
    declared = [EffectParameter("n", unit, 0.0, 1e3 * size, size, size, 0.0)]
    declared += [EffectParameter(f"n_{one}", units[one], 0.0, 1e3 * s, s, s, None) for one, s in scales.items()]
    declared += [EffectParameter(one, "1", -20.0, 20.0, 1.0, 0.0, None) for one in weights]
    own = "s + " if place == "spoolOpening" else ""
    text = law_class("Network", slot, own + law, declared, PUMP.variants.libraries, effect="tried.network")
    held = {"n": size, **{f"n_{one}": scale for one, scale in scales.items()}}
    rng, best = np.random.default_rng(_SEED), None
    with TemporaryDirectory(prefix="learned-") as folder:
        effect, variants = _effect(text, Path(folder))
        for _ in range(_STARTS):
            start = {name: 0.1 * rng.standard_normal() if name[0] == "w" else rng.standard_normal() for name in weights}

            def free(prefix: str, start: Mapping[str, float] = start) -> list[Parameter]:
                return [
                    Parameter(f"{prefix}.{name}", value, -20.0, 20.0, log=False, prior=(0.0, 3.0))
                    for name, value in start.items()
                ]

            one = _fitted(data, effect, free, variants, held=held)
            if best is None or one.chooses < best.chooses:
                best = one
    assert best is not None
    return f"{_HIDDEN} neurons, {len(weights)} weights, best of {_STARTS} starts", best


def _sparse(case: LearnedCase, data: Dataset) -> tuple[str, _Fitted]:
    """The disturbance that explains the residual, smoothed; a few terms of a library for it; their sizes refitted.

    Source: Brunton, Proctor and Kutz 2016, PNAS 113:3932 (sparse identification of nonlinear dynamics).
    """
    (place, *_) = case.kind.places[0]
    slot, base = _slots()[place], _fitted(data)
    names, (unit, size) = _SIGNALS[place], _OF_SLOT[place]
    seen, disturbance = _seen(base, data, list(names.values())), _smoothed(base, data, slot, size)
    scales = {one: float(f"{np.std(seen[full]):.3g}") for one, full in names.items()}
    z = {one: seen[full] / scales[one] for one, full in names.items()}
    library = _library(list(z))
    table = np.column_stack([Moment(read_law(f"y = {term}"), z)["y"] + 0 * disturbance for term in library])
    terms = [library[k] for k in _few(table, disturbance)]
    units = {one: base.model[full].unit or "1" for one, full in names.items()}
    over = {one: f"({one}/n_{one})" for one in names}
    law = " + ".join(f"c_{k}*{replaced(term, over)}" for k, term in enumerate(terms))
    declared = [EffectParameter(f"n_{one}", units[one], 0.0, 1e3 * s, s, s, None) for one, s in scales.items()]
    far = 1e3 * size
    declared += [EffectParameter(f"c_{k}", unit, -far, far, size, 0.0, 0.0) for k in range(len(terms))]
    own = "s + " if place == "spoolOpening" else ""
    text = law_class("Sparse", slot, own + law, declared, PUMP.variants.libraries, effect="tried.sparse")

    def free(prefix: str) -> list[Parameter]:
        return [Parameter(f"{prefix}.c_{k}", 0.0, -far, far, log=False) for k in range(len(terms))]

    held = {f"n_{one}": scale for one, scale in scales.items()}
    with TemporaryDirectory(prefix="learned-") as folder:
        effect, variants = _effect(text, Path(folder))
        return " + ".join(terms), _fitted(data, effect, free, variants, held=held)


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
        amounts = np.linalg.lstsq(table[:, kept] / size[kept], target, rcond=1e-9)[0]
        large = [
            k for k, amount in zip(kept, np.abs(amounts), strict=True) if amount >= _SMALL * np.max(np.abs(amounts))
        ]
        if large == kept:
            return kept
        kept = large


def _waves(data: Dataset) -> list[Record]:
    return [r.data for r in data.records if r.use == "fit" and r.frequency is None and isinstance(r.data, Record)]


def _runs(base: _Fitted, data: Dataset, record: Sequence[str]) -> list[Record]:
    """The fitted waves as the model simulates them, from rest."""
    found = []
    for wave in _waves(data):
        command = {"alphaCMD": Signal.lines(wave.time, wave["alphaCMD"])}
        run = Experiment(wave.time, tuple(record), command, base.values, start=float(wave.time[0]) - 1.0,
                         rates=base.model.rate_inputs(command))  # fmt: skip
        found.append(simulate(base.model, run, solver=Rodas(1e-6, 1e-6)))
    return found


def _seen(base: _Fitted, data: Dataset, names: Sequence[str]) -> dict[str, Array]:
    """Samples of the model's own variables along the fitted waves."""
    runs = _runs(base, data, names) if names else []
    return {name: np.concatenate([run[name] for run in runs]) for name in names}


def _smoothed(base: _Fitted, data: Dataset, slot: Slot, size: float) -> Array:
    """The disturbance at a slot along the fitted waves, from the angle's residual by a Wiener filter.

    Source: Wiener 1949, Extrapolation, Interpolation, and Smoothing of Stationary Time Series.
    """
    unit, _ = _OF_SLOT[slot.name]
    own = "s + " if slot.name == "spoolOpening" else ""
    declared = [
        EffectParameter("d", unit, -1e3 * size, 1e3 * size, size, 0.0, 0.0),
        EffectParameter("t", "s", -1e9, 1e9, 1.0, 0.0, None),
        EffectParameter("w", "s", 0.0, 1.0, _PULSE, _PULSE, None),
    ]
    text = law_class("Pulse", slot, f"{own}d*exp(-((time - t)/w)^2)", declared, PUMP.variants.libraries,
                     effect="tried.pulse")  # fmt: skip
    with TemporaryDirectory(prefix="learned-") as folder:
        effect, variants = _effect(text, Path(folder))
        model, places = variants.build([effect])
    place, answers = places[effect.name], []
    wave = _waves(data)[0]
    for at in _PULSES.tolist():
        pair = []
        for amount in (0.0, size):
            values = {**base.values, f"{place}.d": amount, f"{place}.t": float(wave.time[0]) + at}
            pair.append(_runs(_Fitted(base.fit, model, values), data, ["alphaPercent"])[0]["alphaPercent"])
        first = round(at * _RATE)
        answers.append((pair[1] - pair[0])[first - 25 : first + round(_ANSWER * _RATE)])
    response = np.mean(answers, axis=0) / (size * np.sqrt(np.pi) * _PULSE * _RATE)  # of one sample of disturbance 1
    found = []
    for wave, run in zip(_waves(data), _runs(base, data, ["alphaPercent"]), strict=True):
        rest = wave["alphaPercent"] - run["alphaPercent"]
        n = 2 * rest.size
        of = np.fft.rfft(response, n) * np.exp(2j * np.pi * np.fft.rfftfreq(n) * 25)
        noise = _noise(rest)
        power = np.mean(rest**2) / max(float(np.mean(np.abs(of) ** 2)), np.finfo(float).tiny)
        whole = np.fft.rfft(rest, n) * np.conj(of) / (np.abs(of) ** 2 + noise**2 / power)
        found.append(np.fft.irfft(whole, n)[: rest.size])
    return np.concatenate(found)


def _noise(rest: Array) -> float:
    """Standard deviation of white noise, from second differences."""
    return float(np.std(np.diff(rest, 2)) / np.sqrt(6))


if __name__ == "__main__":
    names = sys.argv[1:] or THREE
    for name in names:
        for one in tried(next(case for case in CASES if case.name == name)):
            print(one, flush=True)
