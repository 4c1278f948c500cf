"""What each page is for, and the keys that it takes."""

from __future__ import annotations

from pysim.app.parts import box, text

_ABOUT = {
    "/start": (
        "Click an example. The page makes its logs and its model, and shows where the two differ.",
        "A project is a folder. Everything is kept in it, so you can close the page at any time.",
    ),
    "/": (
        "Drop a folder with a dataset.toml, a .zip, or single logs. Logs without a dataset.toml are described here.",
        "Logs used to choose help to tell which model is better. Held-out logs show how well the answer predicts.",
    ),
    "/prepare": (
        "Drag over a stretch of a log to zoom in. Then keep it, or cut it out. The grey line is what was logged.",
        "Steps are done one after the other. Switch one off to see what it does; Ctrl+Z takes back the last change.",
    ),
    "/model": (
        "Move a slider. One log is simulated again at once; the curves and the residual follow.",
        "Where you let go is kept in parameters.toml. Fits and searches begin there.",
        "A log begins where it was estimated to begin with the first values that were shown.",
    ),
    "/compare": ("A residual of 1 means only noise is left. Click a cell of the map to open its log.",),
    "/locate": ("Pick a place in the drawing to see the law that it would need.",),
    "/candidates": ("Try adds an effect and refits the model.",),
    "/add": ("The error falls step by step while effects are added. Parameters are shown before and after.",),
    "/take": ("Download the extended class, its FMU and the fitted values. The report is drawn when you open it.",),
}
_KEYS = (
    ("Tab, Enter", "reach and press everything"),
    ("Ctrl+Z, Ctrl+Y", "undo and redo what was chosen"),
    ("?, Escape", "show this help, and close it"),
    ("arrows, + −, 0", "in a figure over time: move, zoom, show all"),
    ("arrows", "in the drawing: go from place to place"),
)


def help_of(path: str) -> None:
    """Of the page at a path."""
    text("h2", "Help")
    for sentence in _ABOUT.get(path, ()):
        text("p", sentence)
    text("h3", "Keys")
    with box("keys", "dl"):
        for keys, what in _KEYS:
            text("dt", keys, "mono")
            text("dd", what)
