"""The platforms an FMU can carry a binary for."""

import platform
import sys
from collections.abc import Sequence
from dataclasses import dataclass

from fmu_build.errors import BuildError


@dataclass(frozen=True)
class Platform:
    """An operating system on a processor.

    `name` is the platform tuple of FMI 3. `fmi2_folder` is that of FMI 2, which has none for ARM: there the tuple is
    used, as other tools do.
    """

    name: str
    zig_target: str
    fmi2_folder: str
    suffix: str

    def folder(self, fmi: int) -> str:
        return self.fmi2_folder if fmi == 2 else self.name


# Linux binaries ask for glibc 2.17 (2012) or later.
PLATFORMS = (
    Platform("x86_64-linux", "x86_64-linux-gnu.2.17", "linux64", ".so"),
    Platform("x86_64-windows", "x86_64-windows-gnu", "win64", ".dll"),
    Platform("x86_64-darwin", "x86_64-macos", "darwin64", ".dylib"),
    Platform("aarch64-linux", "aarch64-linux-gnu.2.17", "aarch64-linux", ".so"),
    Platform("aarch64-darwin", "aarch64-macos", "darwin64", ".dylib"),
)
_BY_NAME = {p.name: p for p in PLATFORMS}
_SYSTEMS = {"linux": "linux", "win32": "windows", "darwin": "darwin"}
_PROCESSORS = {"x86_64": "x86_64", "amd64": "x86_64", "arm64": "aarch64", "aarch64": "aarch64"}


def host_platform() -> Platform:
    """This machine. Raises BuildError where we cannot build for it."""
    system, processor = _SYSTEMS.get(sys.platform), _PROCESSORS.get(platform.machine().lower())
    found = _BY_NAME.get(f"{processor}-{system}")
    if found is None:
        raise BuildError(
            f"no binary can be built for this machine ({platform.machine()}, {sys.platform}); "
            f"choose a platform: {', '.join(_BY_NAME)}."
        )
    return found


def select_platforms(names: Sequence[str]) -> tuple[Platform, ...]:
    """The platforms named, each once and in the order of `PLATFORMS`; "host" and "all" are names too."""
    chosen: set[Platform] = set()
    for name in names:
        if name == "all":
            chosen.update(PLATFORMS)
        elif name == "host":
            chosen.add(host_platform())
        elif name in _BY_NAME:
            chosen.add(_BY_NAME[name])
        else:
            raise BuildError(f'unknown platform "{name}"; choose among host, all, {", ".join(_BY_NAME)}.')
    if not chosen:
        raise BuildError(f"no platform given; choose among host, all, {', '.join(_BY_NAME)}.")
    return tuple(p for p in PLATFORMS if p in chosen)
