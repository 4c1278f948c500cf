"""Work of the worker: done, failed, stopped, too slow; and what a server that ended leaves."""

import json
import os
import re
import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from pysim.app import jobs
from pysim.app.jobs import DONE, FAILED, RUNNING, STOPPED, Job, Runner, Work, adding, read_job, settle, works
from pysim.app.processes import Started
from pysim.app.project import Project
from pysim.types import BadInput
from tests.pysim.app.alive import PARENT, alive, child
from tests.pysim.app.code_tasks import CODE

_WAIT = 60.0  # s
Begun = Callable[..., Runner]


@pytest.fixture
def project(tmp_path: Path) -> Project:
    return Project.at(tmp_path / "project")


def work(project: Project, code: str) -> Work:
    """A piece of work that is a few lines of Python."""
    return Work("try", "Try", ("-c", code))


@pytest.fixture
def begun(project: Project) -> Iterator[Begun]:
    """Makes runners whose work is code; all are ended afterwards."""
    made: list[Runner] = []

    def runner(limit: float = 60.0) -> Runner:
        made.append(Runner(project, limit, CODE))
        return made[-1]

    yield runner
    for one in made:
        one.close()


def wait(runner: Runner) -> None:
    begun = time.monotonic()
    while runner.running is not None:
        assert time.monotonic() - begun < _WAIT
        runner.poll()
        time.sleep(0.01)


ANSWERED = "open('results/try/answer.json', 'w').write('{}')"


def test_what_ends_well_is_done(project: Project, begun: Begun) -> None:
    runner = begun()
    runner.start(work(project, ANSWERED))
    wait(runner)
    job = read_job(project.results("try"))
    assert job is not None
    assert (job.state, job.fingerprint, job.message) == (DONE, project.fingerprint(), "")


@pytest.mark.parametrize(
    ("code", "words"),
    [
        ("raise BadInput('no such thing; name another')", "no such thing; name another"),
        ("1 / 0", "this is our mistake: ZeroDivisionError: division by zero; please report it"),
        ("import os; print('Fatal Python error', flush=True); os._exit(3)", "broke down: Fatal Python error"),
        ("import os; os._exit(3)", "the process ended without a word; look at output.txt in the folder of the result"),
    ],
)
def test_what_failed_says_why_and_the_next_work_is_done(code: str, words: str, project: Project, begun: Begun) -> None:
    runner = begun()
    for one in (code, ANSWERED):
        runner.start(work(project, one))
        wait(runner)
        job = read_job(project.results("try"))
        assert job is not None
        assert (job.state, words in job.message) == ((FAILED, True) if one == code else (DONE, False))


def test_one_at_a_time_and_stopped_with_all_that_it_has_started(project: Project, begun: Begun) -> None:
    runner = begun()
    trial = {"names": [], "error": 2.0, "values": {"k": 3.0}}
    line = json.dumps({"seconds": 1, "stage": "refitting", "text": "a", "step": None, "trial": trial})
    code = f"open('results/try/events.jsonl', 'w').write({line + chr(10)!r} + '{{\"half')\n"
    runner.start(work(project, code + PARENT))
    with pytest.raises(BadInput, match="Try is running; wait for it, or stop it first"):
        runner.start(work(project, ANSWERED))
    number = child(project.folder)
    runner.poll()
    assert runner.running is not None
    assert runner.running.stage == "refitting"
    assert runner.running.trials == (trial,)
    runner.stop()
    wait(runner)
    job = read_job(project.results("try"))
    assert job is not None
    assert job.state == STOPPED
    assert not alive(number)


def test_what_takes_too_long_is_ended_and_says_so(project: Project, begun: Begun) -> None:
    runner = begun(0.2)
    runner.start(work(project, "import time; time.sleep(60)"))
    wait(runner)
    job = read_job(project.results("try"))
    assert job is not None
    assert (job.state, job.message) == (FAILED, "it took longer than 0.2 s; run it on the command line")


def test_a_checkpoint_is_kept_for_the_same_data_and_removed_for_others(project: Project, begun: Begun) -> None:
    runner, checkpoint = begun(), project.results("try") / "checkpoint.jsonl"
    runner.start(work(project, "open('results/try/checkpoint.jsonl', 'w'); raise BadInput('no')"))
    wait(runner)
    runner.start(work(project, "raise BadInput('no')"))
    wait(runner)
    assert checkpoint.exists()
    project.change(model="Other.Model")
    runner.start(work(project, "raise BadInput('no')"))
    wait(runner)
    assert not checkpoint.exists()


