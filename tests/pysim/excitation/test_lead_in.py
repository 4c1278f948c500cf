import numpy as np
import pytest

from pysim.excitation import Chirp, Excitation, LeadIn, LineGrid, Multisine, PiersonMoskowitz, Step, StochasticWave
from pysim.excitation import SteppedSineCommand as Sine
from pysim.types import BadInput, Signal

GRID = LineGrid(2.0, 0.5, 10.0)
FAMILY = [
    Sine(50.0, 10.0, 3.0, periods=7.3),
    Chirp(-50.0, 10.0, 0.1, 30.0, 20.0),
    Step(20.0, -30.0, 2.0, back=True),
    StochasticWave(PiersonMoskowitz(100.0, 1.0), 20.0, seed=3, offset=5.0),
    Multisine(GRID, seed=1, rms=5.0, offset=50.0),
]


@pytest.mark.parametrize("test", FAMILY, ids=lambda test: type(test).__name__)
class TestFamily:
    def test_leads_in_and_out_as_the_thesis_does(self, test: Excitation) -> None:
        signal = test.signal()
        offset = test.offset  # type: ignore[attr-defined]
        assert test.onset == 2.0
        assert test.duration == pytest.approx(test.end + 0.5)
        np.testing.assert_allclose(signal.value(np.array([0.0, 0.5, 0.75, 1.0])), [0, 0, offset / 2, offset], atol=1e-9)
        assert signal.value(np.array([test.duration + 1e-9, test.duration + 5.0])) == pytest.approx([0.0, 0.0])
        last, half = signal.value(np.array([test.end - 1e-9, test.end + 0.25]))
        assert half == pytest.approx(last / 2, abs=1e-5)

    def test_derivative_is_the_limit_of_differences(self, test: Excitation) -> None:
        signal = test.signal()
        t = np.random.default_rng(0).uniform(test.onset, test.end, 200)
        h = 1e-6
        keep = np.min(np.abs(t[:, None] - signal.starts), axis=1) > 2 * h
        central = (signal.value(t + h) - signal.value(t - h)) / (2 * h)
        # third derivative times h^2/6, and rounding of values up to 100 by h
        np.testing.assert_allclose(central[keep], signal.derivative(t)[keep], atol=2e-6 * 100)

    def test_only_a_step_jumps(self, test: Excitation) -> None:
        jumps, _ = test.signal().breaks()
        assert jumps.sum() == (2 if isinstance(test, Step) else 0)

    def test_nothing_in_it_is_faster_than_it_says(self, test: Excitation) -> None:
        amplitude, _, omega, kappa = np.moveaxis(test.signal().sines, -1, 0)
        ends = np.abs([omega, omega + kappa * (test.end - test.onset)]).max(axis=0)
        fastest = float(np.max(ends[amplitude != 0] / (2 * np.pi), initial=0.0))
        assert 0.98 * test.highest_hz <= fastest <= test.highest_hz * (1 + 1e-9)


def test_without_a_lead_in_the_excitation_starts_at_once_and_holds_its_last_value() -> None:
    signal = Sine(5.0, 2.0, 1.0, periods=1.25, lead=LeadIn.none()).signal()
    np.testing.assert_allclose(signal.value(np.array([0.0, 0.25, 1.25, 9.0])), [5.0, 7.0, 7.0, 7.0])


def test_pieces_of_no_length_are_left_out() -> None:
    body = Signal.constant(3.0)
    assert LeadIn.none().around(3.0, body, end=1.0).starts.tolist() == [0.0, 1.0]
    shifted = Signal.steps([2.0], [3.0])
    assert LeadIn(rest=2.0, ramp=0.0, hold=0.0).around(3.0, shifted).starts.tolist() == [0.0, 2.0]


def test_refuses_what_cannot_be_led_to() -> None:
    with pytest.raises(BadInput, match=r"lead-in: hold is -1 s; it must be finite and not negative"):
        LeadIn(hold=-1.0)
    with pytest.raises(BadInput, match="starts at 0 s, not at 2 s"):
        LeadIn().around(3.0, Signal.constant(3.0))
    with pytest.raises(BadInput, match="its end at 1 s is not behind its start at 2 s"):
        LeadIn().around(3.0, Signal.steps([2.0], [3.0]), end=1.0)
