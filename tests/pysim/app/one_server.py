"""`pysim app`, but the tests name the project that it shows: one server does for all of them.

    POST /tests/show?folder=FOLDER&idle=0&size=BYTES

`idle` builds no model and begins work that does nothing: what a job finds is then written by the test.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from nicegui import Client, app, background_tasks

from pysim.app import jobs, server
from pysim.app.desk import Desk
from pysim.app.jobs import Runner
from pysim.app.project import Project
from pysim.app.upload import Limits
from pysim.cli import main

_run, _routes = jobs.run_pysim, server._routes
_SLEEP = (sys.executable, "-c", "import time; time.sleep(600)")


def _sleep(*_: object) -> subprocess.Popen[bytes]:
    return subprocess.Popen(_SLEEP, start_new_session=True)


def _routes_and_show(desk: Desk) -> None:
    _routes(desk)
    app.on_shutdown(lambda: desk.runner.close())

    @app.post("/tests/show")
    async def show(folder: str, idle: bool, size: int) -> None:
        desk.runner.close()
        for client in list(Client.instances.values()):  # pages of the project before
            client.delete()
        jobs.run_pysim = _sleep if idle else _run
        project = Project.at(Path(folder))
        fresh = Desk(project, Runner(project), Limits(size=size), desk.redo, version=desk.version, beat=desk.beat)
        fresh._build, fresh._reading = desk._build + 1, desk._reading + 1  # what the one before still reads is late
        vars(desk).update(vars(fresh))
        desk.changed()
        background_tasks.create(desk.read_data())
        if not idle:
            background_tasks.create(desk.read_model())


server._routes = _routes_and_show

if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
