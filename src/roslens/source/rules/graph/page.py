"""The reference page of the rules of the computation graph, made from what declares them."""

from __future__ import annotations

from collections.abc import Sequence

from roslens.model.finding import RuleInfo
from roslens.model.weight.consequence import weight_text
from roslens.plugins.points import Option

_HEAD = """\
# Rules of the computation graph

Inconsistencies between launch files and code: names, types, quality of service, parameters.
`roslens graph --launch FILE --check` reports them, `roslens explain graph.qos` describes a rule. This page is generated
from `src/roslens/source/rules/graph/` by `make docs`.

- A finding is located at the line that causes it, and names the other end with its location.
- One problem is one finding, regardless of the number of pairs of endpoints that have it.
- A name with an unknown part neither triggers nor satisfies a rule. If it might be the missing end, the message states
  this.
- A finding that rests on what is likely, or only applies under a condition, is one step less certain; one that rests on
  what is possible is heuristic, and a note. The message states why. The severity follows from
  [consequence and certainty](rules.md).
- Without a launch file it is unknown whether nodes run together, and under which names: inconsistencies between two of
  them are notes, and rules about a whole system are not applied.
- Endpoints that every node has are not reported, nor are names whose other end is usually outside the workspace.
- `roslens check` applies the same rules to the configurations that `roslens.toml` declares, as part of a run: with a
  gate, in every report. The precision of each rule is [measured](../accuracy_of_graph_rules.md).
  A comment such as `roslens: ignore[graph.qos]` in the line suppresses a finding, as for any rule.

| rule | severity | consequence | finds |
| --- | --- | --- | --- |
"""


def graph_rules_page(rules: Sequence[RuleInfo], options: Sequence[Option]) -> str:
    """Return the page, in Markdown."""
    table = "".join(
        f"| [`{one.id}`](#{_anchor(one.id)}) | {one.severity.value} | "
        f"{weight_text(*one.weight, unproven=one.unproven)} | {one.title} |\n"
        for one in rules
    )
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
