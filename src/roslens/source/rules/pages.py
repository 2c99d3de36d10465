"""The reference pages of native rules, made from what declares them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from roslens.model.weight.consequence import Certainty, Consequence, severity_of, weight_text
from roslens.model.words.silence_comment import silence_comment
from roslens.source.rules.field.precision import read_samples
from roslens.source.rules.field.rates import read_rates, spoken_rate
from roslens.source.rules.profiles import PROFILES
from roslens.source.rules.rule import FileRule, Rule

_HEAD = """\
# Coding rules

What `roslens check` finds itself, on the one parse that also measures. This page and those of the rules are made from
`src/roslens/source/rules/`; `make docs` writes them anew. `roslens explain RULE` shows the same in a terminal. Rules of
the computation graph have [a page of their own](graph_rules.md), limits of metrics are in
[the quality models](models.md).

Which rules are on is said by a *profile*. The default, `auto`, is `ros2` or `ros1` by package:

```toml
[rules]
profiles = ["auto", "misra-cpp-2008"]
enable = ["cpp.goto"]           # ids, or patterns: cpp.*
disable = ["node.console_output"]
severity = { "package.boilerplate" = "error" }
```

Each rule declares its *consequence* (what happens if a finding is left as it is) and its *certainty* (how certain it is
that a finding is true). The severity is a table of the two, the same for rules of the graph, foreign tools and
plug-ins:

| consequence | proven | likely | heuristic | unproven |
| --- | --- | --- | --- | --- |
CELLS

*Proven* is what the platform itself refuses (XML, rcl, rosidl, launch, CMake, the compiler) or the definition of the
language decides: only that is an error. Of what is *likely*, at least nine in ten findings are true. *Heuristic*
findings often indicate a mistake. They are *unproven*, and notes, until a sample of them was read in repositories that
the rule was not written for and at least nine in ten were true ([measured](../accuracy_of_rules.md)). A single finding
may be less certain than its rule; if it is heuristic then, it is a note.

| profile | for | rules |
| --- | --- | --- |
"""
_NAMES = {"cpp": "C and C++", "python": "Python"}


def rule_pages(rules: Mapping[str, Rule]) -> Mapping[str, str]:
    """Return the page of each rule and the one that lists them, by path."""
    pages = {f"rules/{rule.id}.md": _page(rule) for rule in rules.values()}
    return {"rules.md": _index(list(rules.values())), **pages}


def _index(rules: Sequence[Rule]) -> str:
    text = _HEAD.replace("CELLS\n", "".join(map(_cells, Consequence)))
    for name, purpose in PROFILES.items():
        text += f"| `{name}` | {purpose} | {sum(name in rule.profiles for rule in rules)} |\n"
    text += "\n| rule | severity | consequence | finds | profiles |\n| --- | --- | --- | --- | --- |\n"
    for rule in rules:
        profiles = ", ".join(rule.profiles)
        weight = weight_text(rule.consequence, rule.certainty, unproven=rule.unproven)
        text += (
            f"| [`{rule.id}`](rules/{rule.id}.md) | {rule.severity.value} | {weight} | {rule.title} | {profiles} |\n"
        )
    return text + _fixes([rule for rule in rules if rule.fix])


def _cells(consequence: Consequence) -> str:
    cells = [severity_of(consequence, certainty) for certainty in Certainty]
    cells.append(severity_of(consequence, Certainty.HEURISTIC, unproven=True))
    return f"| {consequence.value} | {' | '.join(one.value for one in cells)} |\n"


def _fixes(rules: Sequence[Rule]) -> str:
    text = "\n## Rules with a fix\n\n"
    text += f"What [`roslens check --fix`](fixes.md) fixes: findings of {len(rules)} rules, where it is certain.\n\n"
    text += "| rule | fix |\n| --- | --- |\n"
    return text + "".join(f"| [`{rule.id}`](rules/{rule.id}.md) | {rule.fix} |\n" for rule in rules)


def _fence(rule: Rule) -> str:
    return "xml" if rule.bad.startswith("<") else "cmake" if rule.family == "cmake" else ""


def _page(rule: Rule) -> str:
    fence = rule.languages[0] if rule.languages else _fence(rule)
    reads = _NAMES.get(rule.syntax, rule.syntax) if isinstance(rule, FileRule) else "packages"
    weight = weight_text(rule.consequence, rule.certainty, unproven=rule.unproven)
    profiles = ", ".join(rule.profiles) or "no profile"
    parts = [
        f"# {rule.id}\n\n**{rule.title}.** {rule.finds}",
        f"Why: {rule.why}",
        f"Reported:\n\n```{fence}\n{rule.bad.strip(chr(10))}\n```",
        f"In order:\n\n```{fence}\n{rule.good.strip(chr(10))}\n```",
        f"Consequence: {weight}. Severity: {rule.severity.value}. Reads {reads}. On in: {profiles}.",
    ]
    if rule.fix:
        parts.append(f"Fix: safe, by [`roslens check --fix`](../fixes.md). {rule.fix}")
    if rule.clauses:
        parts.append("Covers: " + ", ".join(f"`{clause}`" for clause in rule.clauses))
    if rule.unlike:
        parts.append("Requires the opposite of: " + ", ".join(f"[`{other}`]({other}.md)" for other in rule.unlike))
    true, read = read_samples().get(rule.id, (0, 0))
    if read:
        parts.append(f"[Measured](../../accuracy_of_rules.md): {true} of {read} findings that were read were true.")
    if rate := spoken_rate(rule.id, read_rates()):
        parts.append(f"In the field: {rate}")
    parts.append(f"To leave one finding out: `{silence_comment(rule.info)}`")
    return "\n\n".join(parts) + "\n"
