"""Compare a model with its measurements and say what that means; name the effect that it lacks."""

from pysim.diagnose.compare import compare
from pysim.diagnose.diagnose import add, against, diagnose, located, rank
from pysim.diagnose.subject import BuildVariant, Inside, Subject, identifiable, subject

__all__ = [
    "BuildVariant",
    "Inside",
    "Subject",
    "add",
    "against",
    "compare",
    "diagnose",
    "identifiable",
    "located",
    "rank",
    "subject",
]
