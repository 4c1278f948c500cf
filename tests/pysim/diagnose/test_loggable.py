import numpy as np
import pytest

from fmu_build import build
from pysim.diagnose.candidate_tests import CandidateTest, candidate_tests
from pysim.diagnose.fitted import Fitted
from pysim.diagnose.loggable import loggable
from pysim.diagnose.residuals import Ruler
from pysim.diagnose.subject import Subject, extended, subject
from pysim.io import read_model
from pysim.simulate import Rodas, simulate
from pysim.types import Dataset, Experiment, MeasuredSignal, Signal
from tests.pysim.diagnose.bench import HOLD
from tests.pysim.diagnose.toy import BENCH, NOISE

PLANT = """
package Within
  model Mass "With numbers of its own that no sensor could be put to"
    parameter Real k(unit="N/m", min=1, max=100, nominal=10) = 20;
    input Real F(unit="N", start=0);
    output Real x(unit="m", start=0, fixed=true);
    output Real v(unit="m/s", start=0, fixed=true);
    Real p(unit="Pa", start=0, fixed=true) "Pressure behind a throttle";
    Real share(unit="%", start=0, fixed=true) "Of a controller";
    Real plain(start=0, fixed=true) "Of a filter";
    Real third(unit="m", start=0, fixed=true) "Of the way";
    Real nothing(unit="Pa", start=0, fixed=true) "Round-off";
  equation
    der(x) = v;
    der(v) = F - 0.8*v - k*x;
    der(p) = 1e5*v - 3*p;
    der(share) = 100*x - share;
    der(plain) = x - plain;
    der(third) = v/3;
    der(nothing) = 1e5*(x - 3*third) - nothing;
  end Mass;
end Within;
"""


@pytest.fixture(scope="module")
def own(tmp_path_factory: pytest.TempPathFactory) -> Subject:
    library = tmp_path_factory.mktemp("library") / "Within.mo"
    library.write_text(PLANT)
    model = read_model(build("Within.Mass", libraries=[library]))
    rng = np.random.default_rng(1)
    knots = np.arange(0.0, 6.01, 0.4)
    command = Signal.through(knots, np.r_[0.0, 6 * rng.standard_normal(knots.size - 1)])
    times = np.arange(0.0, 6.0, 0.02)
    run = Experiment(times, ("x",), {"F": command}, start=-HOLD)
    clean = simulate(model, run, solver=Rodas(rtol=1e-8, atol=1e-8))["x"]
    data = BENCH.dataset(BENCH.log(times, command, clean, rng, source="a.txt", use="fit", noise=NOISE))
    return subject(model, data, [], None)


def asked(own: Subject) -> tuple[Dataset, Fitted, tuple[CandidateTest, ...]]:
    what = extended(own, [])
    ruler = Ruler(own.targets)
    assert own.dataset is not None
    tests = candidate_tests(own.dataset, lambda run: 5.0, own.model)[:4]
    return own.dataset, Fitted(what, ruler.evaluation(what, what.space.to_search(what.space.start))), tests


def test_outputs_and_states_of_physical_units_can_be_logged(own: Subject) -> None:
    dataset, fitted, tests = asked(own)
    found = loggable(own, dataset, (fitted, fitted), tests, None)
    assert [(s.name, s.unit) for s in found.outputs] == [("v", "m/s")]
    assert [(s.name, s.unit) for s in found.states] == [("p", "Pa"), ("third", "m")]


def test_noise_is_a_thousandth_of_what_a_signal_goes_through(own: Subject) -> None:
    dataset, fitted, tests = asked(own)
    (speed,) = loggable(own, dataset, (fitted, fitted), tests, 1).outputs
    runs = [simulate(own.model, t.experiment(own.model, ("v",), {}), solver=Rodas(rtol=1e-9, atol=1e-9)) for t in tests]
    assert speed.noise == pytest.approx(1e-3 * np.ptp(np.concatenate([run["v"] for run in runs])), rel=1e-3)


def test_what_is_logged_already_is_not_asked_for(own: Subject) -> None:
    dataset, fitted, tests = asked(own)
    signals = (*dataset.signals, MeasuredSignal("speed", "output", "m/s", "", "v"))
    more = Dataset(dataset.name, dataset.description, dataset.system, signals, dataset.records)
    assert loggable(own, more, (fitted, fitted), tests, None).outputs == ()
