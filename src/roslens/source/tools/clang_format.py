"""The tool ``clang_format``: C and C++ whose layout deviates from a ``.clang-format`` of the project."""

from __future__ import annotations

import os
import re
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from roslens.model.edit import Edit, edit_at
from roslens.model.source import SourceFile
from roslens.plugins.points import Option
from roslens.source.tools.running.run_tool import Ended, ToolError
from roslens.source.tools.running.settings_files import SettingsFiles
from roslens.source.tools.tool import Reading, Request, Tool, ToolFinding, ToolFix, below_root, own_paths, unreadable
from roslens.source.tools.xml_output import number, xml_root

_FINDING = re.compile(
    r"(?P<path>.+?):(?P<line>\d+):(?P<column>\d+): \w+: (?P<message>.*) \[-Wclang-format-violations\]$"
)
_DONE = re.compile(r"Formatting (?:\[\d+/\d+\] )?(?P<path>.*)$")
CHECK = "violation"
FILE = "file"


class ClangFormat(Tool):
    """Layout; a hundred thousand lines a second."""

    name = "clang_format"
    program = "clang-format"
    text = "Layout of C and C++ by the project's .clang-format."
    get = "pip install 'roslens[tools]', apt install clang-format, or pip install clang-format"
    languages = ("c", "cpp")
    version_pattern = r"clang-format version (\d+(?:\.\d+)+)"
    oldest = (10,)
    settings_files = (".clang-format", "_clang-format", ".clang-format-ignore")
    clean_codes = frozenset({0})
    fixes_at_once = 1
    options = (Option("style", "str", "Google, LLVM …, or `file` for the .clang-format above each file.", FILE),)

    def prepared(
        self, root: str, files: Sequence[SourceFile], options: Mapping[str, Any], *, own_settings: bool
    ) -> Any:
        """Reject a workspace without a configured layout."""
        if options["style"] != FILE:
            return None
        if not own_settings:
            raise ToolError("has no layout to check: .clang-format counts once you trust it, see `roslens trust`")
        above = SettingsFiles(root)
        folders = {os.path.dirname(file.path): file for file in files if self.reads(file)}  # noqa: PTH120
        if folders and not any(above.key_of(file.path, self.settings_files[:2]) for file in folders.values()):
            raise ToolError("finds no .clang-format; add one, or set [options.clang_format] style = 'Google'")
        return None

    def words(self, request: Request) -> list[str]:
        """Return the call; ``--verbose`` makes it report which files it checked."""
        style = request.options["style"]
        return [
            request.program,
            "--dry-run",
            "--verbose",
            f"--style={style}",
            "--fallback-style=none",
            "--",
            *request.files,
        ]

    def read(self, ended: Ended, request: Request) -> Reading:
        """Read one finding a line of source from standard error."""
        passed: set[str] = set()
        found: dict[tuple[str, int], ToolFinding] = {}
        for line in ended.stderr.decode("utf-8", "replace").splitlines():
            if match := _FINDING.match(line):
                path, number = below_root(match["path"], request.root), int(match["line"])
                finding = ToolFinding(path, number, int(match["column"]), CHECK, "not formatted according to the style")
                found.setdefault((path, number), finding)
            elif match := _DONE.match(line):
                passed.add(below_root(match["path"], request.root))
        if not passed:
            raise unreadable(ended.stderr, "`Formatting FILE` for each file")
        skipped = {path: "it does not report that it checked it" for path in own_paths(request) if path not in passed}
        return Reading(tuple(found.values()), skipped)

    def words_for_fixes(self, request: Request) -> list[str]:
        """Return the call that reports replacements as XML."""
        style = request.options["style"]
        words = ["--output-replacements-xml", f"--style={style}", "--fallback-style=none", "--", *request.files]
        return [request.program, *words]

    def read_fixes(self, ended: Ended, request: Request, contents: Mapping[str, bytes]) -> Iterator[ToolFix]:
        """Yield the replacements of one file, those that begin in one line together."""
        (path,) = own_paths(request)
        content = contents[path]
        by_line: dict[int, list[Edit]] = defaultdict(list)
        for one in xml_root(ended.stdout, "replacements").iter("replacement"):
            start = number(one.get("offset"))
            edit = edit_at(content, start, start + number(one.get("length")), one.text or "", path)
            by_line[edit.line].append(edit)
        for line, edits in sorted(by_line.items()):
            yield ToolFix(path, line, 0, CHECK, tuple(edits))


plugin = ClangFormat()
