"""Chirp analysis: tops and bottoms of the output relative to those of the command (thesis Eq. 2.15-2.21)."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from pysim.identify.chirp._extremes import apart_ones, extremes, paired_ones, samples_of, seen_ones
from pysim.identify.chirp.branch import Branch, mean_branch
from pysim.identify.chirp.cycle_fit import Extreme, Samples
from pysim.identify.chirp.result import ChirpAnalysis
from pysim.identify.columns import declared_noise, the_column
from pysim.identify.logged import LoggedWave, logged_wave
from pysim.io.prepare import refuse_missing_in
from pysim.types import BadInput, Dataset, MeasuredRecord, Record
from pysim.types.note import Note, NoteCode
from pysim.types.record_kind import CHIRP

Array = NDArray[np.float64]


def analyse_chirp(
    record: MeasuredRecord, input_: str, output: str, *, level: float | None = None, noise: float | None = None
) -> ChirpAnalysis:
    """Find tops and bottoms of the output, and compare each with that of the command which caused it.

    Around each extreme, one or more turns of the output are fitted by harmonics of the command's angle, the first of
    which may drift; the fitted curve's extreme is used, not a single sample. The extreme of the command that belongs to
    it follows from the phase, which is tracked from the lowest frequency upwards.

    Args:
        record: of kind "chirp"; a log over time.
        input_, output: names of the columns.
        level: reference from which tops and bottoms count, in the output's unit; None takes the command's offset,
            which requires the same unit for output and command, as in the thesis.
        noise: standard deviation of the output's noise if known; it counts where the residual of the fits is smaller.
    Raises:
        BadInput: a command that is no chirp, no level for different units, or an output without a pair of extremes.
    Source: thesis Section 2.5. Differs: the level is subtracted (Eq. 2.15 and 2.16 omit the offset); extremes of
    fitted curves replace the highest samples.
    """
    if record.kind != CHIRP.name:
        raise BadInput(f'{record.source}: its kind is "{record.kind}"; chirp analysis needs a "{CHIRP.name}"')
    command = logged_wave(record, input_)
    assert isinstance(record.data, Record)  # logged_wave has refused anything else
    level = _level(record.data, command, input_, output) if level is None else level
    samples = samples_of(record.data, command, output)
    pairs = list(extremes(samples, command))
    if not pairs:
        raise BadInput(f"{record.source}: {output} shows no top or bottom within the sweep; record more periods")
    fitted = np.array([[fit.squares, fit.freedom] for _, _, fit in pairs])
    left_over = float(np.sqrt(np.median(fitted[:, 0] / fitted[:, 1])))
    spread = left_over if noise is None else max(noise, left_over)
    seen, notes = seen_ones(pairs, level, spread, command)
    paired = paired_ones(seen, 1 if command.rate >= 0 else -1)
    if not paired:
        raise BadInput(f"{record.source}: no pair of top and bottom of {output} rises above the noise; swing more")
    top, bottom = (
        _branch([(pair[parity], seen[pair[parity]]) for pair in paired], command, level, spread, sign)
        for parity, sign in ((0, 1), (1, -1))
    )
    return ChirpAnalysis(
        source=record.source,
        command=command,
        level=level,
        top=top,
        bottom=bottom,
        mean=mean_branch(top, bottom),
        apart=apart_ones(paired, {number: fit.half for number, _, fit in pairs}),
        noise=spread,
        input=input_,
        output=output,
        input_unit=record.data.units[record.data.names.index(input_)],
        output_unit=record.data.units[record.data.names.index(output)],
        notes=(*notes, *_edges(command, samples)),
    )


def chirp_responses(
    dataset: Dataset, *, output: str | None = None, level: float | None = None
) -> tuple[ChirpAnalysis, ...]:
    """Analyse every log of kind "chirp".

    Args:
        output: the output signal; may be left out if the logs have only one.
        level: as for `analyse_chirp`.
    Raises:
        BadInput: no such logs, no unique input or output, or a log that `analyse_chirp` rejects.
    """
    found = []
    for record in dataset.records:
        if record.kind == CHIRP.name and isinstance(record.data, Record):
            input_, name = the_column(dataset, record, "input"), the_column(dataset, record, "output", output)
            refuse_missing_in(dataset, record, record.data, (input_, name))
            noise = declared_noise(dataset, name)
            found.append(analyse_chirp(record, input_, name, level=level, noise=noise))
    if not found:
        raise BadInput(f'data set {dataset.name!r} has no log of kind "{CHIRP.name}"; give its chirps that kind')
    return tuple(found)


def _level(data: Record, command: LoggedWave, input_: str, output: str) -> float:
    """The command's offset, if command and output have the same unit."""
    units = [data.units[data.names.index(name)] for name in (input_, output)]
    if units[0] != units[1]:
        raise BadInput(
            f"chirp analysis: {output} is in {units[1]} and {input_} in {units[0]}; give the level that {output} has at"
            f" the command's offset of {command.offset:.4g} {units[0]}"
        )
    return command.offset


def _branch(extremes: list[tuple[int, Extreme]], command: LoggedWave, level: float, noise: float, sign: int) -> Branch:
    """Gain by Eq. 2.15 or 2.16, less the level and the bias by noise (`Extreme.lift`); phase by Eq. 2.18 or 2.19."""
    angle = np.array([(number + 0.5) * np.pi for number, _ in extremes])
    answered = np.array([extreme.angle for _, extreme in extremes])
    caused = command.time_of(angle)
    frequency = command.frequency_at(caused)
    lag = command.time_of(answered) - caused
    height = sign * (np.array([e.value for _, e in extremes]) - level)
    lift = noise**2 * np.array([e.lift for _, e in extremes])
    gain = (height - np.minimum(lift, 0.5 * height)) / command.amplitude  # the lift is right for small noise only
    turned = frequency / command.frequency_at(
        caused + lag
    )  # from the command's angle at the answer to that of Eq. 2.18
    return Branch(
        frequency=frequency,
        gain=gain,
        phase=-2 * np.pi * lag * frequency,
        gain_deviation=noise / command.amplitude * np.array([e.value_deviation for _, e in extremes]),
        phase_deviation=noise * turned * np.array([e.angle_deviation for _, e in extremes]),
    )


def _edges(command: LoggedWave, samples: Samples) -> Iterator[Note]:
    """Notes on a sweep that is too fast at its low end, and on too few samples per period at its high end."""
    low = float(np.min(command.frequency_at(np.array([command.start, command.end]))))
    turn = np.sqrt(max(low, 0.0) ** 2 + 2 * abs(command.rate))  # frequency one turn after the low end
    if turn > 1.5 * low:
        yield Note(NoteCode.FAST_SWEEP, {"frequency": float(turn)})
    fewest = float(samples.per_turn.min())
    if fewest < 6:
        yield Note(NoteCode.FEW_SAMPLES, {"samples": fewest})
