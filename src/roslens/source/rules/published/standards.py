"""Which native rule, or which check of a foreign tool, answers what others check: the study of 2016 and cpplint.

What is asked is data (``standards.yaml``); what native rules answer, they say themselves by their ``clauses``.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from functools import cache
from importlib.resources import files

import msgspec

from roslens.source.rules.rule import Rule


class Row(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """What one check of others is about.

    Attributes:
        what: it reports.
        tool: check of a foreign tool that answers it, where no native rule does.
        why: nothing answers it.
    """

    what: str
    tool: str = ""
    why: str = ""


PAPER, CPPLINT = "paper2016", "cpplint"
_TITLES = {
    PAPER: "The 122 rules on C++ of the study of 2016",
    CPPLINT: "The categories of cpplint 2.0",
}
_STANDARDS = {
    "hicpp": "High Integrity C++ (2013)",
    "misra-cpp-2008": "MISRA C++:2008",
    "misra-cpp-2023": "MISRA C++:2023",
    "autosar-cpp14": "AUTOSAR C++14",
    "jsf-av": "JSF AV C++ (2005)",
    "clang-tidy": "Checks of clang-tidy and warnings of compilers",
}
_HEAD = """\
# Standards and native rules

Each row of the first two tables is a check of another tool and its counterpart here: a native rule, a check of a
foreign tool that roslens runs, or the reason why nothing does. The other tables list the clauses of published standards
that native rules cover, in whole or in part; what only a compiler can decide is in none. `make docs` writes this
page from `src/roslens/source/rules/published/standards.yaml` and the `clauses` of the rules.
"""


@cache
def asked() -> Mapping[str, Mapping[str, Row]]:
    """Return the rows by whose they are, then by id, in order of the data file."""
    import yaml

    text = files("roslens.source.rules.published").joinpath("standards.yaml").read_text("utf-8")
    return msgspec.convert(yaml.safe_load(text), dict[str, dict[str, Row]])


def answers(rules: Mapping[str, Rule]) -> Mapping[str, Mapping[str, tuple[str, ...]]]:
    """Return the ids of the rules that name each clause, by standard and clause."""
    found: dict[str, dict[str, list[str]]] = defaultdict(lambda: defaultdict(list))
    for rule in rules.values():
        for clause in rule.clauses:
            standard, _, name = clause.partition(" ")
            found[standard][name].append(rule.id)
    return {
        standard: {name: tuple(ids) for name, ids in clauses.items()} for standard, clauses in sorted(found.items())
    }


def standards_page(rules: Mapping[str, Rule]) -> str:
    """Return the page of reference."""
    by_clause = answers(rules)
    parts = [_HEAD]
    for name, rows in asked().items():
        answered = by_clause.get(name, {})
        parts.append(_table(_TITLES[name], rows, answered))
    for name, title in _STANDARDS.items():
        parts.append(_clauses(title, by_clause.get(name, {})))
    return "\n".join(parts)


def _table(title: str, rows: Mapping[str, Row], answered: Mapping[str, Sequence[str]]) -> str:
    native = sum(name in answered for name in rows)
    by_tool = sum(bool(row.tool) and name not in answered for name, row in rows.items())
    text = f"## {title}\n\n{len(rows)} rows: {native} by native rules, {by_tool} by foreign tools, "
    text += f"{len(rows) - native - by_tool} unanswered.\n\n| id | reports | answer |\n| --- | --- | --- |\n"
    for name, row in rows.items():
        answer = _links(answered[name]) if name in answered else row.tool or f"none: {row.why}"
        text += f"| `{name}` | {row.what} | {answer} |\n"
    return text


def _clauses(title: str, answered: Mapping[str, Sequence[str]]) -> str:
    text = f"## {title}\n\n{len(answered)} clauses.\n\n| clause | native rules |\n| --- | --- |\n"
    for name in sorted(answered, key=_natural):
        text += f"| `{name}` | {_links(answered[name])} |\n"
    return text


def _links(ids: Sequence[str]) -> str:
    return ", ".join(f"[`{one}`](rules/{one}.md)" for one in ids)


def _natural(name: str) -> tuple[tuple[int, str], ...]:
    """Return a key by which 2 comes before 10."""
    digits = "".join(one if one.isdigit() else " " for one in name).split()
    words = "".join(" " if one.isdigit() else one for one in name).split()
    return (*((0, word) for word in words[:1]), *((int(one), "") for one in digits), *((0, word) for word in words))
