"""What reads each grammar, as a check and a graph read it, with the budget of a file."""

from __future__ import annotations

import contextlib
import os
import resource
import tempfile
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import NamedTuple

from roslens.intake.file_budget import Slot, file_budget, watch, why_ended
from roslens.intake.time_budget import OverBudgetError
from roslens.model.source import Language
from roslens.source.extract.facts.launched import Unresolved
from shapes.shapes import SHAPES

LAUNCH = b"<launch><param name='robot_description' command='$(find xacro)/xacro $(find pkg)/robot.xacro'/></launch>"


class Files:
    """A workspace of one package with the same content under every name, but for some."""

    def __init__(self, content: bytes, **others: bytes) -> None:
        self._content, self._others = content, {name.replace("_", "."): text for name, text in others.items()}

    def package(self, name: str) -> str | None:
        return "pkg" if name == "pkg" else None

    def content(self, path: str) -> bytes | None:
        if not path.startswith("pkg/"):
            return None
        return self._others.get(path.rpartition("/")[2], self._content)

    def listing(self, _folder: str) -> tuple[str, ...]:
        return ()


def _source(content: bytes, language: Language, name: str) -> None:
    from roslens.source.extract.interpreter.vocabulary_index import indexed
    from roslens.source.extract.ir.program_codec import pack
    from roslens.source.extract.units.workspace_units import facts_of_workspace
    from roslens.source.measure import read_apart as apart
    from roslens.source.measure.analyse_file import analyse_parsed
    from roslens.source.over_budget import as_program
    from roslens.source.parsed_file import parse_file
    from roslens.source.settings import MacroSettings

    if len(content) > apart.LARGE_BYTES:
        try:
            apart.read_apart(apart.Asked(content, language, MacroSettings(), analysis=True, program=True))
        finally:
            if apart._held is not None:
                apart._held.end()
        return
    with file_budget(name, size=len(content)):
        parsed = parse_file(content, language, MacroSettings())
        analyse_parsed(content, parsed, None)
    with file_budget(as_program(name), size=len(content)):
        pack(parsed.program())
        facts_of_workspace(indexed({f"pkg/{name}": parsed.program()}))


def _manifest(content: bytes) -> None:
    from roslens.source.workspace.manifest import read_manifest
    from roslens.source.workspace.mistakes import mistakes_of

    with file_budget("package.xml", size=len(content)):
        read_manifest(content, "pkg/package.xml", {"ROS_VERSION": "2"})
        mistakes_of(content, "pkg/package.xml")


def _launch(content: bytes) -> None:
    from roslens.source.extract.launch.launch_ros1 import evaluate_ros1
    from roslens.source.extract.launch.launch_ros2 import evaluate_ros2

    files = Files(content)
    for result in (
        evaluate_ros1("pkg/launch/a.launch", files),
        evaluate_ros2("pkg/launch/a.launch.xml", files),
        evaluate_ros2("pkg/launch/a.launch.xml", files, any_arguments=True),
    ):
        _told(result.unresolved)


def _robot(content: bytes) -> None:
    from roslens.source.extract.launch.launch_ros1 import evaluate_ros1

    _told(evaluate_ros1("pkg/launch/a.launch", Files(content, a_launch=LAUNCH)).unresolved)


def _cmake(content: bytes) -> None:
    from roslens.model.source import Location, Package, SourceFile
    from roslens.source.extract.builds.targets import build_of
    from roslens.source.rules.views.cmake_view import CmakeView
    from roslens.source.rules.views.package_files import PackageFiles

    listing = ["pkg/CMakeLists.txt", "pkg/a.cpp", "pkg/package.xml"]
    _told(build_of("pkg", "pkg", "ament_cmake", Files(content), listing).unresolved)
    package = Package("pkg", "pkg", "pkg", Location("pkg/package.xml"), build_type="ament_cmake")
    files = (SourceFile("pkg/CMakeLists.txt", Language.CMAKE),)
    with file_budget("rules"):
        CmakeView(PackageFiles(package, "/nowhere", files, texts={"pkg/CMakeLists.txt": content}))


def _yaml(content: bytes) -> None:
    from roslens.model.errors import RoslensError
    from roslens.source.extract.launch.launch_ros2 import evaluate_ros2
    from roslens.source.extract.parameters.parameter_file import ros1_parameters, ros2_parameters

    for read in (ros1_parameters, ros2_parameters):
        try:
            with file_budget("a.yaml", size=len(content)):
                read(content, "a.yaml")
        except RoslensError:
            continue
    _told(evaluate_ros2("pkg/launch/a.launch.yaml", Files(content)).unresolved)


def _interface(content: bytes) -> None:
    from roslens.source.extract.interfaces.interface_file import read_interface

    for ending in ("msg", "srv", "action"):
        for generation in (1, 2):
            with file_budget(f"A.{ending}", size=len(content)):
                read_interface(content, f"pkg/{ending}/A.{ending}", "pkg", generation)


