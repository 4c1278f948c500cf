"""All checks by name, in the order in which they run: what is cheap and static first, what may crash last."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from types import MappingProxyType

from pysim.fmu_check.call_order import abuse_checks
from pysim.fmu_check.dependencies import check_dependencies
from pysim.fmu_check.derivatives import check_derivatives
from pysim.fmu_check.effects import check_effects
from pysim.fmu_check.instances import check_instances
from pysim.fmu_check.restore import check_restore
from pysim.fmu_check.result import CheckResult
from pysim.fmu_check.runs import check_order, check_runs
from pysim.fmu_check.starts import check_starts
from pysim.fmu_check.static import check_description
from pysim.fmu_check.subject import Subject

Check = Callable[[Subject], Iterator[CheckResult]]

CHECKS: Mapping[str, Check] = MappingProxyType(
    {
        "description": check_description,
        "start values": check_starts,
        "derivatives": check_derivatives,
        "dependencies": check_dependencies,
        "parameters": check_effects,
        "restore": check_restore,
        "instances": check_instances,
        "runs": check_runs,
        "order": check_order,
        **abuse_checks(),
    }
)
