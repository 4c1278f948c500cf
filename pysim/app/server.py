"""The server of the page: one project, this machine, a token."""

from __future__ import annotations

import asyncio
import contextlib
import json
import logging
import shutil
import socket
import tempfile
import webbrowser
from pathlib import Path
from secrets import token_urlsafe

from fastapi import Request
from fastapi.responses import FileResponse, PlainTextResponse, Response
from nicegui import app, run, ui
from starlette.requests import ClientDisconnect

from pysim.app.desk import Desk
from pysim.app.disk import disk_trouble
from pysim.app.guard import Guard, host_names
from pysim.app.jobs import Runner, settle
from pysim.app.lock import held
from pysim.app.notebook import notebook
from pysim.app.pages.shell import shell
from pysim.app.project import Project
from pysim.app.recent import remember
from pysim.app.records import MOST, Overlay, compared_overlay, measured_overlay
from pysim.app.upload import Batch, Limits, adopt, replaces
from pysim.io import counted
from pysim.types import BadInput

_STATIC = Path(__file__).parent / "static"
_LOOPBACK = ("127.0.0.1", "localhost", "::1")
_ANY = ("0.0.0.0", "::", "")
_TICK = 0.2  # s
_REPLACES = "This data set takes the place of the one that is there, which is kept as an earlier one."
_BROKE_OFF = "the drop broke off, or another one has begun since; drop it again"


def serve(
    folder: Path, *, host: str = "127.0.0.1", port: int = 0, show: bool = True, limits: Limits, limit_s: float = 3600.0
) -> None:
    """Show a project until the process is ended.

    Args:
        folder: of the project; made where it is missing.
        host: to listen at; loopback unless others are to come in, who need the token as well.
        port: 0 takes a free one.
        show: whether to open the browser.
        limits: of what may be dropped.
        limit_s: of any piece of work, s.
    Raises:
        BadInput: a folder that is no project or that another server has, or a port that is taken.
    """
    Project.at(folder)  # what is no project is refused first
    port = free_port(host, port)
    with Holder(page_address(host, port)) as holder:
        project = holder.take(folder)
        _run(Desk(project, Runner(project, limit_s), limits, holder.take), host, port, show=show)


class Holder(contextlib.ExitStack):
    """The project that this server has to itself: one at a time.

    Args:
        address: of the page, reported to another server that wants the project.
    """

    def __init__(self, address: str) -> None:
        super().__init__()
        self._address, self._has = address, Path()

    def take(self, folder: Path) -> Project:
        """Have another project in place of the one before.

        Raises:
            BadInput: a folder that is no project, or that another server has.
        """
        project = Project.at(folder)
        if project.folder == self._has:
            return project
        with contextlib.ExitStack() as new:
            new.enter_context(held(project.folder))(self._address)
            settle(project)
            project.purge()
            shutil.rmtree(project.uploads, ignore_errors=True)  # what came in half when a server ended
            self.close()
            self.push(new.pop_all())
        self._has = project.folder
        remember(project.folder)
        return project


def _run(desk: Desk, host: str, port: int, *, show: bool) -> None:
    token = token_urlsafe(24)
    known = host_names(own_names(host), port)
    app.add_middleware(Guard, token=token, hosts=known, cookie=f"pysim_app_{port}", numbers=bool(opened(host)))
    address = f"{page_address(host, port)}/?token={token}"
    words = f"Workbench: {address}\nProject: {desk.project.folder}\n{opened(host)}Ctrl-C ends it."
    _routes(desk)
    app.add_static_files("/static", _STATIC)
    app.config.quasar_config["loadingBar"] = {"skipHijack": True}  # it says nothing to those who cannot see it
    app.timer(_TICK, desk.tick)
    app.on_startup(lambda: _announce(words, host, port, address if show else ""))
    app.on_startup(desk.read)
    logging.getLogger("nicegui").addFilter(lambda one: not (one.exc_info and isinstance(one.exc_info[1], BadInput)))
    app.on_shutdown(lambda: desk.runner.close())  # of the project that is shown then
    ui.run(
        root=lambda: shell(desk), host=host, port=port, title="Workbench", favicon=_STATIC / "icon.svg", dark=None,
        reload=False, show=False,  # NiceGUI waits for IPv4 alone
        tailwind=False, show_welcome_message=False, reconnect_timeout=60.0,
        ws_per_message_deflate=host not in _LOOPBACK,  # it costs more than it saves on one machine
    )  # fmt: skip


