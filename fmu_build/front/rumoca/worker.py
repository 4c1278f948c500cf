"""Runs rumoca in a process of its own: where its native code aborts, only that process ends.

A request comes as JSON on stdin, the answer goes as JSON to stdout. It is started as a script and imports nothing of
this package.
"""

import json
import os
import sys
from typing import Any


def answer(request: dict[str, Any]) -> dict[str, Any]:
    """Compile `text` with the library folders `roots`.

    Returns:
        `forms`, the DAE and the flat form of the class `name`; or `failure`, what rumoca says, whether it is a `panic`,
        and `syntax`: file, line and message of the first syntax error in `files`, if that is what it complains of.
    """
    import rumoca

    try:
        session = rumoca.Session(roots=request["roots"])
        model = session.loads(request["text"], model=request["name"], filename=request["file_name"])
        return {"forms": [model.to_dict("dae"), model.to_dict("flat")]}
    except BaseException as failure:  # a panic in rumoca is no Exception
        if isinstance(failure, KeyboardInterrupt | SystemExit):
            raise
        text, panic = str(failure), type(failure).__name__ == "PanicException"
        return {"failure": text, "panic": panic, "syntax": _syntax_error(text, request["files"], rumoca)}


def _syntax_error(text: str, files: list[str], rumoca: Any) -> list[Any] | None:
    """rumoca names the place of a syntax error only when asked to validate the file."""
    if not any(sign in text for sign in ("unexpected", "parse source-root", "parse failed")):
        return None
    for file in files:
        for found in rumoca.validate(file):
            if found.rule == "syntax-error":
                return [file, found.line, found.message]
    return None


def written(found: dict[str, Any]) -> str:
    """An answer as JSON; json.dump, which writes part by part, would take three times as long."""
    try:
        return json.dumps(found)
    except RecursionError:
        failure = "an expression is nested too deeply; split it into several equations"
        return json.dumps({"failure": failure, "panic": False, "syntax": None})


if __name__ == "__main__":
    if sys.platform == "linux":  # one array of a billion numbers must not take the machine; 0.3 GB is our largest model
        import resource

        most, hard = 4_000_000_000, resource.getrlimit(resource.RLIMIT_AS)[1]
        resource.setrlimit(resource.RLIMIT_AS, (most if hard == resource.RLIM_INFINITY else min(most, hard), hard))
    sys.modules["IPython"] = None  # type: ignore[assignment] # rumoca would load it, which takes longer than all else
    out = os.dup(1)
    os.dup2(2, 1)  # whatever native code prints is no part of the answer
    with open(out, "w", encoding="utf-8") as stream:
        stream.write(written(answer(json.load(sys.stdin.buffer))))
