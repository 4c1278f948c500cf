"""Compare a model with its measurements and say what that means; name the effect that it lacks."""

from pysim.diagnose.compare import compare
from pysim.diagnose.diagnose import located
from pysim.diagnose.subject import BuildVariant, Inside, Subject, identifiable, subject

__all__ = [
    "BuildVariant",
    "Inside",
    "Subject",
    "compare",
    "identifiable",
    "located",
    "subject",
]