def own_names(host: str) -> tuple[str, ...]:
    """How a browser may name a server that listens there; one that listens everywhere goes by this machine's names."""
    loopback = ("127.0.0.1", "localhost", "[::1]")
    if host in _LOOPBACK:
        return loopback
    if host in _ANY:
        return (*loopback, socket.gethostname(), socket.getfqdn())
    return (f"[{host}]" if ":" in host else host,)


def opened(host: str) -> str:
    """A line for whoever lets others in; nothing where only this machine is."""
    if host in _LOOPBACK:
        return ""
    return "Open to the network, without encryption: whoever sees the token can run code here in your name.\n"


def _reached(host: str) -> str:
    """What this machine asks for to reach a server that listens at a host."""
    return {"localhost": "127.0.0.1", "0.0.0.0": "127.0.0.1", "::": "::1"}.get(host, host)


def page_address(host: str, port: int) -> str:
    """The page of a server that listens there, for a browser on this machine."""
    name = _reached(host)
    return f"http://{f'[{name}]' if ':' in name else name}:{port}"


async def _announce(words: str, host: str, port: int, show: str) -> None:
    """Say where the page is, once it is there; and show that address, where there is one, in the browser."""
    while True:
        try:
            _, writer = await asyncio.open_connection(_reached(host), port)
        except OSError:
            await asyncio.sleep(0.02)
        else:
            break
    writer.close()
    print(words, flush=True)
    if show:
        await run.io_bound(webbrowser.open, show)


def free_port(host: str, port: int) -> int:
    """A port that is free.

    One that a server has just left is. On Windows it is so by itself, and SO_REUSEADDR would give out one that is in
    use: there it is asked for alone.

    Raises:
        BadInput: the wanted one is not.
    """
    try:
        with socket.socket(socket.AF_INET6 if ":" in host else socket.AF_INET) as probe:
            probe.setsockopt(socket.SOL_SOCKET, getattr(socket, "SO_EXCLUSIVEADDRUSE", socket.SO_REUSEADDR), 1)
            probe.bind((host, port))
            return int(probe.getsockname()[1])
    except OSError as error:
        raise BadInput(f"--port {port} at {host}: {error.strerror}; name another, or leave it out") from error


