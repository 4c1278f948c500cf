"""A linear system in place of a model, and data sets and comparisons made with it, for the tests of this tree."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from pysim.identify import TransferFunction, frequency_deviations
from pysim.types import (
    Abilities,
    Comparison,
    Dataset,
    Experiment,
    FrequencyResponse,
    MeasuredRecord,
    MeasuredSignal,
    Model,
    Outcome,
    Record,
    ResponseComparison,
    SineTest,
    Variable,
)

FREQUENCIES = (0.1, 1.0, 5.0, 12.0)
SYSTEM = TransferFunction((5e3,), (1.0, 60.0, 5e3))
TESTS = tuple(SineTest(o, a, "cmd", "angle") for o in (-50.0, 50.0) for a in (5.0, 20.0))


def variable(name: str, causality: str, unit: str) -> Variable:
    """A real variable of no further interest."""
    return Variable(name, 0, "Real", causality, "continuous", 0.0, unit, None, "", None, None, None, None)


def model(*extra: Variable, unit: str = "%") -> Model:
    """A model with a command, an angle and a parameter k; never run."""
    variables = (variable("cmd", "input", unit), variable("angle", "output", "%"), variable("k", "parameter", "1"))
    abilities = Abilities(2, True, True, True, True, 0, (), ())
    return Model(Path("linear.fmu"), "Linear", "0", (*variables, *extra), abilities)


def dataset(responses: Sequence[FrequencyResponse] | None = None) -> Dataset:
    """The measured responses, SYSTEM's own by default."""
    if responses is None:
        responses = [SYSTEM.response(np.array(FREQUENCIES), test, origin="measured") for test in TESTS]
    signals = (MeasuredSignal("cmd", "input", "%", "", "cmd"), MeasuredSignal("angle", "output", "%", "", "angle"))
    records = tuple(MeasuredRecord("x.csv", "frequency-response-table", "fit", r) for r in responses)
    return Dataset("bench", "Take it <with> care.", "pump", signals, records)


def steady_output(experiment: Experiment, onset: float = 2.0) -> Record:
    """What SYSTEM answers to a stepped sine once it has settled; parameter k adds to its gain."""
    a, phi, omega, _ = experiment.inputs["cmd"].sines[-1, 0]
    offset = experiment.inputs["cmd"].cubics[-1, 0]
    g = SYSTEM.at(np.array([omega / (2 * np.pi)]))[0] * (1 + experiment.overrides.get("k", 0.0) * omega)
    y = offset + a * abs(g) * np.sin(omega * (experiment.times - onset) + phi + np.angle(g))
    return Record(experiment.times, y[:, None], ("angle",), ("%",), origin="simulated Linear")


def failed_output(experiment: Experiment) -> Record:
    """A run that stopped at once."""
    nothing = np.zeros((0, 1))
    return Record(np.zeros(0), nothing, ("angle",), ("%",), Outcome.NOT_FINITE, "at t = 0.7 s")


def comparison(label: str, *, error_db: float = 0.0, fails: int = 0) -> Comparison:
    """SYSTEM against itself with its gain above 0.1 Hz off by error_db; the first `fails` tests did not run."""
    tests = []
    for i, measured in enumerate(dataset().responses()):
        gain = measured.gain * np.where(measured.frequency > 0.1, 10 ** (error_db / 20), 1.0)
        simulated = FrequencyResponse(measured.frequency, gain, measured.phase, measured.test, "simulated")
        if i < fails:
            tests.append(ResponseComparison(measured, None, (), "at 5 Hz: stopped"))
        else:
            tests.append(ResponseComparison(measured, simulated, frequency_deviations(simulated, measured)))
    return Comparison("Linear", label, "bench", "Take it <with> care.", tuple(tests), {"k": 2.5})
