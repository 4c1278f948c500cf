"""The page's job whose server, or own process, is killed at any moment: the next server ends it with the same answer.

`python -m pytest -m slow tests/pysim/app/test_killed_jobs.py`; the kills of commands are the case `kills`.
"""

from collections.abc import Iterator
from pathlib import Path

import pytest

from pysim.app.jobs import ANSWER, DONE, read_job
from pysim.app.project import Project, Settings
from tests.pysim.app.job_server import JOB
from validation.kills import one
from validation.kills.logs import LIBRARY, write_logs
from validation.kills.subjects import Subject, half_answer, read_answer

SEEDS = range(1, 14)


def project_with_logs(folder: Path) -> None:
    project = Project.at(folder / "project")
    write_logs(project.data)
    project.models.mkdir()
    (project.models / LIBRARY.name).write_bytes(LIBRARY.read_bytes())
    project.save(Settings(model="Cart.Mass", libraries=(f"model/{LIBRARY.name}",)))


def results(folder: Path) -> Path:
    return folder / "project" / "results" / JOB


def process_of(folder: Path) -> int:
    """Of the job; 0 where there is none yet."""
    job = read_job(results(folder))
    return job.process.pid if job is not None and job.process is not None and job.lives else 0


def done(folder: Path) -> object:
    job = read_job(results(folder))
    assert job is not None
    assert job.state == DONE
    return read_answer(results(folder) / ANSWER)


@pytest.fixture(scope="module")
def page() -> Iterator[None]:
    subject = Subject(
        ("tests.pysim.app.job_server", "project"),
        project_with_logs,
        done,
        lambda folder: half_answer(results(folder) / ANSWER),
        also_child=process_of,
    )
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(one, "SUBJECTS", {"page": subject})
        one.undisturbed.cache_clear()
        yield
    one.undisturbed.cache_clear()


@pytest.mark.slow
@pytest.mark.parametrize("seed", SEEDS)
def test_a_killed_job_ends_in_the_same_answer(seed: int, page: None) -> None:
    found = one.answer(f"page-{seed}")
    assert found["same"], found
    assert found["half"] == ""
