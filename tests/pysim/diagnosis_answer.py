"""A diagnosis whose every number is known: a biased damping, an offset that was missing, and noise of size one."""

from dataclasses import replace

import numpy as np

from pysim.types import (
    Dataset,
    Diagnosis,
    Direction,
    Effect,
    EffectParameter,
    ErrorStep,
    Estimate,
    Failure,
    FoundEffect,
    Harmonics,
    LearnedLaw,
    Left,
    MeasuredRecord,
    MeasuredSignal,
    Note,
    NoteCode,
    Record,
    RecordFit,
    Rival,
)
from pysim.types.factor import Factor

OFFSET = Effect(
    "toy.offset",
    "force",
    "Toy.Offset",
    (EffectParameter("F_o", "N", -5.0, 5.0, 0.3, 0.0, 0.0),),
    "Constant force (toy.offset)",
    law="f = F_o;",
)
LEFT = {"prior": 8.0, "refit": 3.0, "toy.offset": 0.0}  # what each model leaves beside noise, a constant
WAVE = 6.0  # Hz, of a ripple that the refitted model leaves in the log that was fitted


def estimate(name: str, value: float, half: float, *, start: float = 1.0, unit: str = "N") -> Estimate:
    """With an interval of that half width; a half width of zero: not determined."""
    std = half / 1.96 if half else np.inf
    interval = (value - half, value + half) if half else (0.1, 10.0)
    return Estimate(name, unit, value, start, 0.1, 10.0, std, interval)


def record(source: str, use: str, step: str, index: int, *, frequency: float = 0.0) -> RecordFit:
    """A log of one signal, sampled at 100 Hz for 8 s; noise 0.5 in its unit."""
    noise, time = 0.5, np.arange(0, 8, 0.01)
    wave = np.sin(2 * np.pi * (frequency or 0.7) * time)
    white = np.random.default_rng(index + 1).standard_normal(time.size)
    white = (white - white.mean()) / white.std()  # so that what is left over has a known size
    left = LEFT[step] * (1.5 if frequency == 1.0 else 1.0)
    ripple = 6 * np.sin(2 * np.pi * WAVE * time) if (step, use, frequency) == ("refit", "fit", 0.0) else 0.0
    measured = 20 * wave + noise * (white + left + ripple)
    columns = [Record(time, values[:, None], ("x",), ("m",)) for values in (measured, 20 * wave)]
    harmonics = ()
    if frequency:
        size = np.array([0.0, 20.0], dtype=np.complex128)
        harmonics = (Harmonics("x", frequency, size + noise * np.array([left, 0]), size, np.array([0.1, 0.1])),)
    kind = "frequency-response" if frequency else "stochastic"
    return RecordFit("toy", source, kind, use, *columns, (noise,), {}, harmonics, index=index)


def stage(step: str, *estimates: Estimate, **more: object) -> ErrorStep:
    """A model beside two stepped sines, a log, and a log held out."""
    records = (
        record("sines/1Hz.txt", "fit", step, 0, frequency=1.0),
        record("sines/5Hz.txt", "fit", step, 1, frequency=5.0),
        record("wave.txt", "fit", step, 2),
        record("held.txt", "validate", step, 3),
    )
    where = tuple(Failure(r.source, "x", "everywhere", r.rms["x"]) for r in records)
    values: dict[str, object] = {"fit": None, "validate": None, "test": None, "criteria": {}, "passes": True, "cost": 0}
    values |= {"estimates": estimates, "records": records, "failures": where}
    return ErrorStep(step, **(values | more))  # type: ignore[arg-type]


def dataset() -> Dataset:
    """What the records were taken from."""
    signals = (MeasuredSignal("F", "input", "N", "force", "F"), MeasuredSignal("x", "output", "m", "place", "x", 0.5))
    empty = Record(np.arange(2.0), np.zeros((2, 2)), ("F", "x"), ("N", "m"))
    sines = [
        MeasuredRecord(f"sines/{f:g}Hz.txt", "frequency-response", "fit", empty, 50.0, 10.0, f, "F") for f in (1.0, 5.0)
    ]
    logs = [MeasuredRecord(f"{n}.txt", "stochastic", u, empty) for n, u in (("wave", "fit"), ("held", "validate"))]
    return Dataset("toy", "a mass", "mass", signals, (*sines, *logs))


