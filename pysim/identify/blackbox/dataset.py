"""A transfer function for every frequency response of a data set."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from pysim.identify.accuracy import frequency_deviations
from pysim.identify.blackbox.fit import fit_transfer_function
from pysim.identify.blackbox.orders import OrderSuggestion, suggest_orders
from pysim.identify.blackbox.result import TransferFunctionFit
from pysim.identify.blackbox.structure import Structure
from pysim.identify.frequency_response import THESIS_REFERENCE_HZ
from pysim.identify.frf import measured_responses
from pysim.types import BadInput, Dataset, Deviation, FrequencyResponse

LOGS = "frequency-response"

Progress = Callable[[int, int], None]


@dataclass(frozen=True)
class FittedResponse:
    """One working point.

    Args:
        measured: the response.
        fit: the transfer function; of the suggested structure where structures were compared.
        suggestion: that comparison, or None.
        reference_hz: whose gain counts as 0 dB in `deviations`; None for absolute gains.
        deviations: the four numbers of thesis Table 1.3 between the two, as in Table 4.4.
        remarks: what the analysis of the logs said.
    """

    measured: FrequencyResponse
    fit: TransferFunctionFit
    suggestion: OrderSuggestion | None
    reference_hz: float | None
    deviations: tuple[Deviation, ...]
    remarks: tuple[str, ...]

    @property
    def label(self) -> str:
        """Offset and amplitude, as in the thesis' file names."""
        return self.measured.test.label


def fit_dataset(
    dataset: Dataset,
    structure: Structure,
    *,
    weights: str = "",
    suggest: bool = False,
    output: str | None = None,
    tests: Sequence[tuple[float, float]] = (),
    progress: Progress | None = None,
) -> tuple[FittedResponse, ...]:
    """Fit every response of the data set, tables first, then those of its stepped-sine logs.

    Args:
        structure: poles, zeros, dead time, stability; where structures are compared, the most poles to try.
        weights: as for `fit_transfer_function`.
        suggest: compare all structures up to that number of poles and take the suggested one.
        output: the responding signal of the logs; may be left out where they hold a single one.
        tests: (offset, amplitude) in the input's unit of those to fit; all where empty.
        progress: called with how many are done, and of how many.
    Raises:
        BadInput: no frequency response, none of a test asked for, or what the fit refuses.
    """
    chosen = _chosen(dataset, output, tests)
    fitted = []
    for i, (measured, remarks) in enumerate(chosen):
        suggestion = None
        if suggest:
            suggestion = suggest_orders(
                measured,
                most_poles=structure.poles,
                dead_time_max=structure.dead_time_max,
                stable=structure.stable,
                weights=weights,
            )
        fit = suggestion.suggested.fit if suggestion else fit_transfer_function(measured, structure, weights=weights)
        fitted.append(_fitted(measured, fit, suggestion, remarks))
        if progress:
            progress(i + 1, len(chosen))
    return tuple(fitted)


def _chosen(
    dataset: Dataset, output: str | None, tests: Sequence[tuple[float, float]]
) -> list[tuple[FrequencyResponse, tuple[str, ...]]]:
    found = [(response, tuple[str, ...]()) for response in dataset.responses()]
    if any(record.kind == LOGS for record in dataset.records):
        found += [(measured.response, measured.remarks) for measured in measured_responses(dataset, output=output)]
    if not found:
        raise BadInput(
            f"data set {dataset.name!r} holds no frequency response; test stepped sines, or give a table of frequency, "
            "magnitude and phase"
        )
    there = [(response.test.offset, response.test.amplitude) for response, _ in found]
    for test in tests:
        if test not in there:
            have = ", ".join(f"{o:g}/{a:g}" for o, a in dict.fromkeys(there))
            raise BadInput(f"data set {dataset.name!r} has no test {test[0]:g}/{test[1]:g}; it has {have}")
    return [pair for pair, test in zip(found, there, strict=True) if not tests or test in tests]


def _fitted(
    measured: FrequencyResponse, fit: TransferFunctionFit, suggestion: OrderSuggestion | None, remarks: tuple[str, ...]
) -> FittedResponse:
    model = fit.function.response(measured.frequency, measured.test)
    reference = THESIS_REFERENCE_HZ if np.any(np.isclose(measured.frequency, THESIS_REFERENCE_HZ, rtol=1e-6)) else None
    deviations = frequency_deviations(model, measured, reference_hz=reference)
    return FittedResponse(measured, fit, suggestion, reference, deviations, remarks)
