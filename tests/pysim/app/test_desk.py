"""What all pages share: the newest reading of the data counts, in whatever order readings end."""

import asyncio
from collections.abc import Callable
from pathlib import Path

import pytest

import pysim.app.desk
from pysim.app.desk import Desk, Loaded
from pysim.app.jobs import Runner
from pysim.app.project import Project
from pysim.app.upload import Limits


@pytest.mark.parametrize("order", [(0, 1), (1, 0)])
def test_an_earlier_reading_that_ends_later_does_not_count(
    order: tuple[int, int], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    project = Project.at(tmp_path)
    desk = Desk(project, Runner(project, 60.0), Limits(), lambda words: "")

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
