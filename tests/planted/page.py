"""The page that tells how much of what is planted is found."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from planted.measuring import ROOT, SILENT, Count
from planted.variants import UNFIT, VARIANTS

PAGE = ROOT / "docs" / "recall_of_rules.md"
_HEAD = """# How many mistakes coding rules find

This does not show how many mistakes of developers are found: each rule is tried on variants of its own example, so that
only what hides the example is missed here. For mistakes that rules were not written from, see
[Reported mistakes](reports.md).

Written by `make recall CORPORA="FOLDER…"`; do not edit. Each [rule](reference/rules.md) that is on by default is broken
{variants} times: its example is written with other names (classes, functions, members, variables), other surroundings
(namespaces, branches, statements before and behind, `try` … `finally`) and another layout (a statement or an argument
a line, tabs, white space inside of parentheses, line ends of Windows in packages), and put between two declarations of
a real file, another one for each, at a place by seed {seed}. The files are of
{repositories}. Rules on packages are broken in packages
with other names, CMake in capitals, other layout of XML and real sources beside. Then `roslens check`, without a
`roslens.toml`, looks at the workspace: a place is found where a finding of the rule lies in the lines that were put in,
or in the package.

This tells that names, surroundings and layout do not hide a mistake. What the example of a rule leaves out, another way
to make the same mistake or one that needs two files, is not measured. Files that a rule keeps silent about
on purpose are not planted into, and surroundings in which an example is no mistake are left out:

"""


def page(counts: Mapping[str, Count], repositories: Sequence[str], seed: int) -> str:
    """Return the page of a measurement."""
    planted, found = (sum(getattr(one, name) for one in counts.values()) for name in ("planted", "found"))
    lines = [_HEAD.format(variants=VARIANTS, repositories=", ".join(repositories), seed=seed).rstrip("\n"), ""]
    reasons: dict[str, list[str]] = {}
    for rule, (_, reason) in (*SILENT.items(), *UNFIT.items()):
        reasons.setdefault(reason, []).append(f"`{rule}`")
    lines += [f"- {', '.join(sorted(rules))}: {reason}" for reason, rules in sorted(reasons.items())]
    lines += ["", f"Of {planted} places of {len(counts)} rules {found} are found ({100 * found / planted:.1f} %).", ""]
    missed = {rule: one for rule, one in counts.items() if one.found < one.planted}
    whole = len(counts) - len(missed)
    lines += [f"All of them are found of {whole} rules." + (" Of the others:" if missed else ""), ""]
    if missed:
        lines += ["| rule | planted | found | variants that are missed |", "| --- | --: | --: | --- |"]
        for rule, one in sorted(missed.items()):
            lines.append(f"| `{rule}` | {one.planted} | {one.found} | {', '.join(map(str, one.missed))} |")
        lines.append("")
    lines += ["| rule | planted | found |", "| --- | --: | --: |"]
    lines += [f"| `{rule}` | {one.planted} | {one.found} |" for rule, one in sorted(counts.items())]
    return "\n".join(lines) + "\n"
