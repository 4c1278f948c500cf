"""Fits of a transfer function to every frequency response of a data set."""

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
from pysim.io import shown_unit
from pysim.types import BadInput, Dataset, Deviation, FrequencyResponse
from pysim.types.note import Note
from pysim.types.record_kind import STEPPED_SINE

Progress = Callable[[int, int], None]


@dataclass(frozen=True)
class FittedResponse:
    """The fit at one operating point.

    Args:
        label: offset and amplitude in the display unit, as in the thesis' file names; output and input follow if
            responses of several signals were fitted.
        measured: the response.
        fit: the transfer function; of the suggested structure if structures were compared.
        suggestion: that comparison, or None.
        reference_hz: frequency whose gain counts as 0 dB in `deviations`; None for absolute gains.
        deviations: the four deviations of thesis Table 1.3 between fit and measurement, as in Table 4.4.
        notes: notes on the fit, and on the analysis of the logs.
        held_out: these deviations for each response of the same test that is not fitted, in the order of the data.
    """

    label: str
    measured: FrequencyResponse
    fit: TransferFunctionFit
    suggestion: OrderSuggestion | None
    reference_hz: float | None
    deviations: tuple[Deviation, ...]
    notes: tuple[Note, ...]
    held_out: tuple[tuple[Deviation, ...], ...] = ()


@dataclass(frozen=True)
class _Found:
    """A response of the data set, and the factor from its input's unit to the display unit."""

    response: FrequencyResponse
    use: str
    factor: float
    notes: tuple[Note, ...] = ()

    @property
    def test(self) -> tuple[float, float]:
        """Offset and amplitude in the display unit."""
        return self.factor * self.response.test.offset, self.factor * self.response.test.amplitude

    def label(self, *, signals: bool) -> str:
        """Offset and amplitude in the display unit, followed by output and input if `signals`."""
        test = self.response.test
        return test.label_in(self.factor) + (f", {test.output} to {test.input}" if signals else "")

    def matches(self, test: tuple[float, float]) -> bool:
        """Whether its test has this offset and amplitude."""
        return bool(np.allclose(self.test, test, rtol=1e-6, atol=1e-9))

    def repeats(self, other: _Found) -> bool:
        """Whether both have the same offset, amplitude and signals."""
        one, two = self.response.test, other.response.test
        return (one.input, one.output) == (two.input, two.output) and self.matches(other.test)


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
    """Fit every response of the data set with use "fit": tables first, then those of stepped-sine logs.

    Responses with another use are compared with the transfer function of the same test.

    Args:
        structure: poles, zeros, dead time, stability; if structures are compared, the largest number of poles.
        weights: as for `fit_transfer_function`.
        suggest: compare all structures up to this number of poles, and take the suggested one.
        output: output signal of logs and tables; None takes those of all tables, and of logs with a single output.
        tests: (offset, amplitude) of the tests to fit, in display units (%, bar, deg); empty: all.
        progress: called with the number of finished fits and that of all.
    Raises:
        BadInput: no frequency response to fit, a test without a response, or a response that the fit rejects.
    """
    chosen = _chosen(dataset, output, tests)
    to_fit, held_out = ([one for one in chosen if (one.use != "fit") == held] for held in (False, True))
    if not to_fit:
        raise BadInput(f"data set {dataset.name!r}: none of its responses is to be fitted; leave some")
    several = len({(one.response.test.input, one.response.test.output) for one in to_fit}) > 1
    fitted = []
    for i, one in enumerate(to_fit):
        suggestion, measured = None, one.response
        if suggest:
            suggestion = suggest_orders(
                measured,
                most_poles=structure.poles,
                dead_time_max=structure.dead_time_max,
                stable=structure.stable,
                weights=weights,
            )
        fit = suggestion.suggested.fit if suggestion else fit_transfer_function(measured, structure, weights=weights)
        others = [other.response for other in held_out if other.repeats(one)]
        fitted.append(_fitted(one, one.label(signals=several), fit, suggestion, others))
        if progress:
            progress(i + 1, len(to_fit))
    return tuple(fitted)


def _chosen(dataset: Dataset, output: str | None, tests: Sequence[tuple[float, float]]) -> list[_Found]:
    def found(response: FrequencyResponse, use: str, notes: tuple[Note, ...] = ()) -> _Found:
        return _Found(response, use, shown_unit(dataset.signal(response.test.input).unit)[1], notes)

    tables = [(record.data, record.use) for record in dataset.records]
    there = [
        found(data, use)
        for data, use in tables
        if isinstance(data, FrequencyResponse) and output in (None, data.test.output)
    ]
    if any(record.kind == STEPPED_SINE.name for record in dataset.records):
        there += [found(one.response, one.use, one.notes) for one in measured_responses(dataset, output=output)]
    if not there:
        of = f" of {output}" if output else ""
        raise BadInput(
            f"data set {dataset.name!r} holds no frequency response{of}; test stepped sines, or give a table of "
            "frequency, magnitude and phase"
        )
    for test in tests:
        if not any(one.matches(test) for one in there):
            have = ", ".join(dict.fromkeys(f"{o:g}/{a:g}" for o, a in (one.test for one in there)))
            raise BadInput(f"data set {dataset.name!r} has no test {test[0]:g}/{test[1]:g}; it has {have}")
    return [one for one in there if not tests or any(one.matches(test) for test in tests)]


def _fitted(
    found: _Found,
    label: str,
    fit: TransferFunctionFit,
    suggestion: OrderSuggestion | None,
    held_out: Sequence[FrequencyResponse],
) -> FittedResponse:
    measured = found.response
    reference, deviations = _deviations(fit, measured)
    return FittedResponse(
        label=label,
        measured=measured,
        fit=fit,
        suggestion=suggestion,
        reference_hz=reference,
        deviations=deviations,
        notes=(*fit.notes, *found.notes),
        held_out=tuple(_deviations(fit, other)[1] for other in held_out),
    )


def _deviations(fit: TransferFunctionFit, measured: FrequencyResponse) -> tuple[float | None, tuple[Deviation, ...]]:
    """The reference frequency in Hz, that of the thesis if it was measured, else None; and the deviations."""
    model = fit.function.response(measured.frequency, measured.test)
    reference = THESIS_REFERENCE_HZ if np.any(np.isclose(measured.frequency, THESIS_REFERENCE_HZ, rtol=1e-6)) else None
    return reference, frequency_deviations(model, measured, reference_hz=reference)
