"""The tool ``pylint``: Python with some inference of types and values."""

from __future__ import annotations

from pathlib import Path

import msgspec

from roslens.model.source import SourceFile
from roslens.plugins.points import Option
from roslens.source.tools.running.run_tool import Ended
from roslens.source.tools.tool import Reading, Request, Tool, ToolFinding, below_root, unreadable

DISABLE = ("C", "R", "I", "import-error", "no-name-in-module", "no-member")
"""Taste, and what cannot be determined where the packages of a robot are not importable."""


class _Message(msgspec.Struct, frozen=True, rename="camel"):
    type: str
    symbol: str
    message: str
    path: str
    line: int | None = 0
    column: int | None = 0
    end_line: int | None = None
    end_column: int | None = None


class _Statistics(msgspec.Struct, frozen=True, rename="camel"):
    modules_linted: int


class _Report(msgspec.Struct, frozen=True):
    messages: list[_Message]
    statistics: _Statistics


class Pylint(Tool):
    """Python; about 1,500 lines a second."""

    name = "pylint"
    program = "pylint"
    text = "Python, with some inference: names, arguments, unreachable and dangerous code."
    get = "pip install 'roslens[tools]', or pip install pylint"
    languages = ("python", "launch_python")
    version_pattern = r"pylint (\d+(?:\.\d+)+)"
    oldest = (3,)
    whole_packages = True
    clean_codes = frozenset(range(32))
    options = (
        Option("disable", "list", "Messages or categories that are not reported.", list(DISABLE)),
        Option("enable", "list", "Messages that are reported although their category is not.", []),
    )

    def reads(self, file: SourceFile) -> bool:
        """Return whether it looks at a file: a ``.cfg`` of dynamic_reconfigure has its names from a star import."""
        return super().reads(file) and not file.path.endswith(".cfg")

    def shapes(self, file: SourceFile) -> bool:
        """Return whether other files may import it."""
        return file.language.value == "python"

    def words(self, request: Request) -> list[str]:
        """Return the call, with settings of our own: a ``pylintrc`` of the workspace could have code run."""
        settings = Path(request.scratch, "pylintrc")
        settings.write_text("[MAIN]\npersistent=no\n")
        enable = request.options["enable"]
        return [
            request.program,
            f"--rcfile={settings}",
            "--output-format=json2",
            f"--disable={','.join(request.options['disable'])}",
            *([f"--enable={','.join(enable)}"] if enable else []),
            "--",
            *request.files,
        ]

    def read(self, ended: Ended, request: Request) -> Reading:
        """Read the JSON of standard output; columns there begin with 0."""
        try:
            report = msgspec.json.decode(ended.stdout, type=_Report)
        except msgspec.DecodeError:
            raise unreadable(ended.stdout or ended.stderr, "the JSON of --output-format=json2") from None
        if report.statistics.modules_linted == 0 and not report.messages:
            raise unreadable(ended.stderr or b"0 modules linted", "a look at the files")
        return Reading(tuple(_finding(one, request.root) for one in report.messages))


def _finding(one: _Message, root: str) -> ToolFinding:
    end_column = one.end_column or 0
    return ToolFinding(
        below_root(one.path, root),
        one.line or 0,
        (one.column or 0) + 1,
        one.symbol,
        one.message,
        one.end_line or 0,
        end_column,
        one.type,
    )


plugin = Pylint()
