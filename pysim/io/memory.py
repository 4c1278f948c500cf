"""A bound on the memory that reading a file may take, held by the system: what a file says of itself may be a lie."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from threading import Lock

_SIZE = Path("/proc/self/statm")  # Linux: pages of address space, first
_one_at_a_time = Lock()  # the bound is of the whole process


@contextmanager
def memory_bound(more: int) -> Iterator[None]:
    """Let this process take `more` bytes beyond what it has; an allocation that goes further fails there.

    Linux counts address space; elsewhere nothing is bound. Other threads share the bound while it holds, so it is to
    leave room for what they need.

    Raises:
        MemoryError: from within, where more is asked for.
    """
    if sys.platform != "linux":
        yield
        return
    import resource

    with _one_at_a_time:
        soft, hard = resource.getrlimit(resource.RLIMIT_AS)
        bound = int(_SIZE.read_text(encoding="ascii").split()[0]) * resource.getpagesize() + more
        lower = [bound, *(limit for limit in (soft, hard) if limit != resource.RLIM_INFINITY)]
        resource.setrlimit(resource.RLIMIT_AS, (min(lower), hard))
        try:
            yield
        finally:
            resource.setrlimit(resource.RLIMIT_AS, (soft, hard))
