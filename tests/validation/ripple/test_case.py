"""What the case measures with: amplitudes over whole strokes, and the verdict of the FMUs."""

import numpy as np
import pytest

from validation.ripple.case import run
from validation.ripple.hose import STROKES, amplitude
from validation.ripple.relief import times


def test_record_is_a_whole_number_of_strokes() -> None:
    t = times()
    assert (t.size * (t[1] - t[0])) * STROKES == pytest.approx(87)
    assert t[-1] == pytest.approx(0.6 - (t[1] - t[0]))


def test_amplitude_of_a_rectified_sine() -> None:
    """4/3 pi of its height at the strokes' frequency, 4/15 pi at twice."""
    t = times()
    values = 3.0 + np.abs(np.sin(np.pi * STROKES * t + 0.4))
    assert amplitude(values, t) == pytest.approx(4 / (3 * np.pi), rel=2e-3)
    assert amplitude(values, t, 2 * STROKES) == pytest.approx(4 / (15 * np.pi), rel=1e-2)


@pytest.mark.slow
def test_every_claim_holds() -> None:
    failed = [str(finding) for finding in run() if not finding.holds]
    assert failed == []
