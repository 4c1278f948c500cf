"""The frame around every page: project, steps of the work, and what is running."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from nicegui import ui

from pysim.app.answers import STEPS, history
from pysim.app.desk import Desk
from pysim.app.jobs import FAILED
from pysim.app.live import live
from pysim.app.pages.add import add_page
from pysim.app.pages.candidates import best_of, candidates_page
from pysim.app.pages.common import aside_words, refused
from pysim.app.pages.compare import compare_page
from pysim.app.pages.data import data_page
from pysim.app.pages.help import help_of
from pysim.app.pages.locate import locate_page
from pysim.app.pages.model import model_page
from pysim.app.pages.prepare import prepare_page
from pysim.app.pages.start import start_page
from pysim.app.pages.take import take_page
from pysim.app.parts import box, button, say, text
from pysim.app.project import LOOKS
from pysim.io import counted

_PAGES = (
    ("/", "Data", data_page),
    ("/prepare", "Prepare", prepare_page),
    ("/model", "Model", model_page),
    ("/compare", "Compare", compare_page),
    ("/locate", "Locate", locate_page),
    ("/candidates", "Candidates", candidates_page),
    ("/add", "Add", add_page),
    ("/take", "Take away", take_page),
)
_MARK = (
    '<svg viewBox="0 0 24 24" aria-hidden="true"><path class="second" d="M2 5h5v6h6"/><path d="M2 9h4v6h6v5h10"/></svg>'
)


def shell(desk: Desk) -> None:
    """One tab."""
    desk.runner.worker.warm()  # what it imports is there before a button is pressed
    ui.add_head_html(
        '<link rel="stylesheet" href="/static/app.css"><script>document.documentElement.lang="en"</script>'
    )
    _look(desk)
    seen = {"path": "/", "help": ""}
    ui.on_exception(refused)

    def turn() -> None:
        seen["help"] = "" if seen["help"] else "open"

    ui.on("help", turn)
    ui.on("undo", partial(_turn, desk, back=True))
    ui.on("redo", partial(_turn, desk, back=False))
    with box("shell"):
        text("a", "To the page", "skip").props('href="#page"')
        with box("top", "header"):
            with ui.link(target="/start").classes(replace="brand"):
                ui.html(_MARK, sanitize=False)
                text("span", "Workbench")
            live(lambda: desk.version, lambda: _what(desk), "what")
            live(lambda: (desk.beat, _seconds(desk)), lambda: _job(desk))
            live(lambda: (len(desk.history.past), len(desk.history.future)), lambda: _undo(desk), "turns")
            live(lambda: desk.put_aside, lambda: say(aside_words(desk)) if desk.put_aside else None)
            live(lambda: desk.project.settings().look, lambda: _look_button(desk))
            button("? Help", turn, "quiet")
        with box("rail", "nav").props('aria-label="Steps"'):
            _rail(desk)
        with box("main").props('id="page"'):
            pages = {path: build for path, _, build in _PAGES} | {"/start": start_page}
            ui.sub_pages({path: _page(path, build, desk, seen) for path, build in pages.items()})
        live(lambda: (seen["help"], seen["path"]), lambda: _help(seen))


def _undo(desk: Desk) -> None:
    """Back and forward over all that was chosen."""
    history = desk.history
    for words, keys, steps, back in (
        ("↶ Undo", "Ctrl+Z", history.past, True), ("↷ Redo", "Ctrl+Y", history.future, False),
    ):  # fmt: skip
        press = button(words, partial(_turn, desk, back=back), "quiet", off="" if steps else "Nothing to go back to")
        if steps:
            press.props(f'title="{keys}"')


async def _turn(desk: Desk, *, back: bool) -> None:
    if told := await desk.turn_back(desk.history.undo if back else desk.history.redo):
        say(f"{'Undone' if back else 'Redone'}: {told}")


def _help(seen: dict[str, str]) -> None:
    """At the right side, where it was asked for."""
    if seen["help"]:
        with box("help", "aside").props('aria-label="Help"'):
            help_of(seen["path"])


def _page(path: str, build: Callable[[Desk], None], desk: Desk, seen: dict[str, str]) -> Callable[[], None]:
    def show() -> None:
        seen["path"] = path
        with box("page"):
            build(desk)

    return show


def _look(desk: Desk) -> None:
    """Light or dark, as the system has it or as was chosen."""
    dark = ui.dark_mode()

    def follow() -> None:
        dark.value = {"auto": None, "light": False, "dark": True}[desk.project.settings().look]

    live(lambda: desk.project.settings().look, follow)


def _look_button(desk: Desk) -> None:
    look = desk.project.settings().look
    after = LOOKS[(LOOKS.index(look) + 1) % len(LOOKS)]
    words = {"auto": "◐ Auto", "light": "☀ Light", "dark": "☾ Dark"}[look]
    press = button(words, lambda: desk.project.change(look=after), "quiet")
    press.props(f'title="Look: {look}; press for {after}"')


def _what(desk: Desk) -> None:
    """Data set and model."""
    check = desk.check
    model = desk.project.settings().model
    text("b", check.dataset.name if check else "no data set yet")
    text("span", "against")
    text("b", model or "no model yet")


def _seconds(desk: Desk) -> int:
    """So that the clock of a running job goes on."""
    return int(desk.runner.running.seconds) if desk.runner.running else 0


def _job(desk: Desk) -> None:
    """What runs, for how long, and a button that stops it; what became of it."""
    job = desk.runner.running
    with box("row").props('role="status" aria-live="polite"'):
        if job is not None:
            with box("job"):
                box("spin")
                text("span", job.stage, "stage")._props["title"] = job.work.title
                text("span", clock(job.seconds), "time")
                button("Stop", desk.runner.stop, "small")
        elif desk.doing or desk.drawing:
            with box("job"):
                box("spin")
                text("span", desk.doing or "Drawing the report", "stage")
        elif desk.last is not None and desk.last.state == FAILED:
            text("span", "Failed", "chip bad")
        elif desk.last is not None:
            words = {"done": "Done", "stopped": "Stopped"}[desk.last.state]
            text("span", f"{words} after {clock(desk.last.seconds)}", f"chip {'good' if words == 'Done' else ''}")


def clock(seconds: float) -> str:
    """Minutes and seconds."""
    return f"{int(seconds) // 60}:{int(seconds) % 60:02d}"


def _rail(desk: Desk) -> None:
    links = []
    for number, (path, name, _) in enumerate(_PAGES, 1):
        link = ui.link(target=path).classes(replace="")
        with link:
            text("span", str(number), "number").props('aria-hidden="true"')
            text("span", name, "name")
            state = text("span", "", "state")
        links.append((link, state))

    def follow() -> None:
        states = _states(desk)
        for (link, state), (words, done) in zip(links, states, strict=True):
            state.set_text(words)
            link.classes(add="done" if done else "", remove="" if done else "done")

    live(lambda: (desk.version, desk.beat), follow)
    ui.add_body_html('<script src="/static/rail.js"></script>')


def _states(desk: Desk) -> list[tuple[str, bool]]:
    """Per page a few words and whether it has something to show."""
    check = desk.check
    answers = desk.answers
    settings, values = desk.project.settings(), desk.project.values()
    located, whole, ranked = answers.newest("missing"), answers.verdict, answers.newest("ranking")
    now = answers.with_effects(settings.added)
    compared = now or answers.with_effects(())  # as the page Compare has it: its noise is that of one answer
    error = "" if compared is None else f"{_rms(compared.base['step'], compared.data['error'])} × noise"
    first = "" if located is None else str(located.data["missing"][0]["slot"])
    best = "" if ranked is None else best_of(ranked)
    verdict = str(whole.data["verdict"]) if whole is not None and whole.added == settings.added else best
    step = "refit" if now is None else history(now, settings.added)[-1]["step"]
    last = "" if now is None or step in STEPS else f"{_rms(step, now.data['error'])} × noise"
    return [
        (counted(len(check.records), "record") if check else "drop your logs", check is not None),
        _prepared(desk),
        (f"{counted(len(values), 'value')} of your own" if values else "move its parameters", bool(values)),
        (error or "model beside data", compared is not None),
        (first or "where it fails", located is not None),
        (verdict or "what may be missing", ranked is not None),
        (last or "watch the error fall", bool(last)),
        ("class, FMU, report" if last else "files and commands", bool(last)),
    ]


def _prepared(desk: Desk) -> tuple[str, bool]:
    """How many steps the data set asks for, or what is to be mended."""
    loaded = desk.loaded
    if loaded is not None and loaded.empty_cells:
        return "empty cells", False
    steps = loaded.steps if loaded is not None else 0
    return (counted(steps, "step") if steps else "keep, cut, filter", bool(steps))


def _rms(step: str, error: list[dict[str, object]]) -> str:
    found = next((row for row in error if row["step"] == step), None)
    value = None if found is None else found["fit"] or found["validate"]
    return "–" if value is None else f"{value:.2f}"
