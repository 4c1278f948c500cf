"""A model kept open for run after run, as a fit wants it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from pysim.simulate._check import check_arguments
from pysim.simulate._foreign import Opened, open_model
from pysim.simulate._request import Take
from pysim.simulate.esdirk import Esdirk
from pysim.simulate.sensitivity.orbit import Orbits
from pysim.simulate.sensitivity.periodic import Periodic, check_periodic, find_in
from pysim.simulate.sensitivity.sensitivities import Sensitivities, check_sensitivities, run_in
from pysim.types import Experiment, Model

Array = NDArray[np.float64]


class Runs:
    """What `sensitivities_many` and `periodic_many` do, with a library that stays open, asked once for what it offers.

    Made by `open_runs`. The results are those of the functions; arguments and errors are the same, too.

    Attributes:
        model: the one that is open.
    """

    def __init__(self, library: Opened) -> None:
        self.model, self._library = library.model, library

    def sensitivities(
        self,
        experiments: Sequence[Experiment],
        parameters: Sequence[str],
        *,
        offset: bool = False,
        takes: Sequence[Take | None] = (),
        solver: Esdirk = Esdirk(),  # noqa: B008
        workers: int | None = None,
        progress: Callable[[int, int], None] | None = None,
    ) -> tuple[Sensitivities, ...]:
        """Runs with their derivatives, as `sensitivities_many`.

        Args:
            takes: per run what is given its rows, stretch by stretch, where the kernel alone makes them: the number of
                the first row, values (n, n_y), and derivatives (n, n_y, n_x + n_p) by the offset, where that is asked
                for, and the parameters. The result has no rows then. The arrays are valid in the call only.
        """
        check_arguments("sensitivities", self.model, solver, Esdirk)
        ask = check_sensitivities(self.model, experiments, parameters, offset, solver, workers)
        return run_in(self._library, replace(ask, takes=tuple(takes)), progress) if experiments else ()

    def orbits(
        self,
        tests: Sequence[Periodic],
        parameters: Sequence[str] = (),
        *,
        guesses: Sequence[Array | None] = (),
        solver: Esdirk = Esdirk(),  # noqa: B008
        mismatch: float = 1e-3,
        workers: int | None = None,
        progress: Callable[[int, int], None] | None = None,
    ) -> Orbits | tuple[()]:
        """Periodic steady states, as `periodic_many`, but by shooting alone; each is made where it is asked for.

        Where shooting fails the outcome is NOT_PERIODIC: a search simulates the test over time instead, as
        the bench ran it: cheaper than to wait until it repeats, and a plant that settles so slowly had not settled.
        """
        check_arguments("orbits", self.model, solver, Esdirk)
        ask = check_periodic(self.model, tests, parameters, guesses, solver, mismatch, workers)
        return find_in(self._library, replace(ask, long_way=False), progress) if tests else ()


@contextmanager
def open_runs(model: Model) -> Iterator[Runs]:
    """A model-exchange FMU, open for the length of the block; for one thread at a time.

    Raises:
        BadInput: no model exchange, no binary for this machine, or an FMU that cannot be instantiated.
    """
    check_arguments("open_runs", model, Esdirk())
    with open_model(model) as library:
        yield Runs(library)
