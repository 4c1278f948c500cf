"""`pysim app`, but the tests name the project that it shows: one server does for all of them.

    POST /tests/show?folder=FOLDER&idle=0&size=BYTES&restless=0

`idle` builds no model and begins work that does nothing: what a job finds is then written by the test. `restless` draws
every part of the page anew without end.
"""

from __future__ import annotations

import sys
from pathlib import Path

from nicegui import Client, app, background_tasks

from pysim.app import server
from pysim.app.desk import Desk
from pysim.app.upload import Limits
from pysim.app.worker import TASKS
from pysim.cli import main

_routes = server._routes
_HASTE = 0.02  # s between two drawings


def _routes_and_show(desk: Desk) -> None:
    _routes(desk)
    changes = app.timer(_HASTE, desk.changed, active=False)

    @app.post("/tests/show")
    async def show(folder: str, idle: bool, size: int, restless: bool) -> None:
        changes.active = restless
        desk.runner.close()
        desk.runner.poll()
        for client in list(Client.instances.values()):  # pages of the project before
            client.delete()
        desk.limits, desk.doing, desk.taking = Limits(size=size), "", False
        desk.open(Path(folder), tasks="tests.pysim.app.code_tasks:Idle" if idle else TASKS)
        background_tasks.create(desk.read_data() if idle else desk.read())


server._routes = _routes_and_show

if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
