"""Progress of a diagnosis: events while it works, and the time that its stages took."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field

from pysim.diagnosis.refit import FinalFit
from pysim.types import ErrorStep, GainTest, ProgressEvent, Trial

Say = Callable[[ProgressEvent], None]


@dataclass
class Progress:
    """Reports what the diagnosis does.

    Args:
        tell: called with each event; an exception that it raises ends the diagnosis.
        seconds: stage -> wall time.
    """

    tell: Say
    seconds: dict[str, float] = field(default_factory=dict)
    now: str = "simulating the model"
    since: float = field(default_factory=time.monotonic)

    def doing(self, what: str) -> None:
        """A new activity begins, which `what` names in a few words."""
        self.now = what
        self.tell(ProgressEvent(what))

    def tried(self, trial: Trial) -> None:
        """A search has evaluated a point."""
        self.tell(ProgressEvent(self.now, trial=trial))

    def learned(self, model: FinalFit, test: GainTest) -> None:
        """The search has taken a larger model, at least on trial."""
        name = " + ".join(model.names) or "the base model"
        self.tell(ProgressEvent(self.now, f"{name}: gains {test.gain:.4g} nats (p = {test.p_value:.2g})"))

    def entered(self, step: ErrorStep, text: str) -> None:
        """A model joins the error history."""
        self.tell(ProgressEvent(self.now, text, step))

    def stage(self, name: str) -> None:
        """A stage of that name has ended; the time since the last stage ended is added to it."""
        now = time.monotonic()
        self.seconds[name] = self.seconds.get(name, 0.0) + now - self.since
        self.since = now