def _routes(desk: Desk) -> None:
    """What the page asks for besides itself."""

    @app.post("/upload")
    def begin() -> Response:
        for old in list(desk.batches.values()):  # one drop at a time; what was left half way goes
            old.end()
        desk.batches.clear()
        batch = Batch(desk.project.uploads, desk.limits)
        try:
            (batch.folder / batch.name).mkdir(parents=True)
        except OSError as error:
            return PlainTextResponse(str(disk_trouble(error)), 507)
        desk.batches[batch.name] = batch
        return PlainTextResponse(batch.name)

    @app.put("/upload/{name}")
    async def take(name: str, request: Request) -> Response:
        batch = desk.batches.get(name)
        if batch is None:
            return PlainTextResponse(_BROKE_OFF, 409)
        kept = False
        try:
            size = request.headers.get("content-length", "")
            if not (size.isascii() and size.isdigit()):
                raise BadInput("a file came without its length; drop it again, in a browser of today")
            await batch.take(request.query_params.get("name", ""), request.stream(), size=int(size))
            kept = True
        except ClientDisconnect:
            return PlainTextResponse("the connection broke; drop it again", 400)
        except BadInput as error:
            return PlainTextResponse(str(error), 422)
        except OSError as error:
            if desk.batches.get(name) is not batch:  # its folder is gone
                return PlainTextResponse(_BROKE_OFF, 409)
            return PlainTextResponse(str(disk_trouble(error)), 507)
        finally:
            if not kept:  # a drop with a file that is not whole is none
                desk.batches.pop(name, None)
                batch.end()
        return PlainTextResponse("kept")

    @app.post("/upload/{name}/done")
    async def done(name: str, files: int, sure: bool = False) -> Response:
        batch = desk.batches.pop(name, None)
        if batch is None:
            return PlainTextResponse(_BROKE_OFF, 409)
        if batch.whole != files:
            batch.end()
            return PlainTextResponse(f"{batch.whole} of {counted(files, 'file')} arrived; drop them again", 409)
        if desk.runner.running is not None or desk.taking:
            batch.end()
            return PlainTextResponse("wait until the running work has ended, or stop it; then drop it again", 409)
        desk.taking = True
        try:
            if not sure and await run.io_bound(replaces, batch, desk.project):
                desk.batches[name] = batch  # until that is answered
                return PlainTextResponse(_REPLACES, 202)
            adopted = await run.io_bound(adopt, batch, desk.project)  # a large archive does not hold up the page
            if adopted is None:
                return PlainTextResponse("the server is ending; start it again, then drop it again", 503)
            settings = desk.project.settings()
            libraries = tuple(dict.fromkeys((*settings.libraries, *adopted.libraries)))
            desk.project.use_model(adopted.model or settings.model, libraries)
            desk.history.begin_anew()
        except (BadInput, OSError) as error:
            batch.end()
            trouble = error if isinstance(error, BadInput) else disk_trouble(error)
            return PlainTextResponse(str(trouble), 422 if trouble is error else 507)
        finally:
            desk.taking = False
        if adopted.kind != "model":
            await desk.read_data()
        if adopted.model or adopted.libraries:
            await desk.read_model()
        return PlainTextResponse(adopted.text)

    @app.get("/series")
    def series(of: str, record: int, begin: float, end: float, most: int = MOST) -> Response:
        overlay = overlay_of(desk, of, record)
        if overlay is None:
            return PlainTextResponse("no such record", 404)
        x, y, exact = overlay.samples(begin, end, min(max(most, 4), 20000))
        return Response(json.dumps({"x": x, "y": y, "exact": exact}), media_type="application/json")

    @app.get("/notebook")
    def same_steps() -> Response:
        return Response(notebook(desk.project), media_type="application/x-ipynb+json")

    @app.get("/commands/{name}")
    def commands(name: str) -> Response:
        answer = next((one for one in desk.answers.all if one.job.work.name == name), None)
        if answer is None or "plan" not in answer.data["files"]:
            return PlainTextResponse("there is no plan of a test", 404)
        try:
            return Response(played(answer.folder / answer.data["files"]["plan"]), media_type="application/zip")
        except BadInput as error:
            return PlainTextResponse(str(error), 409)

    @app.get("/result/{name}/{file:path}")
    async def result(name: str, file: str) -> Response:
        path = (desk.project.folder / "results" / name / file).resolve()
        answer = next((one for one in desk.answers.all if one.job.work.name == name), None)
        if answer is not None and file == answer.data["files"]["report"] and not path.is_file():
            try:
                await desk.draw_report(name)
            except BadInput as error:
                return PlainTextResponse(str(error), 409)
        if not path.is_relative_to((desk.project.folder / "results").resolve()) or not path.is_file():
            return PlainTextResponse("no such file", 404)
        shown = path.suffix in (".html", ".png", ".svg")
        return FileResponse(path, filename=path.name, content_disposition_type="inline" if shown else "attachment")


def played(plan: Path) -> bytes:
    """A .zip of what a bench plays for a plan: a CSV file per run, a table of them, the dataset.toml of the logs."""
    from pysim.bench import read_plan, write_commands

    with tempfile.TemporaryDirectory() as place:
        write_commands(read_plan(plan), Path(place) / "next_test", logs="csv")
        return Path(shutil.make_archive(f"{place}/next_test", "zip", f"{place}/next_test")).read_bytes()


def overlay_of(desk: Desk, of: str, record: int) -> Overlay | None:
    """A record of the data set (`of` is "data" or "prepared"), or beside the models of a result; None without one."""
    check = desk.check
    if check is None or not 0 <= record < len(check.dataset.logs()):
        return None
    log = check.dataset.logs()[record]
    if of == "data":
        return measured_overlay(log)
    if of == "prepared":
        return measured_overlay(log, desk.raw_of(log))
    answer = next((one for one in desk.answers.all if one.job.work.name == of), None)
    try:
        return None if answer is None else compared_overlay(answer, record)
    except BadInput:  # its files were removed meanwhile, as it is to be run anew
        return None
