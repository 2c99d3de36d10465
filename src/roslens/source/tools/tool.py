"""What a foreign tool declares: which program, which files it reads, how it is called and how its output is read.

A tool of ours is one file in this folder with an object ``plugin``, and a data file of the same name
(``.checks.toml``) that says how much each of its checks matters, see :mod:`~roslens.source.tools.checks.tool_checks`.
:mod:`~roslens.source.tools.running.tool_stage` runs it: many files a process, nothing that is known.
"""

from __future__ import annotations

import re
from abc import ABC, abstractmethod
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import msgspec

from roslens.model.edit import Edit
from roslens.model.source import Role, SourceFile
from roslens.plugins.points import INTERFACE_VERSION, Manifest, Option
from roslens.source.tools.running.run_tool import Ended, ToolError, ended_how

SCOPE = "tool"
"""Scope of a manifest whose plug-in is a foreign tool."""

READ_ROLES = frozenset({Role.OWN, Role.TEST})
"""Roles of the files that tools look at: what others wrote or a program made is none of the team's to mend."""


class ToolFinding(msgspec.Struct, frozen=True, array_like=True, gc=False, order=True):
    """What a tool reports; ``path`` is below the workspace root, ``level`` the severity it gave, if any."""

    path: str
    line: int
    column: int
    check: str
    message: str
    end_line: int = 0
    end_column: int = 0
    level: str = ""


class Request(msgspec.Struct, frozen=True):
    """One call of a tool.

    Attributes:
        program: absolute path of the program.
        root: absolute path of the workspace, the current folder of the process.
        files: paths below ``root``, each beginning with ``./`` so that none looks like an option.
        options: what the user set for the tool, with defaults.
        scratch: an empty folder for this call.
        packages: folders of all packages below ``root``, by name.
        beside: of the tool's own, for all calls; see :meth:`Tool.prepared`.
        group: of the files, see :meth:`Tool.group_of`.
        own_settings: whether it may read its settings files in the workspace and above: the user trusts them.
    """

    program: str
    root: str
    files: tuple[str, ...]
    options: Mapping[str, Any]
    scratch: str
    packages: Mapping[str, str] = {}
    beside: Any = None
    group: str = ""
    own_settings: bool = False


class Reading(msgspec.Struct, frozen=True):
    """The content of the output of one call.

    ``skipped`` maps files that the tool could not look at to what it says of them; ``trouble`` is what else it
    complains about, while its findings stand.
    """

    findings: tuple[ToolFinding, ...] = ()
    skipped: dict[str, str] = {}
    trouble: tuple[str, ...] = ()


class ToolFix(msgspec.Struct, frozen=True):
    """The fix of a finding of a tool: the finding's place as the tool reports it, and the edits of its file.

    A ``column`` of 0 is any: what the tool reports once a line is mended as a whole.
    """

    path: str
    line: int
    column: int
    check: str
    edits: tuple[Edit, ...]