def test_what_a_server_left_running_is_ended_and_counts_as_stopped(project: Project, begun: Begun) -> None:
    begun().start(work(project, PARENT))
    number = child(project.folder)
    found = read_job(project.results("try"))
    assert found is not None
    assert found.state == RUNNING
    assert found.process is not None
    assert found.lives
    settle(project)  # as after a crash: nobody has written how it ended
    assert not alive(number)
    assert not alive(found.process.pid)
    after = read_job(project.results("try"))
    assert after is not None
    assert (after.state, after.process, after.lives) == (STOPPED, None, False)
    assert after.seconds > 0
    runner = begun()
    runner.start(work(project, ANSWERED))  # and can go on
    wait(runner)
    after = read_job(project.results("try"))
    assert after is not None
    assert after.state == DONE


def left(project: Project, **process: object) -> Path:
    """What a server that is gone has written of a job: its file."""
    path = project.results("try") / "job.json"
    path.parent.mkdir(parents=True)
    head: dict[str, object] = {"work": {"name": "try", "title": "Try", "words": ["-c", ""], "effects": []}}
    head |= {"state": RUNNING, "begun": 1.0, "ended": None, "fingerprint": "", "message": ""}
    path.write_text(json.dumps(head | ({"process": process} if process else {})))
    return path


@pytest.mark.parametrize("process", [{}, {"pid": os.getpid(), "began": 1.0}])
def test_a_process_that_got_the_number_of_a_job_later_is_left_alone(
    project: Project, process: dict[str, object]
) -> None:
    left(project, **process)
    settle(project)  # does not end this test
    found = read_job(project.results("try"))
    assert found is not None
    assert found.state == STOPPED


def test_what_still_lives_never_counts_as_stopped(project: Project, monkeypatch: pytest.MonkeyPatch) -> None:
    path = left(project, pid=os.getpid(), began=Started.of(os.getpid()).began)
    monkeypatch.setattr(Started, "end", lambda self, patience: False)
    before = path.read_bytes()
    with pytest.raises(BadInput, match=rf"try is being written by process {os.getpid()}, .*; end it, then start again"):
        settle(project)
    assert path.read_bytes() == before


def test_no_second_process_writes_into_the_same_result(project: Project, begun: Begun) -> None:
    first = begun()
    first.start(work(project, PARENT))
    child(project.folder)
    with pytest.raises(BadInput, match=r"try is being written by process \d+; wait for it, or end it first"):
        begun().start(work(project, ANSWERED))
    assert first.running is not None
    first.close()
    assert first.running is None


def test_a_job_whose_number_cannot_be_written_does_not_begin(
    project: Project, begun: Begun, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(path: Path, content: str) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(jobs, "write_file", full)
    runner = begun()
    with pytest.raises(OSError, match="No space left"):
        runner.start(work(project, "open('begun', 'w')"))
    assert runner.running is None
    assert not (project.folder / "begun").exists()


def test_words_are_those_of_the_command_line(project: Project) -> None:
    with pytest.raises(BadInput, match="no model yet"):
        works(project)
    project.change(model="A.B", libraries=("model/L",), free=("m", "k"))
    with pytest.raises(BadInput, match="no data set yet"):
        works(project)
    project.data.mkdir()
    project.description.touch()
    words = works(project)
    assert words["diagnose"].words[:6] == ("diagnose", "data", "--model", "A.B", "--library", "model/L")
    assert words["compare"].words[:4] == ("compare", "data", "--model", "A.B")
    parse(words["compare"].words, words["diagnose"].words, words["rank"].words, words["locate"].words)
    added = adding(project, ["valve.deadband", "../evil name"])
    assert re.fullmatch(r"add-valve\.deadband\+\.\._evil_name-[0-9a-f]{8}", added.name)
    assert added.effects == ("valve.deadband", "../evil name")
    parse(added.words)


def test_no_two_chains_of_effects_share_a_folder(project: Project) -> None:
    project.change(model="A.B")
    project.data.mkdir()
    project.description.touch()
    long = [f"library.effect_of_some_length_{k}" for k in range(3)]
    chains = [long, [*long, "a"], [*long, "b"], ["a b"], ["a_b"], ["a", "b"], ["a+b"], ["b", "a"], ["A", "B"]]
    names = [adding(project, chain).name for chain in chains]
    assert len({name.casefold() for name in names}) == len(chains)
    assert max(map(len, names)) < 100
    assert names == [adding(project, chain).name for chain in chains]


def parse(*lines: tuple[str, ...]) -> None:
    """The command line takes them."""
    from pysim.cli.main import argument_parser

    for words in lines:
        assert argument_parser().parse_args(list(words)).command == words[0]


def test_the_best_point_is_the_models_own_and_the_lowest() -> None:
    trials = [([], 8.0), ([], 3.0), ([], 5.0), (["toy.friction"], 1.0)]
    told = tuple({"names": names, "error": error, "values": {"k": error}} for names, error in trials)
    job = Job(Work("compare", "Compare", ("compare",)), RUNNING, 0.0, None, "", trials=told)
    assert job.best is not None
    assert job.best["values"] == {"k": 3.0}
    assert replace(job, trials=told[-1:]).best is None
