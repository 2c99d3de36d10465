"""How many warnings and errors of foreign tools are worth acting on: a sample that was read."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

import msgspec
import yaml

from graph_findings.judgements import ROOT
from roslens.source.tools.checks.tool_checks import checks_of

TABLE = ROOT / "tests" / "fixtures" / "tool_findings" / "sample.yaml"


class ToolJudgement(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A finding of a foreign tool, its severity when it was drawn, and whether it is worth acting on."""

    tool: str
    check: str
    repository: str
    place: str
    severity: str
    verdict: bool
    why: str


def read_tools(path: Path = TABLE) -> list[ToolJudgement]:
    """Return the sample.

    Raises:
        ValidationError: the file is none.
    """
    return msgspec.convert(yaml.safe_load(path.read_text("utf-8")), list[ToolJudgement])


def tool_section(rows: Sequence[ToolJudgement]) -> Iterator[str]:
    """Yield the lines of the page on them."""
    yield "## Foreign tools"
    yield ""
    yield _HEAD
    yield ""
    yield "| tool | read | worth acting on | share | left by the data now | of them worth acting on |"
    yield "| --- | --: | --: | --: | --: | --: |"
    for tool in sorted({one.tool for one in rows}):
        own = [one for one in rows if one.tool == tool]
        left = [one for one in own if checks_of(tool).of(one.check).severity != "note"]
        true, kept = (sum(one.verdict for one in some) for some in (own, left))
        yield f"| {tool} | {len(own)} | {true} | {100 * true / len(own):.0f} % | {len(left)} | {kept} |"
    yield ""
    for one in rows:
        verdict = "yes" if one.verdict else "no"
        yield f"- {verdict}: `{one.tool}.{one.check}`, {one.repository}, `{one.place}`: {one.why}"
    yield ""


_HEAD = """\
Of the warnings and errors, by the severities of [their data](reference/tools.md), that each tool reports in code that
counts in nine repositories (of clang-tidy, which needs a build, in three) ten were drawn with seed 6 and read, and
later up to twelve more of ten other repositories with seed 59, as many as there were; of clang-tidy ten more of 13 in
sources of ros_comm for which commands were written by hand (31 others did not compile here), with seed 77. What was of
no use became a note for the check it is of; how many of those that were read are still warnings or errors is counted
from the data as they are now."""