def step(name: str, fit: float, validate: float | None, magnitude: float) -> ErrorStep:
    """One criterion of Table 1.3, whose limit is 0.5 dB; no record."""
    return ErrorStep(name, fit, validate, None, {"E_M mean": magnitude}, magnitude <= 0.5, fit**2)


LAW = LearnedLaw(
    "force", Factor(), "v", np.linspace(-1, 1, 11), -0.4 * np.sign(np.linspace(-1, 1, 11)), 0.05**2 * np.eye(11), 0.97,
    "m/s", "N", formula="-0.4 sign(v)",
)  # fmt: skip


def found_offset(**changes: object) -> Diagnosis:
    """m and k were scaled together by chance (held: m), d was biased, and the offset took nearly all of the misfit.

    Args:
        changes: fields of the answer, in place of what stands here.
    """
    open_ = Direction({"m": 1.0, "k": 2.0}, np.inf)
    before = (estimate("m", 2.0, 0.0), estimate("k", 3.0, 0.3), estimate("d", 1.0, 0.2))
    after = (estimate("m", 1.0, 0.0), estimate("k", 0.75, 0.1), estimate("d", 1.5, 0.1), estimate("F_o", 0.4, 0.05))

    def model(name: str, fit: float, validate: float, magnitude: float, *own: Estimate, **more: object) -> ErrorStep:
        criteria = {"E_M mean": magnitude}
        numbers = {"fit": fit, "validate": validate, "criteria": criteria, "passes": magnitude <= 0.5, "cost": fit**2}
        return stage(name, *own, **numbers, **more)

    history = (
        model("prior", 8.1, 8.0, 0.9),
        model("refit", 4.2, 3.2, 0.6, *before, undetermined=(open_,)),
        model("toy.offset", 1.0, 1.01, 0.1, *after, undetermined=(open_,)),
    )
    values: dict[str, object] = {
        "effects": (FoundEffect(OFFSET, "force", after[-1:], 0.99),),
        "complete": True,
        "left": Left({}, 1.0, 1.01, 0.01, 0.5),
        "rivals": (
            Rival(("toy.offset",), 900.0, 1e-9, 0.99, True, {"F_o": 0.4}),
            Rival(("toy.twin",), 895.0, 1e-9, 0.98, True, {"F_t": 0.4}),
            Rival(("toy.other",), 12.0, 1e-3, 0.05, False, {"k_3": 5.0}),
            Rival(("toy.idle",), -6.0, 0.9, 0.0, False, {"F_i": 0.1}),
        ),
        "ties": (("toy.offset", "toy.twin"),),
        "history": history,
        "failures": history[1].failures,
        "estimates": after,
        "notes": (Note(NoteCode.NOISE_ESTIMATED, {"dataset": "toy", "signal": "x", "value": 0.5, "unit": "m"}),),
        "conditions": {"seed": "7"},
        "seconds": {"refit": 1.5},
    }
    return Diagnosis(**(values | changes))  # type: ignore[arg-type]


def found_two() -> Diagnosis:
    """The same with a second effect, toy.rub, that joined after the offset and is less costly to leave out."""
    one = found_offset()
    rub = replace(OFFSET, name="toy.rub", description="Rubbing (toy.rub)")
    stages = (*one.history, replace(one.history[-1], step="toy.rub"))
    rivals = (*one.rivals, Rival(("toy.offset", "toy.rub"), 90.0, 1e-9, 1.0, True, {"F_o": 0.4}))
    effects = (replace(one.effects[0], share=0.6), FoundEffect(rub, "force", one.estimates[-1:], 0.4))
    return replace(one, effects=effects, history=stages, rivals=rivals)


def nothing(**changes: object) -> Diagnosis:
    """The same where the data ask for nothing."""
    full = found_offset()
    values: dict[str, object] = {"effects": (), "ties": (), "history": full.history[:2], "left": Left({}, 4.2, 3.2)}
    return found_offset(**(values | changes))
