"""Packing: OdeModel -> compiled, zipped, checked .fmu.

`pack` itself is in `pack.fmu`: it brings CasADi along, for which an FMU from the cache must not wait.
"""

from fmu_build.pack.archive import check_writable
from fmu_build.pack.compiler import CompilerError
from fmu_build.pack.platforms import PLATFORMS, Platform, host_platform, select_platforms

__all__ = ["PLATFORMS", "CompilerError", "Platform", "check_writable", "host_platform", "select_platforms"]
