"""The published responses with the uncertainty that their own misfit gives them."""

from __future__ import annotations

import math
import tempfile
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from pysim.io import read_dataset
from pysim.thesis import published_deviations, write_dataset
from pysim.types import Dataset, FrequencyResponse

# Mean size of normal errors over their standard deviation.
_MEAN_SIZE = math.sqrt(2 / math.pi)


def reference(amplitudes: Sequence[float] = (5.0, 10.0, 20.0)) -> Dataset:
    """The nine independent responses of Table 4.1 (negative offsets copy the positive ones).

    What Table 4.4 says of the transfer functions' own mean misfit is taken as the standard deviation of gain and phase
    at every frequency. That is a size, not a distribution: the misfit of a five-pole fit without dead time is smooth
    over frequency, so that errors at neighbouring frequencies are one error.
    """
    with tempfile.TemporaryDirectory() as folder:
        dataset = read_dataset(write_dataset(Path(folder)))
    misfit = {(row.offset, row.amplitude): row.values for row in published_deviations("4.4")}
    records = []
    for record in dataset.records:
        assert isinstance(record.data, FrequencyResponse)
        test = record.data.test
        if test.offset > 0 and test.amplitude in amplitudes:
            mean_db, _, mean_deg, _ = misfit[test.offset, test.amplitude]
            records.append(replace(record, data=_with_errors(record.data, mean_db, mean_deg)))
    return replace(dataset, records=tuple(records))


def _with_errors(response: FrequencyResponse, mean_db: float, mean_deg: float) -> FrequencyResponse:
    covariance = np.zeros((response.frequency.size, 3, 3))
    amplitude = response.gain * response.test.amplitude
    covariance[:, 0, 0] = (amplitude * math.log(10) / 20 * mean_db / _MEAN_SIZE) ** 2
    covariance[:, 1, 1] = math.radians(mean_deg / _MEAN_SIZE) ** 2
    return replace(response, covariance=covariance)
