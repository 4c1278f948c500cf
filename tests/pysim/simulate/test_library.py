import dataclasses
import zipfile

import numpy as np
import pytest

from pysim.io import load_library, read_model
from pysim.simulate import Rk4, Rk45, Rodas, simulate, simulate_many
from pysim.simulate._library import open_library
from pysim.simulate._run import run
from pysim.simulate.kernel.layout import ERROR, FATAL, OK
from pysim.types import BadInput, Experiment, Outcome
from tests.pysim.simulate.fixture_fmus import BALL, CLOCK, FRAGILE, OSCILLATOR, STIFF


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
            assert one.component != other.component
        with library.instance() as again:
            assert again in (one, other)


def test_each_run_starts_from_the_models_own_values(fixture_model):
    model, ends = fixture_model(OSCILLATOR), np.array([0.0])
    simulate(model, Experiment(ends, ("x", "w"), overrides={"x": 9.0, "w": 7.0}))
    record = simulate(model, Experiment(ends, ("x", "w")))
    np.testing.assert_array_equal(record.values, [[0.0, 2.0]])
    assert record.outcome is Outcome.DONE


@pytest.mark.parametrize("fmi", [2, 3])
@pytest.mark.parametrize("solver", [Rk45(), Rodas(), Rk4(0.01)], ids=lambda solver: type(solver).__name__)
@pytest.mark.parametrize("fixture", [OSCILLATOR, BALL, CLOCK, STIFF], ids=lambda fixture: fixture.source)
def test_a_used_instance_gives_what_a_new_one_gives_bit_for_bit(fixture_model, fixture, solver, fmi):
    model, state = fixture_model(fixture, fmi), fixture.states[0]
    plain = Experiment(np.linspace(0, 1, 11), fixture.states)
    other = Experiment(np.linspace(0.5, 2, 7), (state,), overrides={state: 0.7, fixture.parameters[0][0]: 0.4})
    alone = simulate(model, plain, solver=solver, check=False)  # Rk4 fails for the stiff one, each time alike
    with open_library(model) as library:
        for before in (other, dataclasses.replace(plain, overrides={state: np.pi}), plain):
            run(library, before, solver)
            record = run(library, plain, solver)
            np.testing.assert_array_equal(record.values, alone.values)
            assert record.statistics == alone.statistics


@pytest.mark.parametrize("fmi", [2, 3])
def test_an_instance_is_reset_or_instantiated_anew(fixture_model, fmi):
    with open_library(fixture_model(OSCILLATOR, fmi)) as library:
        for _ in range(3):
            with library.instance() as instance:
                before = instance.component
                library_of = instance
        with library.instance() as instance:
            assert instance is library_of
            assert instance.component == before or fmi == 3
            assert instance.record.record["refuses_reset"][0] == (fmi == 3)  # the fixtures can be reset in FMI 2 only


@pytest.mark.parametrize("fmi", [2, 3])
@pytest.mark.parametrize("cause", [{"refuse": 1.0}, {"manner": 2.0}, {"manner": 1.0}])
def test_a_failed_run_leaves_nothing_behind(fixture_model, fmi, cause):
    model = fixture_model(FRAGILE, fmi)
    good, bad = (Experiment(np.array([0.0, end]), ("x",), overrides=o) for end, o in ((1.0, {}), (3.0, cause)))
    with open_library(model) as library:
        assert run(library, bad, Rk45()).outcome is not Outcome.DONE
        record = run(library, good, Rk45())
    assert record.message == ""
    np.testing.assert_array_equal(record.values, simulate(model, good).values)


@pytest.mark.parametrize("fmi", [2, 3])
def test_an_fmu_that_cannot_be_instantiated_is_one_error_before_the_runs(fixture_model, fmi):
    model = dataclasses.replace(fixture_model(OSCILLATOR, fmi), token="of another build")
    experiment = Experiment(np.ones(1), ("x",))
    with pytest.raises(BadInput, match=r"oscillator_\d\.fmu: the FMU could not be instantiated.*; export it again"):
        simulate_many(model, [experiment] * 3)
    with pytest.raises(BadInput, match="could not be instantiated"):
        simulate(model, experiment, check=False)


@pytest.fixture
def libraries(monkeypatch):
    """Libraries loaded, and those unloaded."""
    loaded, freed = [], []

    def load(*arguments):
        fmu = load_library(*arguments)
        free, fmu.freeLibrary = fmu.freeLibrary, lambda: (free(), freed.append(fmu))
        loaded.append(fmu)
        return fmu

    monkeypatch.setattr("pysim.simulate._library.load_library", load)
    return loaded, freed


@pytest.mark.parametrize("fmi", [2, 3])
@pytest.mark.parametrize("status", [OK, ERROR, FATAL])
def test_each_library_is_unloaded_once_unless_it_failed_for_good(fixture_model, libraries, fmi, status):
    loaded, freed = libraries
    with open_library(fixture_model(OSCILLATOR, fmi)) as library:
        with library.instance() as instance:
            instance.status = status
        assert freed == []
        with library.instance():
            pass
    assert len(loaded) == (2 if status == FATAL else 1)
    assert freed == (loaded[1:] if status == FATAL else loaded)


@pytest.mark.parametrize("fmi", [2, 3])
def test_a_library_that_makes_no_instance_is_unloaded(fixture_model, libraries, fmi):
    loaded, freed = libraries
    model = dataclasses.replace(fixture_model(OSCILLATOR, fmi), token="of another build")
    with pytest.raises(BadInput, match="could not be instantiated"), open_library(model):
        pass
    assert len(loaded) == 1
    assert freed == loaded
