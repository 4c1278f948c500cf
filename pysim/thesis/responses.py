"""Table 4.1 as frequency responses, and as a data set that stands for the measurements."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from pysim.identify import TransferFunction, magnitude_db
from pysim.io import write_file
from pysim.thesis.printed import printed_table
from pysim.types import FrequencyResponse, SineTest

FREQUENCIES_HZ = (0.1, 0.2, 0.5, 1, 2, 3, 4, 5, 6, 8, 10, 12, 15, 18, 20, 22, 25, 28, 30)

NOTE = (
    "Transfer functions of thesis Table 4.1 stand for the measurements, which were not published. They are five-pole "
    "fits without dead time; their own misfit to the measurements (Table 4.4), 4 deg on average and 21 to 31 deg at "
    "most, is a systematic error of this reference. Negative offsets copy the positive ones: nine independent tests, "
    "not 18."
)

_HEAD = f"""[dataset]
name = "thesis-table-4-1"
description = "{NOTE}"
system = "pump"

[signals.alphaCMD]
role = "input"
unit = "%"
quantity = "swash plate angle command"

[signals.alphaPercent]
role = "output"
unit = "%"
quantity = "swash plate angle"
"""

_RECORD = """
[[records]]
file = "{file}"
columns = ["frequency_hz", "magnitude_db", "phase_deg"]
kind = "frequency-response-table"
offset = {offset}
amplitude = {amplitude}
use = "fit"
origin = "{origin}"
"""


def measured_responses(frequencies: Sequence[float] = FREQUENCIES_HZ) -> tuple[FrequencyResponse, ...]:
    """All 18 responses at the given frequencies (Hz), in the table's order.

    Source: thesis Eq. 4.1 and Table 4.1, whose column heads scale b0, a1 and a0 by 1e6 and a2 by 1e3.
    """
    return tuple(_response(row, np.asarray(frequencies, dtype=np.float64)) for row in printed_table("4.1"))


def loaded_responses(frequencies: Sequence[float] = FREQUENCIES_HZ) -> tuple[FrequencyResponse, ...]:
    """The two responses with an orifice as load, at 75 percent. Source: thesis Table 4.3, of the same form."""
    rows = printed_table("4.3")
    return tuple(_response(row, np.asarray(frequencies, dtype=np.float64), "Table 4.3") for row in rows)


def _response(row: dict[str, str], frequencies: np.ndarray, table: str = "Table 4.1") -> FrequencyResponse:
    b0, a4, a3, a2, a1, a0 = (float(row[k]) for k in ("b0_1e6", "a4", "a3", "a2_1e3", "a1_1e6", "a0_1e6"))
    function = TransferFunction((b0 * 1e6,), (1.0, a4, a3, a2 * 1e3, a1 * 1e6, a0 * 1e6))
    test = SineTest(float(row["offset_percent"]), float(row["amplitude_percent"]), "alphaCMD", "alphaPercent")
    return function.response(frequencies, test, origin=f"transfer function, thesis {table}")


def write_dataset(folder: Path, frequencies: Sequence[float] = FREQUENCIES_HZ) -> Path:
    """Write the table as a data set that `pysim.io.read_dataset` reads.

    Args:
        folder: made where it is missing; files of the same names are replaced.
        frequencies: Hz, increasing.
    Returns:
        the folder.
    """
    folder.mkdir(parents=True, exist_ok=True)
    records = []
    for response in measured_responses(frequencies):
        test = response.test
        name = f"O{test.offset:+g}_A{test.amplitude:g}.csv"
        rows = zip(response.frequency, magnitude_db(response, None), np.degrees(response.phase), strict=True)
        lines = [f"{f:g},{magnitude:.9f},{phase:.9f}" for f, magnitude, phase in rows]
        write_file(folder / name, "\n".join(["frequency_hz,magnitude_db,phase_deg", *lines, ""]))
        records.append(_RECORD.format(file=name, offset=test.offset, amplitude=test.amplitude, origin=response.origin))
    write_file(folder / "dataset.toml", _HEAD + "".join(records))
    return folder
