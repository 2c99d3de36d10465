"""The reference page of the rules of the computation graph, made from what declares them."""

from __future__ import annotations

from collections.abc import Sequence

from roslens.model.finding import RuleInfo
from roslens.plugins.points import Option

_HEAD = """\
# Rules of the computation graph

What does not fit together once launch files and code are joined: names, types, quality of service, parameters.
`roslens graph --launch FILE --check` tells it, `roslens explain graph.qos` shows a rule. This page is made from
`src/roslens/source/rules/graph/`; `make docs` writes it anew.

- A finding stands at the line that shows it, and names the other end with its place.
- One problem is one finding, however many pairs of ends have it.
- A name of which a part is unknown raises nothing and answers nothing. Where it might be the missing end, that is said.
- What is likely, or only holds under a condition, is one step less severe; what is possible is a note. The message says
  why.
- Without a launch file nobody knows whether nodes run together, and under which names: what fits badly between two of
  them is a note, and rules about a whole system are silent.
- What every node has is left out, and so are names whose other end is usually elsewhere.
- `roslens check` finds the same in the configurations that `roslens.toml` declares, as part of a run: with a gate, in
  every report. How many findings of each rule are true is [measured](../accuracy_of_graph_rules.md).
  A comment such as `roslens: ignore[graph.qos]` in the line leaves a finding out, as of any rule.

| rule | severity | finds |
| --- | --- | --- |
"""


def graph_rules_page(rules: Sequence[RuleInfo], options: Sequence[Option]) -> str:
    """Return the page, in Markdown."""
    table = "".join(f"| [`{one.id}`](#{_anchor(one.id)}) | {one.severity.value} | {one.title} |\n" for one in rules)
    sections = "".join(_section(one) for one in rules)
    return f"{_HEAD}{table}\n## Options\n\nBelow `[options.graph]` in `roslens.toml`.\n\n{_options(options)}{sections}"


def _anchor(rule: str) -> str:
    return rule.replace(".", "")


def _section(one: RuleInfo) -> str:
    tags = ", ".join(f"`{tag}`" for tag in one.tags)
    more = f"\n[More]({one.url})\n" if one.url else ""
    return f"\n## {one.id}\n\n**{one.title}.** {one.description}\n\nWhy: {one.rationale}\n{more}\nTags: {tags}\n"


def _options(options: Sequence[Option]) -> str:
    lines = []
    for one in options:
        values = one.default if isinstance(one.default, list) else [one.default]
        default = ", ".join(f"`{value}`" for value in values)
        lines.append(f"- `{one.name}`: {one.text} Default: {default}\n")
    return "".join(lines)
