"""Find the physical effects that a model lacks, from measurements.

`diagnose` searches the catalogue of effects, `learn` estimates a law that no catalogue has, `add` adds given effects,
`rank` tests each effect beside the base model, and `compare` compares the model with the measurements. Each takes a
`Session`, which `pysim.open_session` makes from names and `session` from objects.
"""

from pysim.diagnosis.engine import add, compare, diagnose, learn, rank
from pysim.diagnosis.session import BuildVariant, Session, session
from pysim.diagnosis.settings import Settings

__all__ = [
    "BuildVariant",
    "Session",
    "Settings",
    "add",
    "compare",
    "diagnose",
    "learn",
    "rank",
    "session",
]
