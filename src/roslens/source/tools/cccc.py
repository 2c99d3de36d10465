"""The plug-in ``cccc``: C and C++ packages as the 2016 study of ROS repositories measured them.

It runs the program cccc (Debian's package ``cccc``) on each file alone. One run takes about ten milliseconds; files
must not be given together, for the study's numbers come from files that do not see each other.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.intake.bounded_file import read_bounded
from roslens.plugins.points import INTERFACE_VERSION, FileInput, Manifest, Option, PackageInput, Report
from roslens.source.tools.cccc_quantities import CCCC_QUANTITIES

if TYPE_CHECKING:
    from pathlib import Path

    from roslens.source.tools.paper2016 import StudiedFile

TIME_LIMIT_S = 20.0
"""Seconds of a processor: what else the machine does must not decide which files have values."""

PATIENCE = 2.5
"""How many times as long it may take by the clock; in all less than the hook of a plug-in may."""


class Cccc:
    """Measures packages with cccc; its quantities are those of the model ``paper2016``."""

    manifest = Manifest(
        name="cccc",
        interface=INTERFACE_VERSION,
        version="1.0",
        text="Measures C and C++ with the program cccc, as the 2016 study of ROS repositories did.",
        scopes=("package",),
        languages=("c", "cpp"),
        needs=("program:cccc",),
        quantities=CCCC_QUANTITIES,
        options=(Option("time_limit_s", "float", "Seconds of a processor for one file.", TIME_LIMIT_S),),
    )

    def analyse_package(self, package: PackageInput, report: Report) -> None:
        """Measure the files of a package that the study would have looked at, its classes, functions and itself."""
        from roslens.children.scratch_folder import ScratchFolder
        from roslens.source.tools.paper2016 import is_studied

        files = [file for file in package.files if is_studied(_below(file.path, package.package.path))]
        studied: list[StudiedFile] = []
        with ScratchFolder("cccc") as scratch:
            for number, file in enumerate(sorted(files, key=lambda file: file.path)):
                _study(file, f"{scratch}/{number}", package.options, report, studied)
        _measure(package, studied, complete=len(studied) == len(files), report=report)


plugin = Cccc()


def run_cccc(source: Path, scratch: Path, *, time_limit_s: float = TIME_LIMIT_S) -> Path:
    """Run cccc on one file and return the folder with its report.

    The file is given under a plain name, because what cccc makes of unusual ones is not known.

    Args:
        source: the file.
        scratch: a folder that does not exist yet.
        time_limit_s: seconds of a processor after which it is ended, as after :data:`PATIENCE` times as many by the
            clock; the kernel counts whole ones.

    Raises:
        CcccError: it could not be started, did not end, or ended with an error.
    """
    import shutil
    import signal

    from roslens.children.sandbox import Sandbox, program_folders
    from roslens.source.tools.cccc_report import CcccError
    from roslens.source.tools.running.run_tool import ToolError, ToolHangError, ToolRunner

    program = shutil.which("cccc")
    if program is None:
        raise CcccError("it cannot be started: No such file or directory")
    scratch.mkdir()
    plain = scratch / f"source{source.suffix}"
    plain.symlink_to(source.absolute())
    out = scratch / "out"
    patience_s = PATIENCE * time_limit_s
    try:
        ended = ToolRunner().run(
            [program, f"--outdir={out}", str(plain)],
            folder=str(scratch),
            time_limit_s=patience_s,
            processor_s=time_limit_s,
            sandbox=Sandbox(read=(str(source.resolve()),), run=program_folders(program), write=(str(scratch),)),
        )
    except ToolHangError:
        raise CcccError(f"it did not end within {patience_s:g} s") from None
    except ToolError as error:
        raise CcccError(f"it {error}") from None
    if ended.code == -signal.SIGXCPU:
        raise CcccError(f"it did not end within {time_limit_s:g} s of a processor")
    if ended.code:
        how = f"signal {-ended.code}" if ended.code < 0 else f"exit code {ended.code}"
        raise CcccError(f"it ended with {how}: {_last_line(ended.stderr)}")
    return out


def _study(
    file: FileInput, scratch: str, options: dict[str, object], report: Report, studied: list[StudiedFile]
) -> None:
    from pathlib import Path

    from roslens.source.tools.cccc_report import CcccError, read_report
    from roslens.source.tools.halstead2015 import halstead_volume
    from roslens.source.tools.paper2016 import StudiedFile

    time_limit_s = float(str(options.get("time_limit_s") or TIME_LIMIT_S))

    def study() -> None:
        source = Path(file.absolute)
        try:
            volume = halstead_volume(read_bounded(source))
            folder = run_cccc(source, Path(scratch), time_limit_s=time_limit_s)
            studied.append(StudiedFile(file.path, read_report(folder), volume))
        except (CcccError, OSError) as error:
            report.failure(
                f"cccc has no report of {file.path!r}: {error}",
                expected="an XML report",
                advice="The file and its package as a whole have no paper2016 values",
            )

    # A part of its own, so that the time limit of the hook is one for each file.
    report.attempt(f"cccc on {file.path}", study, path=file.path, always=True)


def _measure(package: PackageInput, studied: list[StudiedFile], *, complete: bool, report: Report) -> None:
    from roslens.source.tools.cccc_match import matched_values
    from roslens.source.tools.paper2016 import file_values, package_values

    for file in studied:
        for key, value in file_values(file).items():
            report.measurement(key, value, entity=f"file:{file.path}")
    for entity, values in sorted(matched_values(package.entities, studied).items()):
        for key, value in values.items():
            report.measurement(key, value, entity=entity)
    if complete:
        for key, value in package_values(studied).items():
            report.measurement(key, value)


def _below(path: str, folder: str) -> str:
    return path if folder in {"", "."} else path.removeprefix(f"{folder}/")


def _last_line(output: bytes) -> str:
    lines = output.decode("utf-8", "replace").strip().splitlines()
    return lines[-1][:200] if lines else "no message"
