"""The table of known answers: `python -m tests.known_answers`; with `--record COMMIT` it is stored beside the cases."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from typing import Any

from tests.known_answers.answer import Answer, ask
from tests.known_answers.case import CASES, Case, cases
from tests.known_answers.checks import CHECKS, asked

_MARK = "# Written by `python -m tests.known_answers --record COMMIT`: no test reads it."


def table_row(case: Case, answer: Answer) -> str:
    """Case, right, found, error over noise as designed and found on unseen logs and by its own account, what fails."""
    right = "+".join(case.right.get("effects", [])) or case.right["verdict"]
    found = f"{answer.data['verdict']} ({'+'.join(answer.effects)})" if answer.effects else answer.data["verdict"]
    wrong = [check for check in asked(case) if any(CHECKS[check](case, answer))]
    held = answer.data["error"][-1]["validate"]
    own = "     -" if held is None else f"{held:6.3f}"
    text = f"{case.name:<33} {right:<32} {found:<48} {answer.before:7.2f} {answer.after:7.3f} {own} {answer.cpu:5.1f}"
    return f"{text}  {', '.join(wrong) or 'right'}"


def today(case: Case, answer: Answer, commit: str) -> dict[str, Any]:
    """What is stored of an answer."""
    wrong = {check: "; ".join(CHECKS[check](case, answer)) for check in asked(case)}
    return {
        "commit": commit,
        "verdict": answer.data["verdict"],
        "effects": answer.effects,
        "shares": {effect: answer.share(effect) for effect in case.right.get("effects", [])},
        "estimates": {name: list(three) for name, three in answer.estimates.items()},
        "steps": [[step["step"], step["fit"], step["validate"]] for step in answer.data["error"]],
        "unseen": [answer.before, answer.after],
        "cpu": answer.cpu,
        "wrong": {check: text for check, text in wrong.items() if text},
    }


def record(case: Case, answer: Answer, commit: str) -> None:
    """Put what was answered in place of what stands at the end of the case's file."""
    path = CASES / f"{case.name}.toml"
    text = path.read_text(encoding="utf-8").partition(_MARK)[0].rstrip()
    rows = [f"{name} = {_toml(value)}" for name, value in today(case, answer, commit).items() if value not in ({}, [])]
    path.write_text("\n".join([text, "", _MARK, "[today]", *rows, ""]), encoding="utf-8")


def _toml(value: Any) -> str:
    """A value of a line; numbers of five digits, and a dash for nothing, which TOML has no word for."""
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f'"{name}" = {_toml(part)}' for name, part in value.items()) + " }"
    if isinstance(value, list):
        return f"[{', '.join(map(_toml, value))}]"
    if value is None:
        return '"-"'
    return f"{value:.5g}" if isinstance(value, float) else '"' + str(value).replace('"', "'") + '"'


def main(words: list[str]) -> None:
    """Print the table of all cases, or of those named; store the answers where a commit is given."""
    commit = words[words.index("--record") + 1] if "--record" in words else ""
    named = [word for word in words if word not in ("--record", commit)]
    print(f"{'case':<33} {'right':<32} {'found':<48} {'before':>7} {'after':>7} {'own':>6} {'CPU s':>5}  wrong")
    for case in cases():
        if named and not any(word in case.name for word in named):
            continue
        answer = ask(case)
        print(table_row(case, answer), flush=True)
        if commit:
            record(case, answer, commit)


if __name__ == "__main__":
    main(sys.argv[1:])
