"""docs/accuracy.md: what the graph from source is worth, by running systems."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from accuracy.comparing import IMPLICIT, Comparison, Difference, Row, total
from accuracy.system import HERE, System

_ROS = {"ros1": "ROS 1", "ros2": "ROS 2"}

HEAD = HERE / "head.md"


def document(found: Sequence[tuple[System, Comparison]], more: str = "") -> str:
    """Return the page, with a section more at its end."""
    text = [HEAD.read_text()]
    for generation in ("ros1", "ros2"):
        chosen = [(system, one) for system, one in found if system.generation == generation]
        if not chosen:
            continue
        rows = total(one.rows for _, one in chosen)
        text.append(f"## {_ROS[generation]}\n\n{len(chosen)} systems together.\n\n{_table(rows)}")
        text += [_section(system, one) for system, one in chosen]
    return "\n".join([*text, more] if more else text)


def _section(system: System, one: Comparison) -> str:
    parts = ", ".join(f"`{part.partition(' > ')[0].rpartition(':')[2]}`" for part in system.parts)
    words = [
        f"### {system.title}\n",
        f"{system.about} Source: {parts}; `{system.launch}`.\n",
        _table(total([one.rows])),
    ]
    words += _list("Missed", [other for other in one.differences if other.what == "missed"])
    words += _list("Said, and not there", [other for other in one.differences if other.what == "extra"])
    words += _list("Said otherwise", [other for other in one.differences if other.what == "other value"])
    words += _list("Said to be conditional", [other for other in one.differences if other.what == "conditional"])
    return "\n".join(words)


def _table(rows: Mapping[str, Row]) -> str:
    lines = [
        "| facts | seen | found | recall | said | right | precision | conditional | aside | wrong |",
        "| --- | --: | --: | --: | --: | --: | --: | --: | --: | --: |",
    ]
    whole, own = Row(), Row()
    for name, row in rows.items():
        whole.add(row)
        if name != IMPLICIT:
            own.add(row)
        lines.append(_line(name.replace("_", " "), row))
    lines.append(_line(f"all but {IMPLICIT}", own))
    lines.append(_line("**all**", whole))
    return "\n".join(lines) + "\n"


def _line(name: str, row: Row) -> str:
    numbers = (
        row.seen, row.found, _share(row.found, row.seen), row.said, row.right, _share(row.right, row.said),
        row.conditional, row.aside, row.wrong,
    )  # fmt: skip
    return f"| {name} | {' | '.join(str(one) for one in numbers)} |"


def _share(part: int, whole: int) -> str:
    # Cut, not rounded: 100 % is all.
    return f"{int(1000 * part / whole) / 10:g} %" if whole else ""


def _list(title: str, differences: Sequence[Difference]) -> list[str]:
    """Return a table of differences, those of one reason together."""
    if not differences:
        return []
    together: dict[tuple[str, str], list[str]] = {}
    for one in differences:
        key = (one.reason.cause, one.reason.why) if one.reason else ("unexplained", "")
        together.setdefault(key, []).append(one.text + (" (**wrong**)" if one.certain else ""))
    lines = [f"{title}:\n", "| what | cause | why |", "| --- | --- | --- |"]
    for (cause, why), texts in together.items():
        lines.append(f"| {'; '.join(_cell(text) for text in texts)} | {cause} | {_cell(why)} |")
    return [*lines, ""]


def _cell(text: str) -> str:
    return (
        text.replace("|", "\\|")
        .replace("\n", " ")
        .replace("<", "&lt;")
        .replace("*", "\\*")
        .replace("\\*\\*wrong\\*\\*", "**wrong**")
    )
