"""Check whether measurements suffice for a diagnosis: refuse those that do not, note what weakens the answer."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from pysim.types import BadInput, Dataset, FrequencyResponse, MeasuredRecord, Record

# Fewest samples to fit per free parameter.
FEWEST = 10


def shortcomings(dataset: Dataset, free: Sequence[str], initial: str = "near rest") -> tuple[str, ...]:
    """Check a data set before anything is simulated.

    Args:
        free: parameters that will be refitted.
        initial: what is known of the state at a log's first sample, where its record does not say it.
    Returns:
        a note for each weakness: no log is held out, only one signal was logged, an input never moves.
    Raises:
        BadInput: fewer than FEWEST samples to fit per free parameter, or no input moves.
    """
    fitted = [record for record in dataset.records if record.use == "fit"]
    count = sum(_samples(record, dataset) for record in fitted)
    if count < FEWEST * len(free):
        raise BadInput(
            f"data set {dataset.name!r} has {count} samples to fit for {len(free)} free parameters; log at least "
            f"{FEWEST * len(free)}, fit more of them, or free fewer parameters"
        )
    notes = list(_still(dataset, fitted, initial))
    if not any(record.use != "fit" for record in dataset.records):
        notes.append(
            "every record is fitted, so nothing tells how far the answer holds for other tests; hold one out "
            '(use = "test", in Python data.hold_out(...))'
        )
    outputs = {name for record in fitted for name in _outputs(record, dataset)}
    if len(outputs) == 1:
        notes.append(
            f"{outputs.pop()} is the only output that was logged: effects that act alike on it cannot be separated; "
            "log another one too"
        )
    return tuple(notes)


def _samples(record: MeasuredRecord, dataset: Dataset) -> int:
    """How many numbers of a record can be fitted: gain and phase per frequency, or samples times outputs."""
    if isinstance(record.data, FrequencyResponse):
        return 2 * record.data.frequency.size
    data = record.data
    return sum(int(np.count_nonzero(np.isfinite(data[name]))) for name in dataset.columns(record, "output"))


def _outputs(record: MeasuredRecord, dataset: Dataset) -> Sequence[str]:
    if isinstance(record.data, FrequencyResponse):
        return (record.data.test.output,)
    return dataset.columns(record, "output")


def _still(dataset: Dataset, fitted: Sequence[MeasuredRecord], initial: str) -> Sequence[str]:
    """Notes on inputs that never move. Raises BadInput if no input moves and every log begins at rest."""
    if any(isinstance(record.data, FrequencyResponse) for record in fitted):
        return ()
    decays = any((record.initial or initial) == "estimate" for record in fitted)
    moves: dict[str, bool] = {}
    for record in fitted:
        assert isinstance(record.data, Record)
        for name in dataset.columns(record, "input"):
            moves[name] = moves.get(name, False) or bool(np.ptp(record.data[name]) > 0)
    still = [name for name, moved in moves.items() if not moved]
    if still and len(still) == len(moves) and not decays:
        raise BadInput(
            f"data set {dataset.name!r}: the input {', '.join(still)} is constant in every record to fit, so nothing "
            "is known of what moves; log a test that excites it"
        )
    return [f"the input {name} never moves in the records that were fitted" for name in still]