def _toml(content: bytes) -> None:
    from roslens.cli.workplace.configuration import read_configuration
    from roslens.model.errors import RoslensError
    from roslens.source.workspace.acceptances import read_acceptances

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "roslens.toml")
        path.write_bytes(content)
        try:
            read_configuration(path)
        except RoslensError as error:
            if "s of processor time" in str(error) or "of memory" in str(error):
                raise OverBudgetError(str(error)) from error
        _, failures = read_acceptances(path)
        for one in failures:
            if "s of processor time" in one.what:
                raise OverBudgetError(one.what)


def _document(content: bytes) -> None:
    from roslens.model.source import Location, Package
    from roslens.source.workspace.copied_packages import Candidate, copied_packages

    package = Package("pkg", "pkg", "pkg", Location("pkg/package.xml"))
    with file_budget("CHANGELOG.rst", size=len(content)):
        copied_packages([Candidate(package, lambda: content, own_checkout=False)], set())


def _told(unresolved: Iterable[Unresolved]) -> None:
    """Raise what a result says of a file that was left out."""
    for one in unresolved:
        if "s of processor time" in one.reason or "of memory" in one.reason:
            raise OverBudgetError(one.reason)


READERS: dict[str, Callable[[bytes], None]] = {
    "C++": lambda content: _source(content, Language.CPP, "a.cpp"),
    "Python": lambda content: _source(content, Language.PYTHON, "a.py"),
    "CMake": _cmake,
    "package.xml": _manifest,
    "launch files": _launch,
    "robot descriptions": _robot,
    "YAML": _yaml,
    "messages": _interface,
    "TOML": _toml,
    "documents": _document,
}


def read_shape(task: tuple[str, str, int]) -> None:
    """Read a shape of a grammar by its name and size, as a task of an engine."""
    grammar, name, size = task
    READERS[grammar](SHAPES[grammar][name](size))


def ready(grammar: str) -> None:
    """Import what a reader needs before processes are copied; sources need a moment more than nothing."""
    with contextlib.suppress(Exception):
        READERS[grammar](b"\n")


LIMITS = {
    "C++": 5_000_000, "Python": 5_000_000, "CMake": 2_000_000, "package.xml": 1 << 20, "launch files": 2_000_000,
    "robot descriptions": 2_000_000, "YAML": 2_000_000, "messages": 5_000_000, "TOML": 5_000_000, "documents": 1 << 20,
}  # fmt: skip
"""Bytes of the largest file that is read of each kind."""


class Measured(NamedTuple):
    """What reading took.

    Attributes:
        seconds: of a processor.
        megabytes: the largest that the process was.
        left_out: why the content was left out; empty if it was not.
        grown: by how many MB the process grew; it begins as large as the one that it is a copy of.
    """

    seconds: float
    megabytes: float
    left_out: str
    grown: float


class ReadError(Exception):
    """Reading failed with something that no reader may raise."""


def measured(grammar: str, content: bytes) -> Measured:
    """Read content in a process that this one watches.

    Raises:
        ReadError: it failed in another way than by exceeding its budget.
    """
    return measured_by(READERS[grammar], content, Slot())


def measured_by(read: Callable[[bytes], None], content: bytes, slot: Slot | None = None) -> Measured:
    """Read content in a process of its own, which is bounded where it has a slot.

    Raises:
        ReadError: it failed in another way than by exceeding its budget.
    """
    here, there = os.pipe()
    pid = os.fork()
    if pid == 0:
        _child(read, content, slot, there)
    os.close(there)
    with os.fdopen(here, "rb") as stream:
        pages = stream.readline()
        said = stream.read().decode()
    _, status, used = os.wait4(pid, 0)
    code = os.waitstatus_to_exitcode(status)
    why = said.removeprefix("over ") if said.startswith("over ") else why_ended(code)
    if said.startswith("error ") or (code and not why):
        raise ReadError(f"exit code {code}: {said.removeprefix('error ')}")
    began = int(pages) * resource.getpagesize() / 1e6
    largest = used.ru_maxrss * 1024 / 1e6
    return Measured(used.ru_utime + used.ru_stime, largest, why, largest - began)


def _child(read: Callable[[bytes], None], content: bytes, slot: Slot | None, answers: int) -> None:
    import faulthandler
    import traceback
    import warnings

    try:
        faulthandler.disable()
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        if slot is not None:
            watch(slot)
        os.write(answers, Path("/proc/self/statm").read_bytes().split()[1] + b"\n")
        said = ""
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                read(content)
        except OverBudgetError as error:
            said = f"over {error}"
        except BaseException:  # noqa: BLE001 - whatever it is, it was not to be
            said = f"error {traceback.format_exc(limit=-4)}"
        os.write(answers, said.encode("utf-8", "backslashreplace")[:60_000])
    finally:
        os._exit(0)
