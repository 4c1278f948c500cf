"""Pictures of a fit stand under the operating points that were measured."""

from dataclasses import replace

import numpy as np

from pysim.present.fit import Fitted, figures
from pysim.types import Dataset, Fit, MeasuredRecord, MeasuredSignal, Record
from tests.pysim.fits import small_fit

SIGNALS = (MeasuredSignal("w", "input", "Pa", "", "w"), MeasuredSignal("y", "output", "%", "", "y"))


def sine(source: str, frequency: float, offset: float | None) -> MeasuredRecord:
    log = Record(np.arange(2.0), np.zeros((2, 2)), ("w", "y"), ("Pa", "%"))
    return MeasuredRecord(source, "frequency-response", "fit", log, offset, 1e5, frequency, command="w")


WAVE = replace(sine("wave.txt", 1.0, None), kind="stochastic", use="validate", amplitude=None, frequency=None)


def captions(fit: Fit, *records: MeasuredRecord) -> list[str]:
    """Of its stepped sines, without what all of them say."""
    told = figures(Fitted(fit, (Dataset("set", "-", "-", SIGNALS, records),)))
    found = (one.caption.partition(":")[0] for one in told if one.caption.startswith("Stepped sines"))
    return [caption.removeprefix("Stepped sines, ") for caption in found]


def test_sines_of_one_test_stand_together() -> None:
    records = [sine(f"O+25/{f:g}Hz.txt", f, 2e5) for f in (1.0, 5.0)]
    assert captions(small_fit(), *records, WAVE) == ["y at w 2 bar, amplitude 1 bar"]
    records = [sine(f"O+25/{f:g}Hz.txt", f, None) for f in (1.0, 5.0)]
    assert captions(small_fit(), *records, WAVE) == ["y of O+25"]  # the data set does not say


def test_sines_of_one_file_stand_under_their_own_test() -> None:
    fit = small_fit()
    fit = replace(fit, records=tuple(replace(r, source="a.tdms") if r.harmonics else r for r in fit.records))
    found = captions(fit, sine("a.tdms", 1.0, 2e5), sine("a.tdms", 5.0, 4e5), WAVE)
    assert found == ["y at w 2 bar, amplitude 1 bar", "y at w 4 bar, amplitude 1 bar"]
