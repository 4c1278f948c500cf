"""`python -m tests.pysim.app.job_server PROJECT`: start as the page's server does, and run its job to the end.

In place of a browser that asks for the job; all else is what the page uses.
"""

from __future__ import annotations

import sys
import time
from pathlib import Path

from pysim.app.jobs import Runner, read_job, settle, works
from pysim.app.lock import held
from pysim.app.project import Project

JOB = "compare"
_NAP = 0.05  # s


def main(folder: Path) -> None:
    """Settle what an earlier server has left, then run the job."""
    project = Project.at(folder)
    with held(project.folder):
        settle(project)
        runner = Runner(project)
        runner.start(works(project)[JOB])
        while runner.running is not None:
            runner.poll()
            time.sleep(_NAP)
    job = read_job(project.results(JOB))
    print("none" if job is None else f"{job.state} {job.message}".strip())


if __name__ == "__main__":
    main(Path(sys.argv[1]))
