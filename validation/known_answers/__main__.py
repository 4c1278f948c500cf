"""Store in today.json what this commit has answered so far: `python -m validation.known_answers`."""

from __future__ import annotations

import json
from typing import Any

from fmu_build.version import this_commit
from pysim.io import write_file
from validation.known_answers.answers import TODAY, kept
from validation.known_answers.case import findings
from validation.known_answers.machines import MACHINES


def stored(commit: str) -> dict[str, Any]:
    """Verdict, effects, error by step, and what is wrong, of each machine that was run."""
    rows: dict[str, Any] = {}
    for name, machine in MACHINES.items():
        found = kept(name)
        if found is not None:
            claims = list(findings(name, machine, found))
            rows[name] = {
                "verdict": found["verdict"],
                "effects": {one["effect"]: _short(one["parameters"]) for one in found["added"]},
                "error": {step["step"]: _short([step["fit"], step["validate"]]) for step in found["error"]},
                "missing": [[one["slot"], one["depends_on"], _short(one["share"])] for one in found["missing"][:3]],
                "claims": [claim.outcome for claim in claims],
                "fails": [claim.outcome for claim in claims if not claim.holds],
                "cpu": round(found["cpu"]),
            }
    return {"commit": commit, "not_run": [name for name in MACHINES if name not in rows], "answers": rows}


def _short(value: Any) -> Any:
    """Numbers of six digits."""
    if isinstance(value, dict):
        return {name: _short(part) for name, part in value.items()}
    if isinstance(value, list):
        return [_short(part) for part in value]
    return float(f"{value:.6g}") if isinstance(value, float) else value


if __name__ == "__main__":
    found = stored(this_commit())
    rows = ",\n".join(f"  {json.dumps(name)}: {json.dumps(row)}" for name, row in found.pop("answers").items())
    write_file(TODAY, f'{json.dumps(found)[:-1]},\n "answers": {{\n{rows}\n }}}}\n')
