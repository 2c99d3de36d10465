"""What changed in interfaces and who is affected: as lines, as Markdown, and as a document."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import msgspec

from roslens.model.interfaces.interface_change import (
    Breaks,
    InterfaceChange,
    InterfaceDifference,
    InterfaceUser,
    VersionStep,
)
from roslens.model.words.plural import plural
from roslens.report.writing.terminal import printable

SCHEMA = "roslens-interface-changes/1"
"""Name and version; within a version keys are only added."""
_MOST_USERS = 12
_WORDS = {
    Breaks.WIRE: "another type on the wire",
    Breaks.SOURCE: "code that names it fails",
    Breaks.MEANING: "its meaning is another",
}


def interface_lines(found: InterfaceDifference, *, most: int = _MOST_USERS) -> list[str]:
    """Return the difference as lines; ``most`` users of each interface are named."""
    lines = [_headline(found)]
    for one in found.changes:
        lines += [f"{'!' if one.breaks else '+'} {_place(one)}{one.interface}: {_what(one)}"]
    for name, of in found.containing.items():
        lines.append(f"! {name}: another type on the wire, as it contains {', '.join(of)}")
    lines += [f"  {name}: {_short(before)} -> {_short(after)}" for name, (before, after) in _known(found).items()]
    users = list(_users(found, most))
    lines += ["breaks until it is built again, or cannot be read:", *users] if users else []
    lines += [_step(one) for one in found.steps]
    lines += [f"? {one}: not understood completely, so what of it changed is not known" for one in found.unread]
    return [printable(line) for line in lines]


def interface_markdown(found: InterfaceDifference) -> str:
    """Return the difference as Markdown; nothing where there is none."""
    if not found.changes:
        return ""
    lines = [f"**{_headline(found)}**", ""]
    lines += [f"- `{printable(one.interface)}`: {printable(_what(one))}" for one in found.changes]
    lines += [
        f"- `{name}`: another type on the wire, as it contains {', '.join(of)}" for name, of in found.containing.items()
    ]
    users = [f"- {printable(line.strip())}" for line in _users(found, _MOST_USERS)]
    lines += ["", "Breaks until it is built again, or cannot be read:", "", *users] if users else []
    lines += [f"\n{printable(_step(one))}" for one in found.steps]
    return "\n".join(lines) + "\n"


def interface_document(found: InterfaceDifference) -> dict[str, Any]:
    """Return the difference as a document."""
    return {
        "changes": [
            {"interface": one.interface, "what": one.what, "breaks": [each.value for each in one.breaks],
             "path": one.path, "line": one.line}
            for one in found.changes
        ],
        "containing": found.containing,
        "checksums": {name: {"before": old, "after": new} for name, (old, new) in found.checksums.items()},
        "users": [msgspec.to_builtins(one) for one in found.users],
        "versions": [msgspec.to_builtins(one) for one in found.steps],
        "unread": found.unread,
    }  # fmt: skip


def _headline(found: InterfaceDifference) -> str:
    if not found.changes:
        return "no interface changed"
    names = {one.interface for one in found.breaking}
    compatible = len({one.interface for one in found.changes} - names)
    broken = "1 interface breaks" if len(names) == 1 else f"{len(names)} interfaces break"
    return f"{broken}, {plural(compatible, 'compatible change')}"


def _what(one: InterfaceChange) -> str:
    breaks = ", ".join(_WORDS[each] for each in one.breaks)
    return f"{one.what} ({breaks})" if breaks else one.what


def _place(one: InterfaceChange) -> str:
    if not one.path:
        return ""
    return f"{one.path}:{one.line}: " if one.line else f"{one.path}: "


def _known(found: InterfaceDifference) -> dict[str, tuple[str, str]]:
    return {name: both for name, both in found.checksums.items() if all(both)}


def _short(checksum: str) -> str:
    kind, _, digits = checksum.rpartition("_")
    return f"{kind or 'MD5'} {digits[:12]}"


def _users(found: InterfaceDifference, most: int) -> Iterator[str]:
    """Yield users by interface, the rest of a long list as a number."""
    by_interface: dict[str, list[InterfaceUser]] = {}
    for one in found.users:
        by_interface.setdefault(one.interface, []).append(one)
    for interface, users in sorted(by_interface.items()):
        for one in users[:most]:
            place = f" ({one.place})" if one.place else ""
            yield f"  {one.kind} {one.name} {one.how}: {interface}{place}"
        if len(users) > most:
            yield f"  {len(users) - most} more of {interface}"


def _step(one: VersionStep) -> str:
    if one.enough:
        return f"version of {one.package}: {one.before} -> {one.after}, as these changes ask for"
    number = "major" if one.step == "major" and not one.before.startswith("0.") else "minor"
    return (
        f"version of {one.package}: {one.before} -> {one.after}; these changes ask for {one.least} at least (a new "
        f"{number} version)"
    )
