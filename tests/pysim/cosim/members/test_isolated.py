import os
import signal
import sys
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from pysim.cosim import MemberFailed, System, cosimulate
from pysim.cosim.members import Fmu, Isolated
from pysim.cosim.members.isolated import how_it_ended
from pysim.io import read_model
from pysim.types import BadInput, Experiment, Model, Outcome, Port
from tests.cosim_parts import Linear
from tests.pysim.cosim.members.driving import driven
from tests.pysim.simulate.fixture_fmus import FRAGILE, build
from tests.pysim.simulate.text_models import LAG, text_model


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("isolated")


@pytest.fixture(scope="module")
def fragile(folder: Path) -> Model:
    return read_model(build(FRAGILE, 2, folder))


def test_in_a_process_of_its_own_it_does_the_same_bit_for_bit(folder: Path) -> None:
    own, other = (Fmu("lag", text_model(LAG, folder), parameters={"K": 3.0}) for _ in range(2))
    u = np.sin(np.arange(12.0))
    with driven(own, T=0.4) as here, driven(Isolated(other), T=0.4) as there:
        assert there.rows("y", u) == here.rows("y", u)
        states = [there.member.save() for _ in range(3)]
        states[1] = there.member.save(states[1])
        first = there.rows("y", u)
        del states[0]
        states.append(there.member.save())
        there.member.restore(states[0])
        there.time = here.time
        assert there.rows("y", u) == first
        there.give(u=2.0)
        there.member.update()
        assert there["power"] == pytest.approx(3.0 * 2.0 * there["y"], abs=1e-12)


@pytest.mark.skipif(sys.platform == "win32", reason="signals have other names there")
def test_a_crash_is_an_error_message_with_name_and_time(fragile: Model) -> None:
    system = System((Isolated(Fmu("tank", fragile, parameters={"manner": 4.0})),))
    record = cosimulate(system, Experiment(np.arange(31) * 0.1, ("tank.root",)), step=0.1, check=False)
    assert record.outcome is Outcome.MODEL_ERROR
    assert record.message == "t = 1.9 s: tank: its process crashed (SIGSEGV)"
    s, small = record["tank.root"], 1e-3  # up to there ds/dt = -(s + small)/(2 s)
    np.testing.assert_allclose(record.time, 2 * (1 - s - small * np.log((1 + small) / (s + small))), atol=1e-4)


def test_a_step_that_never_ends_is_ended(fragile: Model) -> None:
    with driven(Isolated(Fmu("root", fragile), time_limit=1.0), step=1.0, manner=5.0) as run:
        run.go()
        with pytest.raises(MemberFailed, match="did not answer within 1 s and was ended"):
            _go_twice(run)


def _go_twice(run) -> None:  # type: ignore[no-untyped-def]
    """At 2 s the root's argument is zero."""
    run.go()
    run.go()


@pytest.fixture(scope="module")
def member(fragile: Model) -> Isolated:
    return Isolated(Fmu("root", fragile))


def test_closing_ends_the_process(member: Isolated) -> None:
    with driven(member, step=1.0) as run:
        number = member._process.pid
        run.go()
        assert run["root"] == pytest.approx(0.5, abs=2e-3)
    if os.name == "posix":
        with pytest.raises(ProcessLookupError):
            os.kill(number, signal.SIGTERM)
    with pytest.raises(BadInput, match="has not been started"):
        member.update()


def test_a_closed_one_starts_anew_and_what_it_says_of_itself_comes_through(member: Isolated) -> None:
    with driven(member, step=1.0, manner=2.0) as run:
        run.go()
        with pytest.raises(MemberFailed, match="root of a negative number"):
            _go_twice(run)


def test_the_exit_status_of_a_process_is_read_as_its_system_means_it() -> None:
    assert how_it_ended(-11) == "crashed (SIGSEGV)"
    assert how_it_ended(3) == "ended by itself with code 3"
    assert how_it_ended(0xC0000005) == "ended by itself with code 0xc0000005"


def test_what_cannot_be_isolated(fragile: Model) -> None:
    member = Fmu("root", fragile)
    with pytest.raises(BadInput, match="time limit is 0 s; give a positive one"):
        Isolated(member, time_limit=0.0)
    member.solver = lambda: None  # type: ignore[assignment]
    with pytest.raises(BadInput, match="root cannot be sent to another process"):
        Isolated(member)


@pytest.mark.parametrize(
    ("module", "why"),
    [("__main__", r"Mine is a class of __main__"), ("only_here", r"No module named 'only_here'")],
)
def test_a_class_that_another_process_does_not_have(module: str, why: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, module, ModuleType(module))
    mine = type("Mine", (Linear,), {"__module__": module})
    monkeypatch.setattr(sys.modules[module], "Mine", mine, raising=False)
    member = mine("m", (), (Port("y"),), A=[[0.0]], B=np.zeros((1, 0)), C=[[1.0]])
    words = rf"^m cannot be sent to another process \({why}\); make its class one of a module$"
    with pytest.raises(BadInput, match=words):
        cosimulate(System((Isolated(member),)), Experiment(np.arange(3) * 0.1, ("m.y",)), step=0.1)
