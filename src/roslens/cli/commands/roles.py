"""``roslens roles``: what each package is for, and why it is thought to be."""

from __future__ import annotations

import argparse
import sys

from roslens.cli.workplace.workplace import add_workspace_argument

TEXT = "Classify each package of the last run as a driver, a library, an application and so on, with the reasons."
EXAMPLES = """\
  roslens roles
  roslens roles ~/robot_ws --package nav2_amcl      one package, with all reasons
  roslens roles --format csv -o roles.csv"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the workspace, the packages, and how it is written."""
    add_workspace_argument(parser)
    parser.add_argument("--run", type=int, metavar="N", dest="number", help="a run other than the last")
    parser.add_argument("--package", action="append", default=[], metavar="NAME", help="only this one")
    parser.add_argument("--format", choices=("text", "csv", "json"), default="text")
    parser.add_argument("-o", "--output", metavar="FILE", help="write to this file instead of standard output")


def run(options: argparse.Namespace) -> int:
    """Print the roles.

    Raises:
        UsageError: there is no run, or no such package.
        StoreError: the store cannot be read.
    """
    from io import StringIO

    import msgspec

    from roslens.cli.terminal.streams import write_result
    from roslens.cli.workplace.workplace import open_store
    from roslens.model.errors import UsageError
    from roslens.model.source import OUTSIDE_PACKAGES
    from roslens.report.writing.csv_table import write_rows
    from roslens.source.study.role import RolesInRuns

    decided = {}
    roles = RolesInRuns()
    with open_store(options.path) as store:
        view = store.view(options.number)
        names = [one.id for one in view.packages() if one.id != OUTSIDE_PACKAGES]
        if unknown := [name for name in options.package if name not in names]:
            raise UsageError(f'no package "{unknown[0]}" in this run', expected=_some(names))
        for name in options.package or names:
            if decision := roles.decision(view, name):
                decided[name] = decision
    if options.format == "csv":
        head = ("package", "role", "kind", "margin", "reasons")
        out = StringIO(newline="")
        write_rows((head, ((k, d.role, d.kind, d.margin, "; ".join(d.reasons)) for k, d in decided.items())), out)
        write_result(out.getvalue(), options.output)
        return 0
    if options.format == "json":
        found = {"schema": 1, "packages": [{"package": k, **msgspec.structs.asdict(d)} for k, d in decided.items()]}
        write_result(msgspec.json.format(msgspec.json.encode(found)).decode() + "\n", options.output)
        return 0
    width = max((len(name) for name in decided), default=0)
    most = None if options.package else 2
    lines = [
        f"{name.ljust(width)}  {one.role:<11}  {one.kind:<12}  {'; '.join(one.reasons[:most])}".rstrip()
        for name, one in decided.items()
    ]
    write_result("\n".join(lines) + "\n" if lines else "", options.output)
    if not lines:
        print("roslens: the run has no package", file=sys.stderr)
    return 0


def _some(names: list[str]) -> str:
    shown = ", ".join(names[:5])
    return f"one of {shown}" + (f" and {len(names) - 5} more" if len(names) > 5 else "")
