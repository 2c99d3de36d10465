"""The tool ``clang_tidy``: C++ as the compiler understands it; needs a build's ``compile_commands.json``."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path, PurePosixPath
from typing import Any

import msgspec

from roslens.intake.bounded_file import read_bounded
from roslens.intake.safe_yaml import MOST_BYTES, UnsafeYamlError, load_yaml
from roslens.model.source import SourceFile
from roslens.plugins.points import Option
from roslens.source.tools.compiling.compile_commands import Command, as_json, find_databases, merged
from roslens.source.tools.compiling.compile_flags import allowed_flags
from roslens.source.tools.running.run_tool import Ended, ToolError
from roslens.source.tools.tool import Reading, Request, Tool, ToolFinding, below_root, unreadable

_FINDING = re.compile(
    r"(?P<path>[^:\n]+):(?P<line>\d+):(?P<column>\d+): (?:warning|error): (?P<message>.*) \[(?P<check>[\w.,+-]+)\]$"
)
_FAILED = re.compile(r"Error while processing (?P<path>.*)\.$")
_ERROR = re.compile(r"(?:.*: )?error: (?P<message>.*) \[clang-diagnostic-error\]$")
_HEADERS = frozenset({".h", ".hh", ".hpp", ".hxx", ".h++", ".ipp", ".tpp", ".inl"})
NOT_COMPILED = "not-compiled"
CHECKS = (
    "-*",
    "bugprone-*",
    "-bugprone-easily-swappable-parameters",
    "clang-analyzer-*",
    "concurrency-*",
    "performance-*",
)
"""The checks unless the project or the user configures them."""


class Build(msgspec.Struct, frozen=True):
    """How the files of a workspace are compiled, by their paths below the root."""

    commands: dict[str, Command]
    own_checks: bool


class ClangTidy(Tool):
    """C++ with types; about 30 to 100 lines a second."""

    name = "clang_tidy"
    program = "clang-tidy"
    text = "Checks of the Clang compiler and its static analyzer; needs a build with compile_commands.json."
    get = "apt install clang-tidy"
    languages = ("c", "cpp")
    version_pattern = r"LLVM version (\d+(?:\.\d+)+)"
    oldest = (10,)
    settings_files = (".clang-tidy",)
    whole_packages = True
    across_packages = True
    at_once = 8
    options = (
        Option("checks", "list", "Checks, as clang-tidy's --checks; empty: .clang-tidy, else what finds bugs.", []),
        Option(
            "database", "list", "compile_commands.json files, below the workspace; empty: those in build folders.", []
        ),
        Option("headers", "str", "Regular expression of the headers in which findings are reported.", ".*"),
    )

    def shapes(self, file: SourceFile) -> bool:
        """Return whether other files may include it."""
        return PurePosixPath(file.path).suffix.lower() in _HEADERS

    def prepared(
        self, root: str, files: Sequence[SourceFile], options: Mapping[str, Any], *, own_settings: bool
    ) -> Any:
        """Return how the files are compiled."""
        found = find_databases(root, options["database"])
        if not found:
            raise ToolError(
                "finds no compile_commands.json; build with "
                "`--cmake-args -DCMAKE_EXPORT_COMPILE_COMMANDS=ON`, or name one in [options.clang_tidy] database"
            )
        database = merged(found)
        commands = {}
        for file in files:
            if self.reads(file):
                real = os.path.realpath(os.path.join(root, file.path))  # noqa: PTH118
                if (command := database.commands.get(real)) is not None:
                    commands[file.path] = command
        if not commands:
            unread = f" ({database.unread[0]})" if database.unread else ""
            raise ToolError(f"finds no command for any file in {found[0]}{unread}; build the workspace again")
        if not own_settings:
            return Build(commands, own_checks=False)
        found_settings = _settings_files({command.file for command in commands.values()})
        for path in found_settings:
            if what := refused_by(path):
                raise ToolError(f"is given {what!r} by {path}, which does more than shape what code means; remove it")
        return Build(commands, bool(found_settings))

    def covers(self, file: SourceFile, beside: Any) -> bool:
        """Return whether the build defines how a file is compiled; headers are checked where they are included."""
        return file.path in beside.commands

    def part_of(self, file: SourceFile, beside: Any) -> Any:
        """Return how the file is compiled, and whose checks count."""
        return (beside.commands.get(file.path), beside.own_checks)

    def uncovered(self, file: SourceFile) -> str:
        """Return why a file that it reads is left out; nothing for a header."""
        return "" if self.shapes(file) else "has no command in compile_commands.json"

    def words(self, request: Request) -> list[str]:
        """Return the call, with a database of its files alone."""
        build: Build = request.beside
        wanted = {build.commands[file.removeprefix("./")].file: None for file in request.files}
        database = {command.file: command for command in build.commands.values()}
        Path(request.scratch, "compile_commands.json").write_bytes(as_json(database, wanted))
        checks = request.options["checks"] or ([] if build.own_checks else CHECKS)
        return [
            request.program,
            "-p",
            request.scratch,
            "--quiet",
            f"--header-filter={request.options['headers']}",
            *([f"--checks={','.join(checks)}"] if checks else []),
            # Settings on the command line take the place of all .clang-tidy.
            *([] if request.own_settings else ["--config={}"]),
            *wanted,
        ]

    def read(self, ended: Ended, request: Request) -> Reading:
        """Read findings from standard output; a file that does not compile is a finding, too."""
        reported = ended.stderr.decode("utf-8", "replace")
        if "no checks enabled" in reported.lower():
            raise ToolError("has no checks to run: set [options.clang_tidy] checks, or Checks in .clang-tidy")
        found: list[ToolFinding] = []
        wrong: list[str] = []
        for line in ended.stdout.decode("utf-8", "replace").splitlines():
            if match := _ERROR.match(line):
                wrong.append(match["message"])
            elif match := _FINDING.match(line):
                path = below_root(match["path"], request.root)
                for check in match["check"].split(","):
                    if check != "-warnings-as-errors":
                        place = (path, int(match["line"]), int(match["column"]))
                        found.append(ToolFinding(*place, check, match["message"], level="warning"))
        failed = [match["path"] for match in map(_FAILED.match, reported.splitlines()) if match]
        if ended.code and not found and not wrong and not failed:
            raise unreadable(ended.stdout + ended.stderr, "diagnostics of Clang")
        reason = wrong[0] if wrong else "no reason given"
        message = f"does not compile here ({reason}): findings of the file may be incomplete"
        found += [ToolFinding(below_root(path, request.root), 0, 0, NOT_COMPILED, message) for path in failed]
        return Reading(tuple(found))


def _settings_files(paths: Iterable[str]) -> list[Path]:
    """Return the settings in the folders of files, by their real paths, and above."""
    folders = {parent for path in paths for parent in PurePosixPath(path).parents}
    found = (Path(folder, ".clang-tidy") for folder in sorted(folders))
    return [path for path in found if path.is_file()]


def refused_by(path: Path) -> str:
    """Return the first argument of settings that does more than shape what code means; empty for none."""
    try:
        settings = load_yaml(read_bounded(path, MOST_BYTES))
    except (OSError, UnsafeYamlError) as error:
        return str(error)
    if not isinstance(settings, Mapping):
        return ""
    for key in ("ExtraArgs", "ExtraArgsBefore"):
        given = settings.get(key)
        words = [str(word) for word in given] if isinstance(given, Sequence) else []
        kept = list(allowed_flags(words))
        if kept != words:
            return next((word for word, other in zip(words, [*kept, ""], strict=False) if word != other), words[0])
    return ""


plugin = ClangTidy()
