import dataclasses
import zipfile

import numpy as np
import pytest

from pysim.io import read_model
from pysim.simulate import simulate
from pysim.simulate._library import open_library
from pysim.types import BadInput, Experiment, Outcome
from tests.pysim.simulate.fixture_fmus import OSCILLATOR


def test_binary_for_another_machine_is_named(fixture_model, tmp_path):
    path = tmp_path / "other.fmu"
    with zipfile.ZipFile(fixture_model(OSCILLATOR).path) as archive, zipfile.ZipFile(path, "w") as other:
        other.writestr("modelDescription.xml", archive.read("modelDescription.xml"))
        other.writestr("binaries/amiga/oscillator.library", "")
    with pytest.raises(BadInput, match=r"other\.fmu has no binary for .* \(it has: amiga\)"):
        simulate(read_model(path), Experiment(np.array([1.0]), ("x",)))


def test_co_simulation_alone_is_refused(fixture_model):
    model = fixture_model(OSCILLATOR)
    other = dataclasses.replace(model, abilities=dataclasses.replace(model.abilities, model_exchange=False))
    with pytest.raises(BadInput, match="is for co-simulation only"):
        simulate(other, Experiment(np.array([1.0]), ("x",)))


@pytest.mark.parametrize("fmi", [2, 3])
def test_instances_are_apart_and_the_library_is_used_again(fixture_model, fmi):
    with open_library(fixture_model(OSCILLATOR, fmi)) as library:
        with library.instance() as one, library.instance() as other:
            assert one.fmu.component != other.fmu.component
            assert one.fmu is not other.fmu
            first = {one.fmu, other.fmu}
        with library.instance() as again:
            assert again.fmu in first


def test_each_run_starts_from_the_models_own_values(fixture_model):
    model, ends = fixture_model(OSCILLATOR), np.array([0.0])
    simulate(model, Experiment(ends, ("x", "w"), overrides={"x": 9.0, "w": 7.0}))
    record = simulate(model, Experiment(ends, ("x", "w")))
    np.testing.assert_array_equal(record.values, [[0.0, 2.0]])
    assert record.outcome is Outcome.DONE
