"""A Python class named in a file: of an installed module, or of a .py file beside it."""

from __future__ import annotations

import importlib
import importlib.util
import inspect
import sys
from pathlib import Path
from types import ModuleType
from typing import Any

from pysim.types import BadInput


def python_class(text: str, folder: Path, place: str) -> Any:
    """The class, or function that makes one.

    Args:
        text: "package.module.Class", or "file.py:Class" with the file relative to `folder`.
        place: file and line that name it, for messages.
    Raises:
        BadInput: another form, or nothing of that name; what the module itself raises comes with it.
    """
    file, colon, name = text.rpartition(":")
    where, _, last = (file, colon, name) if colon else text.rpartition(".")
    if not where or not last.isidentifier():
        raise BadInput(f'{place}: {text!r} names no class; write "package.module.Class" or "file.py:Class"')
    if colon and not (folder / where).is_file():
        raise BadInput(f"{place}: there is no file {folder / where}; correct the name")
    try:
        module = _from_file(folder / where) if colon else importlib.import_module(where)
    except BadInput:
        raise
    except Exception as error:  # whatever the module does while it is imported
        raise BadInput(f"{place}: {where} cannot be imported ({type(error).__name__}: {error}); mend it") from error
    found = getattr(module, last, None)
    if not callable(found):
        raise BadInput(f"{place}: {where} has no class {last!r}; its classes: {', '.join(_classes(module)) or 'none'}")
    return found


def _classes(module: ModuleType) -> list[str]:
    """Those it defines itself, and those that a package offers as its own."""
    offered = getattr(module, "__all__", ())
    classes = {name: value for name, value in vars(module).items() if isinstance(value, type)}
    return sorted(name for name, value in classes.items() if name in offered or value.__module__ == module.__name__)


def _from_file(path: Path) -> ModuleType:
    path = path.resolve()
    name = f"_pysim_{path.stem}_{abs(hash(str(path))):x}"
    specification = importlib.util.spec_from_file_location(name, path)
    if specification is None or specification.loader is None:
        raise BadInput(f"{path} is no Python file; name one that ends in .py")
    module = importlib.util.module_from_spec(specification)
    sys.modules[name] = module  # dataclasses look their module up there
    try:
        specification.loader.exec_module(module)
    except BaseException:
        del sys.modules[name]
        raise
    return module


def made(make: Any, settings: dict[str, Any], text: str, place: str) -> Any:
    """What the class gives for these settings.

    Raises:
        BadInput: it does not take them.
    """
    try:
        return make(**settings)
    except BadInput as error:
        raise BadInput(f"{place}: {error}") from error
    except (TypeError, ValueError) as error:
        raise BadInput(f"{place}: {text} does not take these settings ({error}); {_takes(make)}") from error


def _takes(make: Any) -> str:
    try:
        names = ", ".join(inspect.signature(make).parameters)
    except (TypeError, ValueError):  # some written in C tell nothing
        return "correct them"
    return f"it takes {names}" if names else "it takes none"
