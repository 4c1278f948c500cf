"""OpenModelica as the compiler: a class to a checked FMU by an installed `omc`, driven through OMPython.

`translate` itself is in `openmodelica.translate`: it brings parts along for which an FMU from the cache must not wait.
"""

from fmu_build.openmodelica.installation import omc_version, what_is_missing

__all__ = ["omc_version", "what_is_missing"]
