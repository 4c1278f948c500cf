"""The list of what rumoca does wrong is for the version that is installed, and holds every check there is."""

import importlib
import pkgutil
from importlib.metadata import version

from fmu_build.front.rumoca import refused
from fmu_build.front.rumoca.refusals import FAILED, FORM, MODEL, TEXT


def test_each_was_seen_in_the_version_that_is_used() -> None:
    """With another version of rumoca each has to be looked at, and kept with that version or taken away."""
    listed = [*TEXT, *FORM, *MODEL, *FAILED]
    assert {refusal.version for refusal in listed} == {version("rumoca")}
    assert len({refusal.wrong for refusal in listed}) == len(listed)


def test_each_file_of_checks_is_listed() -> None:
    listed = {refusal.check.__module__ for refusal in (*TEXT, *FORM, *MODEL, *FAILED)}
    files = {module.name for module in pkgutil.iter_modules(refused.__path__, f"{refused.__name__}.")}
    assert listed == files
    assert all(importlib.import_module(name).__doc__ for name in files)
