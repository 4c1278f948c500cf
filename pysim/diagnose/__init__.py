"""Compare a model with its measurements and say what that means."""

from pysim.diagnose.compare import compare

__all__ = ["compare"]
