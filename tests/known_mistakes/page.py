"""Writes docs/known_mistakes.md from the tables."""

from __future__ import annotations

from known_mistakes.golden import KINDS, systems
from known_mistakes.pairs import ROOT, Pair, pairs

PAGE = ROOT / "docs" / "known_mistakes.md"
_HEAD = """# Known mistakes

What `roslens graph --check` tells of mistakes that people made, and corrected, in robots that many use. The pairs of a
buggy and a fixed revision are those that [ROSDiscover](https://github.com/cmu-rss-lab/rosdiscover-evaluation) was
evaluated with. This page is made from `tests/fixtures/extract/rosdiscover/`; `make known-mistakes` writes it anew, and
`ROSLENS_CORPORA=FOLDER pytest tests/source/extract/test_known_mistakes.py` holds it against clones of the repositories.

A mistake counts as found when a finding stands on the entity that it is about in the buggy revision, and none of that
rule on it in the fixed one. Both are read from source as they are in the history: nothing is built, run or patched.

"""


_TOGETHER = (
    "A mistake is one of a system, and the data set names its launch files. Where the other end is in a program",
    "without public source, the node that stands for it is known from the catalogue; where a launch file of that",
    "time is gone, its nodes are named. Repositories that were one per package stand beside each other at commits",
    "of the same time. `{panel}` is the argument that the control panel of the robot starts the launch file with, as",
    "the panel's file of the revision says.",
)


def page() -> str:
    """Return the page."""
    rows = pairs()
    found = [one for one in rows if one.reported]
    peer = sum(one.peer for one in rows)
    lines = [
        f"**{len(found)} of {len(rows)}** are found, {peer} by ROSDiscover.",
        "",
        "| pair | mistake | buggy, fixed | roslens | ROSDiscover |",
        "| --- | --- | --- | --- | --- |",
        *(_row(one) for one in rows),
        "",
        "## What is not found, and why",
        "",
        *(f"- **{one.id}**: {one.why}" for one in rows if not one.reported),
        "",
    ]
    lines += _golden()
    lines += ["## What runs together", "", *_TOGETHER, ""]
    for one in found:
        lines += [f"{one.id}{_beside(one)}:", "", "```xml", one.launch.rstrip("\n"), "```", ""]
    return _HEAD + "\n".join(lines).rstrip("\n") + "\n"


def _golden() -> list[str]:
    """Return the lines about graphs of running robots."""
    lines = [
        "## Graphs of running robots",
        "",
        "The data set has the graphs of three robots as they ran in simulation. Of what was *observed*, source and",
        "launch files say what is *found*; *right* are those facts of all that is *said* without a condition. Names",
        "and types have to be the same; a server of an action is its topics too. Left out are the recorder, what every",
        "node has, `/clock`, bonds and transports of images. Most nodes of these robots have no source in the",
        "workspace: what is known of them is what the catalogue has.",
        "",
        "| robot | kind | observed | found | said | right |",
        "| --- | --- | --- | --- | --- | --- |",
    ]
    for one in systems():
        for kind in KINDS:
            if seen := one.seen.get(kind, 0):
                numbers = [seen, *(counted.get(kind, 0) for counted in (one.found, one.said, one.right))]
                cells = " | ".join(str(number) for number in numbers)
                lines.append(f"| {one.id} | {kind.replace('_', ' ')} | {cells} |")
    lines += ["", "What is missing or too much:", ""]
    for one in systems():
        lines += [f"- **{one.id}**: {why}" for why in one.why]
    return [*lines, ""]


def _row(one: Pair) -> str:
    ((name, (buggy, fixed)),) = one.trees.items()
    told = f"`{one.reported[0]}` on `{one.reported[1]}`" if one.reported else "no"
    peer = "yes" if one.peer else "no"
    return f"| {one.id} | {one.fault} | {name} `{buggy[:8]}`, `{fixed[:8]}` | {told} | {peer} |"


def _beside(one: Pair) -> str:
    beside = [f"{name.partition('@')[0]} `{commit[:8]}`" for name, commit in one.beside.items()]
    return f", with {', '.join(beside)}" if beside else ""
