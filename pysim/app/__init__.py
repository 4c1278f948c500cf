"""The workbench: a page in the browser on a project folder. Every button runs the command line."""

from pysim.app.server import serve
from pysim.app.upload import Limits

__all__ = ["Limits", "serve"]