class Tool(ABC):
    """A foreign tool; a subclass is one file in this folder."""

    name = ""
    program = ""
    text = ""
    get = ""
    """How a user gets the program, as the end of a sentence: ``pip install …``."""

    languages: tuple[str, ...] = ()
    options: tuple[Option, ...] = ()
    version_words: tuple[str, ...] = ("--version",)
    """How the program is asked for its version; empty for one without a version, which is identified by its file."""

    version_pattern = r"(\d+(?:\.\d+)+)"
    oldest: tuple[int, ...] = ()
    """The oldest version that was tried."""

    settings_files: tuple[str, ...] = ()
    """Names of files in the folder of a source file, or above it, that shape what is reported once they are trusted."""

    whole_packages = False
    """Whether a finding in a file may depend on the other files of its package."""

    across_packages = False
    """Whether it may depend on files of other packages."""

    at_once = 400
    """Files that one call gets at most."""

    parallel = True
    """Whether several calls may share the work; no for a tool that uses all processors by itself."""

    safe_path = True
    """Whether it runs where Python leaves the folder of a script off the path."""

    in_scratch = False
    """Whether its current folder is the scratch, as it looks for parts of its own in the current one."""

    asks_the_net = False
    """Whether it fetches anything: ``all`` does not stand for such a tool, it must be named."""

    fixes_at_once = 0
    """Files that one call which asks for fixes gets at most; 0 for a tool that has none, or none that are safe."""

    clean_codes: frozenset[int] = frozenset({0, 1})
    """Exit codes of a call that did its work."""

    @property
    def manifest(self) -> Manifest:
        """What the plug-in seam is given."""
        return Manifest(
            name=self.name,
            interface=INTERFACE_VERSION,
            version="1.0",
            text=self.text,
            scopes=(SCOPE,),
            languages=self.languages,
            needs=(f"program:{self.program}",),
            options=self.options,
        )

    def reads(self, file: SourceFile) -> bool:
        """Return whether it looks at a file."""
        return file.language.value in self.languages and file.role in READ_ROLES

    def shapes(self, file: SourceFile) -> bool:
        """Return whether its results for *other* files may depend on a file."""
        return self.reads(file)

    def prepared(  # noqa: B027 - most tools need nothing
        self, root: str, files: Sequence[SourceFile], options: Mapping[str, Any], *, own_settings: bool
    ) -> Any:
        """Return what all calls share; see :meth:`part_of` for what of it results depend on.

        ``own_settings`` is that of :class:`Request`.

        Raises:
            ToolError: it cannot look at this workspace; the text states why, and what would help.
        """

    def covers(self, file: SourceFile, beside: Any) -> bool:  # noqa: ARG002 - most tools need nothing
        """Return whether it can look at a file that it reads, by what was :meth:`prepared`."""
        return self.reads(file)

    def part_of(self, file: SourceFile, beside: Any) -> Any:  # noqa: ARG002 - whole, where a tool does not say
        """Return what of that which was :meth:`prepared` shapes what is said of a file."""
        return beside

    def group_of(self, file: SourceFile) -> str:  # noqa: ARG002 - one, where a tool does not say
        """Return what the files of one call have in common."""
        return ""

    def uncovered(self, file: SourceFile) -> str:
        """Return why a file that it reads and does not cover is left out; empty where that is no loss."""
        return f"does not cover {file.path}"

    @abstractmethod
    def words(self, request: Request) -> list[str]:
        """Return the program with its arguments."""

    def variables(self, request: Request) -> Mapping[str, str]:  # noqa: ARG002 - most tools need none
        """Return variables of the environment of a call that are others than the user's."""
        return {}

    @abstractmethod
    def read(self, ended: Ended, request: Request) -> Reading:
        """Return what a call that ended with one of :attr:`clean_codes` reports.

        Raises:
            ToolError: the output is none of this tool.
        """

    def words_for_fixes(self, request: Request) -> list[str]:
        """Return the call that reports fixes."""
        return self.words(request)

    def read_fixes(self, ended: Ended, request: Request, contents: Mapping[str, bytes]) -> Iterable[ToolFix]:  # noqa: ARG002 - most tools have none
        """Return the safe fixes that such a call reports for files with these contents, by path.

        Raises:
            ToolError: the output is none of this tool.
        """
        return ()

    def checked(self, ended: Ended) -> Ended:
        """Return what a call left.

        Raises:
            ToolError: it did not do its work.
        """
        if ended.code not in self.clean_codes:
            raise ToolError(f"{ended_how(ended.code)}: {ended.complaint()}")
        return ended


def below_root(path: str, root: str) -> str:
    """Return a path of a tool's output below the workspace root; empty where it is elsewhere."""
    import os.path

    whole = os.path.normpath(os.path.join(root, path))  # noqa: PTH118 - pathlib does not fold `..`
    return whole[len(root) + 1 :] if whole.startswith(root.rstrip("/") + "/") else ""


def lines_that_match(pattern: re.Pattern[str], text: str) -> tuple[list[re.Match[str]], list[str]]:
    """Return the matches of the lines of a text, and the lines that are not empty and do not match."""
    matches: list[re.Match[str]] = []
    rest: list[str] = []
    for line in text.splitlines():
        if match := pattern.match(line):
            matches.append(match)
        elif line.strip():
            rest.append(line.strip())
    return matches, rest


def unreadable(output: bytes | str, expected: str) -> ToolError:
    """Return the error of output that is not the tool's."""
    text = output if isinstance(output, str) else output[:400].decode("utf-8", "replace")
    begin = " ".join(text.split())[:80]
    shown = f"begins with {begin!r}" if begin else "is empty"
    return ToolError(f"printed what cannot be read: it {shown}, expected {expected}")


def own_paths(request: Request) -> Iterable[str]:
    """Return the files of a call as paths below the root."""
    return (file.removeprefix("./") for file in request.files)
