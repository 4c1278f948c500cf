import pytest

import fmu_build
from pysim.io import read_model
from validation.benchmarks.native_loop import LIMIT, benchmark, experiments
from validation.thesis import FREQUENCIES_HZ


def test_it_is_the_eighteen_tests_at_every_frequency():
    runs = experiments()
    assert len(runs) == 18 * len(FREQUENCIES_HZ) == 342
    assert len({tuple(run.overrides.items()) for run in runs}) == 342


@pytest.mark.slow
def test_both_sides_hold_the_limit_and_the_native_loop_is_faster():
    model = read_model(fmu_build.build("HydraulicTestBench.Examples.SteppedSine"))
    result = benchmark(model, experiments()[10::60])
    assert max(result.native_rms, result.cvode_rms) <= LIMIT
    assert result.ratio > 1  # how much is for the whole benchmark on a quiet machine to say
