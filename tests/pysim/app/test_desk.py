"""What all pages share: the newest reading of the data counts, and the newest model."""

import asyncio
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

import pysim.app.desk
from fmu_build.pack import compiler
from pysim.app.desk import Desk, Loaded
from pysim.app.jobs import Runner
from pysim.app.project import Project
from pysim.app.upload import Limits
from tests.pysim.app.code_tasks import CODE


@pytest.mark.parametrize("order", [(0, 1), (1, 0)])
def test_an_earlier_reading_that_ends_later_does_not_count(
    order: tuple[int, int], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    project = Project.at(tmp_path)
    desk = Desk(project, Runner(project, 60.0), Limits())

    async def story() -> None:
        readings: list[asyncio.Future[Loaded]] = []

        async def reads(_: Callable[..., object], *__: object) -> Loaded:
            readings.append(asyncio.get_running_loop().create_future())
            return await readings[-1]

        monkeypatch.setattr(pysim.app.desk.run, "io_bound", reads)
        both = [asyncio.create_task(desk.read_data()) for _ in range(2)]
        await asyncio.sleep(0)
        for k in order:
            readings[k].set_result(Loaded(None, trouble=f"reading {k}"))
            await both[k]

    asyncio.run(story())
    assert desk.loaded is not None
    assert desk.loaded.trouble == "reading 1"


@pytest.fixture
def modelled(tmp_path: Path) -> Iterator[Desk]:
    """With a worker that opens a model by its name alone."""
    project = Project.at(tmp_path / "project")
    one = Desk(project, Runner(project, 60.0, CODE), Limits())
    yield one
    one.runner.close()


@pytest.mark.parametrize("by", ["Quick", ""])
def test_a_slow_build_that_is_overtaken_is_ended_and_thrown_away(by: str, modelled: Desk) -> None:
    async def both() -> None:
        modelled.project.change(model="Slow")
        first = asyncio.create_task(modelled.read_model())
        await asyncio.sleep(0.2)
        modelled.project.change(model=by)
        await modelled.read_model()
        assert not modelled.model_busy
        await first

    asyncio.run(both())
    assert (modelled.model or {}).get("name", "") == by
    assert (modelled.model_trouble, modelled.model_busy) == ("", False)


def test_a_model_that_cannot_be_opened_says_why(modelled: Desk) -> None:
    modelled.project.change(model="Bad")
    asyncio.run(modelled.read_model())
    assert (modelled.model, modelled.model_trouble) == (None, "no such class; name another")


def test_a_build_beyond_its_limit_is_ended_and_the_next_one_goes(
    modelled: Desk, monkeypatch: pytest.MonkeyPatch
) -> None:
    modelled.runner.worker.ask("count").result(60.0)  # it has begun
    monkeypatch.setattr(pysim.app.desk, "_BUILD_LIMIT", 0.3)
    modelled.project.change(model="Slow")
    asyncio.run(modelled.read_model())
    assert modelled.model_trouble.startswith("the model was not ready within")
    monkeypatch.undo()
    modelled.project.change(model="Quick")
    asyncio.run(modelled.read_model())
    assert (modelled.model or {})["name"] == "Quick"


def test_the_first_compilation_has_the_time_that_the_compiler_grants_it() -> None:
    assert pysim.app.desk._BUILD_LIMIT > compiler._LONGEST_S
