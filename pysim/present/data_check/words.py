"""What a check of data found, in words, and what to type to cure it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np

from pysim.identify.data_check import Between, Finding, FindingCode, between_samples
from pysim.io import counted
from pysim.io.prepare import Step, call
from pysim.present.notes import listed
from pysim.types import UNITS, Dataset, Record

_WORDS: Mapping[FindingCode, str] = {
    FindingCode.NOT_IN_MODEL: (
        "the model has no {there}, so a fit will refuse it; rename it to one of {known}, or load the log without it"
    ),
    FindingCode.NOT_DRIVEN: (
        "no signal drives the model's input {signal}, which stays at {value:g} {unit}; name the column that does, "
        "or set its value: model.set({signal}=...)"
    ),
    FindingCode.EMPTY: "{signal} lacks {samples}, the first at {start:.6g} s",
    FindingCode.GAP: "{gaps} of {length:.3g} s after {start:.6g} s",
    FindingCode.QUANTITY: "{signal} is in {unit}, and the model counts it in {wanted}; {scaled}",
    FindingCode.SWAPPED: "{signal} and {other} seem to be swapped: each follows the model's answer for the other",
    FindingCode.SIGN: (
        "{signal} moves against the model's answer{where} (correlation {correlation:.2f}): a turned sign?"
    ),
    FindingCode.TURNED_INPUT: (
        "{outputs} move against the model's answer{where}, and with it if {signal} is turned: its sign?"
    ),
    FindingCode.FACTOR: "{signal} is about {factor:.4g} times the model's answer{where}: another unit?",
    FindingCode.CLIPPED: (
        "{samples} of {signal} at its smallest or largest value ({low:g}, {high:g} {unit}): clipped?"
    ),
    FindingCode.OUTLIERS: "{samples} of {signal} far off their neighbours, the first at {start:.6g} s",
    FindingCode.UNEVEN: "uneven sampling: the intervals vary by {jitter:.0f} percent",
    FindingCode.TOO_SHORT: "{rows} samples are too few; {least} are the least",
    FindingCode.SLOW_CLOCK: (
        '{rate:.3g} samples per second: if time is in ms, load it with units={{"time": "ms"}}, '
        'or write time_unit = "ms" below [dataset]'
    ),
    FindingCode.STILL: "{signal} stands still at {value:g} {unit}",
    FindingCode.FOLDED: (
        "{share:.0f} percent of the variance of {signal} lie above 80 percent of half the sampling rate: "
        "faster parts fold back"
    ),
    FindingCode.FEW_PERIODS: (
        "{periods:.2g} periods of {frequency:g} Hz: too few for a fit without the transient; two are the least"
    ),
    FindingCode.ALIASED: (
        "aliasing: {harmonic} x {frequency:g} Hz is beyond half the sampling rate, {rate:.4g} Hz, and folds back"
    ),
    FindingCode.NO_SINE: "no sine can be fitted to {signal}: {reason}",
    FindingCode.FREQUENCY: "{signal} swings at {value:.5g} Hz, not at {told:g} Hz",
    FindingCode.IMPURE: "{signal} is no pure sine: {share:.0f} percent are left over",
    FindingCode.LEVEL: "{what} of the logged {signal} is {value:.5g}, not {told:g} {unit} as specified",
}

_MEASURED = "by the model's answer one {unit} is {factor:.4g} {wanted}, and the sensor's data sheet knows better"
_KNOWN = "100 % are 1"
_OPEN = 'put how many {to} one {unit} is for the dots: data = data.scale("{signal}", ..., unit="{to}", of="{unit}")'
_SHARES = ("share", "jitter")  # shown in percent
_BETWEEN = {
    Between.HELD: "is taken as held between its samples",
    Between.HELD_AT_JUMPS: "is taken as held between its samples where it jumps",
    Between.SMOOTH: "stays for two samples or more after each change, and is taken as smooth",
}
_SHOWN = 4  # logs


def sentence(found: Finding) -> str:
    """What is found, without its log."""
    words: dict[str, float | str] = {"where": "", **found.values}
    if "logs" in words:
        words["where"] = f" in {words['logs']} alone"
    if "count" in words:
        words["samples"] = counted(int(words["count"]), "sample")
    if found.code is FindingCode.QUANTITY:
        words["to"] = words["wanted"] if words["wanted"] in UNITS else "1"
        words["scaled"] = (_MEASURED if "factor" in words else _KNOWN if found.cure else _OPEN).format(**words)
    if found.code is FindingCode.NOT_IN_MODEL:
        words["there"] = f"{words['signal']} that moves" if "still" in words else words["signal"]
    if found.code is FindingCode.GAP:
        count = int(words["count"])
        words["gaps"] = f"{count} gaps in time, the longest" if count > 1 else "a gap in time,"
    return _WORDS[found.code].format(**words | {key: 100 * float(words[key]) for key in _SHARES if key in words})


def lines(findings: Iterable[Finding]) -> tuple[str, ...]:
    """What to type in Python, one after the other."""
    return tuple(f"data = data.{call(step)}" for step in cures(findings))


def cures(findings: Iterable[Finding]) -> list[Step]:
    """The steps that cure them, each once: what is missing first, then what signals are."""
    order = list(FindingCode)
    ordered = sorted(findings, key=lambda found: order.index(found.code))
    steps = {call(step): step for found in ordered for step in found.cure}
    return list(steps.values())


def columns_words(logs: int, columns: int, first: str) -> str:
    """What to say of the columns of logs that are not described yet; `first` is one of the logs."""
    more = " Unless they are sines, the last log is not fitted but used to choose; a later table changes that."
    found = f"{counted(logs, 'log')}, {columns} columns, as {first} has them."
    return f"{found} A dash leaves a column out; the noise may be left empty.{more if logs > 1 else ''}"


def uses_words(uses: Iterable[str]) -> str:
    """What the uses of logs mean."""
    more = (
        "" if "validate" in uses else " No log is used to choose, so the fitted logs alone tell which model is better."
    )
    return (
        "A log used to choose is not fitted; it helps to tell which model is better. A held-out log only shows how "
        f"well the answer predicts. All others are fitted. Click a row to see it.{more}"
    )


def not_compared(dataset: Dataset) -> list[str]:
    """Outputs with empty cells, each with what becomes of them, in a sentence."""
    found = []
    for signal in dataset.signals:
        logs, count = list[str](), 0
        for record in dataset.logs():
            if signal.role == "output" and isinstance(record.data, Record) and signal.name in record.data.names:
                empty = int(np.count_nonzero(np.isnan(record.data[signal.name])))
                logs, count = ([*logs, record.source] if empty else logs), count + empty
        if count:
            more = [f"{len(logs) - _SHOWN} more"] if len(logs) > _SHOWN else []
            where, what = listed([*logs[:_SHOWN], *more]), "It is" if count == 1 else "They are"
            found.append(f"In {where}, {signal.name} lacks {counted(count, 'sample')}. {what} not compared.")
    return found


def assumed_between_samples(dataset: Dataset) -> list[tuple[str, str]]:
    """Inputs that jump or run in steps, each with what is assumed of it, in a sentence."""
    found = []
    for name, how, logs in between_samples(dataset):
        more = [f"{len(logs) - _SHOWN} more"] if len(logs) > _SHOWN else []
        found.append((name, f"In {listed([*logs[:_SHOWN], *more])}, {name} {_BETWEEN[how]}."))
    return found
