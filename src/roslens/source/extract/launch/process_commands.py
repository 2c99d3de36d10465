"""Processes of launch files that are nodes after all: ``ros2 run``, ``ros2 topic pub`` and their kin."""

from __future__ import annotations

import shlex

import msgspec

from roslens.source.extract.facts.launched import Launched
from roslens.source.extract.symbolic.reason import RandomEnd
from roslens.source.extract.symbolic.text import Hole, Text

_CLIENTS = {
    "topic": ("pub", "echo", "hz", "bw", "delay"),
    "service": ("call",),
    "action": ("send_goal",),
}
"""Commands of ros2 that are a node as long as they run, with what they do."""


def as_node(launched: Launched) -> Launched | None:
    """Return the node that a process is, by the words of its command; None where it is none that is known."""
    words = _words(launched)
    known = [one.known for one in words]
    if known[:2] == ["ros2", "run"] and len(words) > 3 and not (known[2] or "-").startswith("-"):
        return msgspec.structs.replace(
            launched, package=words[2], executable=words[3], arguments=tuple(words[4:]), kind="node"
        )
    if len(words) < 3 or known[0] != "ros2" or known[2] not in _CLIENTS.get(known[1] or "", ()):
        return None
    # ros2cli, node/direct.py: the name has the number of the process in it, where none is given.
    given = next((words[place + 1] for place, one in enumerate(known[:-1]) if one in ("-n", "--node-name")), None)
    return msgspec.structs.replace(
        launched,
        package=Text.of(f"ros2{known[1]}"),
        executable=words[2],
        arguments=tuple(words[3:]),
        kind="node",
        name=given or Text.of("_ros2cli_", Hole(RandomEnd())),
        anonymous=given is None,
    )


def _words(launched: Launched) -> list[Text]:
    words = [one for one in (launched.executable, *launched.arguments) if one.parts]
    whole = words[0].known if len(words) == 1 else None
    if whole is None:
        return words
    try:
        return [Text.of(one) for one in shlex.split(whole)]
    except ValueError:
        return words
