"""Lines of a figure."""

from typing import Any


def trace(figure: dict[str, Any], name: str, panel: str = "y") -> dict[str, Any]:
    """The one of a name in a panel."""
    return next(t for t in figure["data"] if t["name"].startswith(name) and t.get("yaxis", "y") == panel)
