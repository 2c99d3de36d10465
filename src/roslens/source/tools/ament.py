"""What the linters of ament have in common: the call, and the xUnit file that each of them writes."""

from __future__ import annotations

import re
from pathlib import Path

from roslens.intake.bounded_file import TooLargeError, read_bounded
from roslens.source.tools.running.run_tool import MOST_BYTES, Ended, ToolError
from roslens.source.tools.tool import Reading, Request, Tool, ToolFinding, below_root, own_paths
from roslens.source.tools.xml_output import xml_root

_CASE = re.compile(r"(?P<check>\S+)(?: .*)? \((?P<path>.+?)(?::(?P<line>\d+|-))?(?::(?P<column>\d+))?\)$", re.DOTALL)
_CHECKED = re.compile(r"^\* (?P<path>.*)$", re.MULTILINE)


class AmentLinter(Tool):
    """A linter of ament_lint_auto; it has no version to ask for."""

    check = ""
    """The check of a finding for which the linter names none."""

    get = "source a ROS 2 installation that has it (apt install ros-$ROS_DISTRO-ament-lint-common)"
    version_words = ()

    def words(self, request: Request) -> list[str]:
        """Return the call; files come first, for some options take all that follows."""
        out = Path(request.scratch, "result.xml")
        return [request.program, *request.files, "--xunit-file", str(out)]

    def read(self, ended: Ended, request: Request) -> Reading:
        """Read the xUnit file: a test case that failed is a finding, and the files that were checked are listed."""
        try:
            content = read_bounded(Path(request.scratch, "result.xml"), MOST_BYTES)
        except TooLargeError as error:
            raise ToolError(f"wrote {error.strerror}") from error
        except OSError:
            raise ToolError(f"wrote no result: {ended.complaint()}") from None
        return self.read_result(content, request)

    def read_result(self, content: bytes, request: Request) -> Reading:
        """Return the findings in an xUnit file."""
        root = xml_root(content, "testsuite")
        found = []
        for case in root.iter("testcase"):
            failures = [*case.iter("failure"), *case.iter("error")]
            if not failures:
                continue
            name = case.get("name", "")
            match = _CASE.match(name)
            message = (failures[0].get("message") or failures[0].text or name).split("\n")[0].strip().rstrip(":")
            if match:
                place = (
                    below_root(match["path"], request.root),
                    int((match["line"] or "-").replace("-", "0")),
                    int(match["column"] or 0),
                )
                found.append(ToolFinding(*place, match["check"], message))
            else:
                found.append(ToolFinding(below_root(name, request.root), 0, 0, self.check, message))
        checked = {
            below_root(match["path"].strip(), request.root)
            for match in _CHECKED.finditer(root.findtext("system-out") or "")
        }
        skipped = {path: "it does not list it as checked" for path in own_paths(request) if path not in checked}
        return Reading(tuple(found), skipped)
