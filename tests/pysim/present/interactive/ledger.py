"""Steps of a ledger: one that was not judged in between, and a name that wants to be more than text."""

STEPS = [
    {"step": "prior", "fit": 64.0, "validate": 46.0, "criteria": {"E_M max": 4.0, "E_t mean": 3.0}},
    {"step": "refit", "fit": 20.0, "validate": None, "criteria": {"E_M max": 1.0}},
    {"step": "a<b>", "fit": 1.0, "validate": 0.9, "criteria": {"E_M max": 0.0, "E_t mean": 0.5}},
]
