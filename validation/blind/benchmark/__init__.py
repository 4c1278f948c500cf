"""The blind benchmark: every case of the plant's table diagnosed and judged, the answers kept, figures made of them."""

from validation.blind.benchmark.answer import Answer
from validation.blind.benchmark.figures import Figure, figures
from validation.blind.benchmark.fingerprint import fingerprint
from validation.blind.benchmark.runs import Choice, run
from validation.blind.benchmark.store import ANSWERS, Store

__all__ = ["ANSWERS", "Answer", "Choice", "Figure", "Store", "figures", "fingerprint", "run"]
