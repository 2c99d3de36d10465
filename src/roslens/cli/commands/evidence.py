"""``roslens evidence``: what shows which requirements of REP-2004 a package meets."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from roslens.model.requirement import Evidence

TEXT = "Report which requirements of REP-2004 (quality levels) a package meets, fails or leaves unknown, with evidence."
EXAMPLES = """\
  roslens evidence nav2_amcl
  roslens evidence nav2_amcl --workspace ~/nav2_ws --format html -o evidence.html
  roslens evidence my_driver --format markdown -o my_driver/QUALITY_DECLARATION.md   to be read, completed, committed
  roslens evidence my_driver --format json | jq '.items[] | select(.met == "not met")'"""

FORMATS = ("text", "json", "markdown", "html")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the package, the workspace, and how it is written."""
    parser.add_argument("package", metavar="PACKAGE", help="as the last run names it")
    parser.add_argument(
        "--workspace",
        metavar="PATH",
        default=".",
        help="the workspace that was checked (default: this folder)",
    )
    parser.add_argument("--run", type=int, metavar="N", dest="number", help="a run other than the last")
    parser.add_argument("--format", choices=FORMATS, default="text")
    parser.add_argument("-o", "--output", metavar="FILE", help="write to this file instead of standard output")


def run(options: argparse.Namespace) -> int:
    """Print the evidence.

    Raises:
        UsageError: there is no run, or no such package in it.
        StoreError: the store cannot be read.
    """
    from roslens.cli.terminal.streams import write_result
    from roslens.cli.workplace.workplace import open_store
    from roslens.model.errors import UsageError
    from roslens.report.run.evidence_text import evidence_json, evidence_markdown, evidence_text
    from roslens.source.evidence.change_log import read_changes
    from roslens.source.evidence.documentation import claimed_level
    from roslens.source.evidence.gather import gather
    from roslens.source.evidence.package_folder import PackageFolder

    with open_store(options.workspace) as store:
        view = store.view(options.number)
        root = Path(view.header.root)
        result = view.package(options.package)
        names = [one.id for one in view.packages()]
        if result is None or options.package not in names:
            from difflib import get_close_matches

            near = get_close_matches(options.package, names, n=3) or names[:3]
            raise UsageError(
                f'no package "{options.package}" in this run',
                expected=f"such as {', '.join(near)}" if near else "a run that has packages",
                advice="" if near else "Run `roslens check` on a folder with packages",
            )
        needed = {one.name for one in result.package.dependencies}
        beside = [view.package(one.id) for one in view.packages() if one.name in needed]
        claimed = {one.package.name: claimed_level(PackageFolder(one, root)) for one in beside if one is not None}
    folder = PackageFolder(result, root)
    found = gather(folder, read_changes(folder.repository), claimed)
    formats: dict[str, Callable[[Evidence], str]] = {
        "text": evidence_text,
        "json": evidence_json,
        "markdown": evidence_markdown,
        "html": _page,
    }
    write_result(formats[options.format](found), options.output)
    return 0


def _page(evidence: Evidence) -> str:
    from roslens.dashboard.evidence_page import evidence_page

    return evidence_page(evidence)
