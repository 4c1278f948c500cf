"""Which physical effect is missing: the steps in a row, and each of them alone.

`diagnose` searches, `learn` looks for a law that no catalogue has, `add` adds given effects, `rank` tries each beside
the base model, `compare` holds the model beside the measurements. Each takes a `Session`, which `pysim.open_session`
opens by names and `session` from objects. `compare_responses` repeats stepped-sine tests that were measured as tables
of frequency responses.
"""

from pysim.diagnosis.engine import add, compare, diagnose, learn, rank
from pysim.diagnosis.response_comparison import compare_responses
from pysim.diagnosis.session import BuildVariant, Session, identifiable, session
from pysim.diagnosis.settings import Settings

__all__ = [
    "BuildVariant",
    "Session",
    "Settings",
    "add",
    "compare",
    "compare_responses",
    "diagnose",
    "identifiable",
    "learn",
    "rank",
    "session",
]
