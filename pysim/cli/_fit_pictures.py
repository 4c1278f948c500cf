"""Pictures of a fit: its parameters, each log, and per operating point and signal the stepped sines."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from pysim.types import Dataset, Fit, RecordFit


def fit_pictures(result: Fit, datasets: Sequence[Dataset], folder: Path) -> list[tuple[str, bytes]]:
    """Written into the folder as PNG and SVG; captions with their SVG for the page."""
    from pysim.io import write_file
    from pysim.plot import render

    pictures = []
    for name, caption, figure in _figures(result, datasets):
        write_file(folder / f"{name}.png", render(figure, "png"))
        figure.set_layout_engine("none")  # found by the first drawing
        svg = render(figure, "svg")
        write_file(folder / f"{name}.svg", svg)
        pictures.append((caption, svg))
    return pictures


def _figures(result: Fit, datasets: Sequence[Dataset]) -> Iterator[tuple[str, str, Figure]]:
    """Name of the file, caption, figure."""
    from pysim.plot import fit_correlation_figure, fit_harmonics_figure, fit_parameters_figure, fit_record_figure

    yield "parameters", "Parameters between their bounds.", fit_parameters_figure(result)
    yield "correlation", "Correlations of the estimates.", fit_correlation_figure(result)
    several = len(datasets) > 1
    for i, record in enumerate(result.records):
        if not record.harmonics:
            of = f"{record.dataset}, " if several else ""
            caption = f"{of}{record.source} ({record.use}): measured, fitted, and what is left."
            yield f"record_{i}", caption, fit_record_figure(record)
    for i, (test, signal, records) in enumerate(_sines(result.records, datasets)):
        caption = f"Stepped sines, {signal} {test}: points measured, lines fitted; grey: 95 percent of noise."
        yield f"sines_{i}", caption, fit_harmonics_figure(records, test, signal)


def _sines(records: Sequence[RecordFit], datasets: Sequence[Dataset]) -> list[tuple[str, str, list[RecordFit]]]:
    """Stepped sines that belong on one picture: operating point in words, signal, records."""
    found: dict[tuple[str, str], list[RecordFit]] = {}
    for record, test in zip(records, _tests(records, datasets), strict=True):
        for harmonics in record.harmonics:
            found.setdefault((test, harmonics.signal), []).append(record)
    return [(test, signal, own) for (test, signal), own in found.items()]


def _tests(records: Sequence[RecordFit], datasets: Sequence[Dataset]) -> list[str]:
    """What the data sets say of each record: where it was measured, and whose command swings how."""
    from pysim.io import shown_value

    words = [f"of {Path(record.source).parent.as_posix()}" for record in records]
    for k, record in enumerate(records):
        own = [one for one in datasets if one.name == record.dataset]
        test = own[0].logs()[record.index] if len(own) == 1 else None
        if test is not None and test.command and test.offset is not None and test.amplitude is not None:
            unit = own[0].signal(test.command).unit
            around, swing = shown_value(test.offset, unit), shown_value(test.amplitude, unit)
            words[k] = f"at {test.command} {around}, amplitude {swing}"
    several = len(datasets) > 1
    return [f"{word} ({record.dataset})" if several else word for word, record in zip(words, records, strict=True)]
