"""The command `fmu-build`."""

import argparse
import io
import os
import sys
import tomllib
import traceback
from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path

from fmu_build.build import COMPILERS, build
from fmu_build.errors import BuildError, CannotCompile
from fmu_build.openmodelica import what_is_missing

DONE, WRONG_USE, OUR_BUG = 0, 2, 3
AUTO = "auto"

_EPILOG = """Example:
  fmu-build HydraulicTestBench.Examples.TimeResponse -o pump.fmu --set pump.K_p=12

Platforms: x86_64-linux, x86_64-windows, x86_64-darwin, aarch64-linux, aarch64-darwin, host, all.
The first build for a platform compiles the C library's start-up code: seconds, for Windows some minutes."""


def main(argv: Sequence[str] | None = None) -> int:
    """Exit code: 0 done, 2 wrong use or a model that cannot be built, 3 a mistake of ours."""
    _plug_output()
    if isinstance(sys.stdout, io.TextIOWrapper):  # a path may have letters that a pipe of Windows has not
        sys.stdout.reconfigure(errors="replace")
    parser = _parser()
    try:
        arguments = parser.parse_args(argv)
    except SystemExit as exit_:  # argparse has said what is wrong, or printed the help
        return exit_.code if isinstance(exit_.code, int) else WRONG_USE
    try:
        path = _build(arguments)
    except BuildError as error:
        print(f"fmu-build: {error}", file=sys.stderr)
        return WRONG_USE
    except KeyboardInterrupt:
        print("fmu-build: interrupted; nothing was written.", file=sys.stderr)
        return WRONG_USE
    except Exception as error:
        return _report_our_bug(error)
    return _say(path)


def _plug_output() -> None:
    """Where standard output is closed, let nothing else be opened in its place: whatever is printed would go there."""
    if sys.stdout is None:
        sys.stdout = os.fdopen(os.open(os.devnull, os.O_RDONLY), "w", closefd=False)


def _say(path: Path) -> int:
    try:
        print(path, flush=True)
    except OSError as error:
        print(f"fmu-build: {path} is there, but its name cannot be printed: {error.strerror}", file=sys.stderr)
        with suppress(OSError):  # or Python would complain once more when it ends
            os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
        return WRONG_USE
    return DONE


def _build(arguments: argparse.Namespace) -> Path:
    """By the compiler chosen; "auto" asks OpenModelica for what our own cannot take, where it is installed."""
    if arguments.compiler != AUTO:
        return _build_with(arguments.compiler, arguments)
    try:
        return _build_with("rumoca", arguments)
    except CannotCompile as error:
        missing = what_is_missing()
        if missing:
            advice = f"fmu-build: OpenModelica may take what our own compiler does not, but {missing}."
            raise CannotCompile(f"{error.message}\n{advice}", error.file, error.line) from None
        print(f"fmu-build: {error}\nfmu-build: now trying OpenModelica.", file=sys.stderr)
    return _build_with("openmodelica", arguments)


def _build_with(compiler: str, arguments: argparse.Namespace) -> Path:
    return build(
        arguments.class_name,
        Path(arguments.output or f"{arguments.class_name}.fmu"),
        libraries=[Path(library) for library in arguments.library],
        fmi=arguments.fmi,
        platforms=arguments.platform or ["host"],
        overrides={**_from_file(arguments.parameters), **_settings(arguments.set)},
        probes=arguments.probe,
        use_cache=not arguments.no_cache,
        compiler=compiler,
        omc_options=[] if arguments.compiler == AUTO and compiler == "rumoca" else arguments.omc_option,
    )


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="fmu-build",
        description="Compile a Modelica class to an FMU for model exchange and co-simulation.",
        epilog=_EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("class_name", metavar="CLASS", help="full name of the Modelica class")
    parser.add_argument("-o", "--output", metavar="FILE", help="FMU to write (default: CLASS.fmu here)")
    parser.add_argument(
        "--library", metavar="DIR", action="append", default=[], help="another library: a directory, or a .mo file"
    )
    parser.add_argument("--fmi", type=int, choices=(2, 3), default=2, help="FMI version (default: 2)")
    parser.add_argument("--platform", metavar="NAME", action="append", help="see below (default: host)")
    parser.add_argument(
        "--set", metavar="NAME=VALUE", action="append", default=[], help="start value of a parameter, in SI units"
    )
    parser.add_argument(
        "--parameters", metavar="FILE.toml", help="lines NAME = VALUE, as pysim fit leaves them; --set goes before"
    )
    parser.add_argument(
        "--probe",
        metavar="NAME",
        action="append",
        default=[],
        help="add an input probe.NAME to the equation of a variable, or of a state's derivative; 0 changes nothing",
    )
    parser.add_argument(
        "--compiler",
        choices=(AUTO, *COMPILERS),
        default=AUTO,
        help="rumoca with our own run-time system, or openmodelica (an installed omc, and pip install OMPython); "
        "auto, the default, asks the second for what the first cannot take",
    )
    parser.add_argument(
        "--omc-option",
        metavar="OPTION",
        action="append",
        default=[],
        help="for OpenModelica: an option of omc's command line, as --omc-option=--maxSizeLinearTearing=400; repeat",
    )
    parser.add_argument("--no-cache", action="store_true", help="build even if the same FMU has been built before")
    return parser


def _from_file(name: str | None) -> dict[str, float | str]:
    """Numbers of a TOML file; dotted names and sections mean the same."""
    if name is None:
        return {}
    try:
        content = tomllib.loads(Path(name).read_text(encoding="utf-8-sig"))
    except OSError as error:
        raise BuildError(f"--parameters {name}: cannot be read ({error.strerror}); correct the name.") from error
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise BuildError(f"--parameters {name}: {error}; write lines NAME = VALUE.") from error
    except RecursionError as error:
        raise BuildError(f"--parameters {name}: it is nested too deeply; write lines NAME = VALUE.") from error
    return _numbers(content, "", name)


def _numbers(table: Mapping[str, object], prefix: str, name: str) -> dict[str, float | str]:
    values: dict[str, float | str] = {}
    for key, value in table.items():
        if isinstance(value, Mapping):
            values |= _numbers(value, f"{prefix}{key}.", name)
        elif isinstance(value, int | float) and not isinstance(value, bool):
            values[prefix + key] = value
        else:
            raise BuildError(f"--parameters {name}: {prefix + key} = {value!r} is no number; write NAME = VALUE.")
    return values


def _settings(texts: Sequence[str]) -> dict[str, float | str]:
    values: dict[str, float | str] = {}
    for text in texts:
        name, value = _setting(text)
        if name in values:
            raise BuildError(f"--set {text}: {name} is set twice; give it once.")
        values[name] = value
    return values


def _setting(text: str) -> tuple[str, float | str]:
    """ "a.b=3" -> ("a.b", 3), fit for Integer and Real alike; what is no number is Modelica text, such as true."""
    name, equals, value = (part.strip() for part in text.partition("="))
    if not name or not equals or not value:
        raise BuildError(f'--set {text}: expected NAME=VALUE, such as "--set pump.K_p=12".')
    for number in (int, float):
        try:
            return name, number(value)
        except ValueError:
            continue
    return name, value


def _report_our_bug(error: Exception) -> int:
    print(
        f"fmu-build: a mistake of ours, not of your model: {type(error).__name__}: {error}\n"
        "Please report it with the class; HTB_DEBUG=1 shows where it happened.",
        file=sys.stderr,
    )
    if os.environ.get("HTB_DEBUG"):
        traceback.print_exc()
    return OUR_BUG
