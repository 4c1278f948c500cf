"""A small fit with everything in it, for reports and plots."""

from __future__ import annotations

import math

import numpy as np

from pysim.types import (
    Combination,
    Criterion,
    Deviation,
    Direction,
    Estimate,
    Fit,
    FitOutcome,
    FrequencyResponse,
    Harmonics,
    Note,
    NoteCode,
    Record,
    RecordFit,
    ResponseComparison,
    ResponseFit,
    SineTest,
    Start,
)


def small_fit() -> Fit:
    time = np.linspace(0, 1, 50)
    measured = Record(time, np.column_stack([np.sin(time), np.cos(time)]), ("y", "u"), ("%", "1"))
    simulated = Record(time, measured.values + np.array([0.2, 0.0]), ("y", "u"), ("%", "1"))
    limit = Criterion("mean error", "E_t mean", 2.0, "%", "thesis Table 1.4")
    wave = RecordFit(
        "set", "wave.txt", "stochastic", "validate", measured, simulated, (0.1, 0.002), {"y": (Deviation(limit, 0.2),)},
        index=2,
    )  # fmt: skip
    columns = [Record(r.time, r.values[:, :1], ("y",), ("%",)) for r in (measured, simulated)]
    sines = [
        RecordFit(
            "set",
            f"O+25/{f:g}Hz.txt",
            "frequency-response",
            "fit",
            columns[0],
            columns[1],
            (0.1,),
            {},
            (Harmonics("y", f, np.array([25, 9j, 0.2]), np.array([25, 9.01j, 0.19]), np.array([0.01, 0.02, 0.02])),),
            index=place,
        )
        for place, f in enumerate((1.0, 5.0))
    ]
    response = FrequencyResponse(
        np.array([1.0, 5.0]), np.array([1.0, 0.9]), np.array([-0.1, -0.5]), SineTest(25, 10, "w", "y"), "measured"
    )
    comparison = ResponseComparison(response, response, (Deviation(limit, 0.0),))
    estimates = (
        Estimate("K", "1", 2.0, 1.5, 0.1, 10.0, 0.1, (1.8, 2.2)),
        Estimate("g", "1", 1.0, 1.0, 0.1, math.inf, math.inf, (0.1, math.inf)),
        Estimate("T", "s", 0.01, 0.4, 0.01, 5.0, 0.02, (0.01, 0.05), "lower"),
    )
    covariance = np.full((3, 3), math.nan)
    covariance[0, 0] = 0.01
    return Fit(
        model="Lag",
        objective="squares of residuals over their noise",
        optimiser="gauss-newton",
        estimates=estimates,
        covariance=covariance,
        values={"K": 2.0, "g": 1.0, "T": 0.01, "x@wave.txt": 0.5},
        undetermined=(Direction({"K": 1.0, "g": -1.0}, math.inf),),
        combinations=(Combination({"K": 1.0, "g": 1.0}, "K g", 2.0, (1.9, 2.1)),),
        records=(wave, *sines),
        responses=(ResponseFit("set", "fit", comparison),),
        cost=120.0,
        start_cost=9000.0,
        misfit=1.02,
        outcome=FitOutcome.CONVERGED,
        message="a full step would gain nothing",
        iterations=7,
        starts=(Start("given", {"K": 1.5}, 9000.0, 120.0, FitOutcome.CONVERGED),),
        notes=(Note(NoteCode.NOISE_ESTIMATED, {"dataset": "set", "signal": "u", "value": 0.1, "unit": "1"}),),
    )
