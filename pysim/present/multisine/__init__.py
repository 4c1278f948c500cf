"""Best linear approximations, shown."""

from pysim.present.multisine.answer import Approximations, data, text, verdicts
from pysim.present.multisine.figure import figures, multisine_figure
from pysim.present.multisine.page import page

__all__ = ["Approximations", "data", "figures", "multisine_figure", "page", "text", "verdicts"]
