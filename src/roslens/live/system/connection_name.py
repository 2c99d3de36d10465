"""The name of a connection: unique, and readable in a constraint."""

from __future__ import annotations

import re

from roslens.model.entity import EntityId, EntityKind

_ARROW = " > "
_UNKNOWN = "?"
_ESCAPED = re.compile(r"\\(.)", re.DOTALL)


def connection_id(topic: str, publisher: str, subscriber: str) -> EntityId:
    """Return the id of what a node publishes on a topic for another: ``/laser > /scan > /slam``.

    An end that is unknown is ``?``; of traffic seen at the publisher the subscriber is.
    """
    ends = (_end(publisher), _escaped(topic), _end(subscriber))
    return EntityId(EntityKind.CONNECTION, _ARROW.join(ends))


def connection_ends(entity: EntityId) -> tuple[str, str, str]:
    """Return topic, publisher and subscriber of a connection; unknown ones are empty.

    Raises:
        ValueError: the name is not that of a connection.
    """
    ends = entity.name.split(_ARROW)
    if len(ends) != len(("publisher", "topic", "subscriber")):
        raise ValueError(f"{entity.name!r} is not a connection, expected `/publisher > /topic > /subscriber`")
    publisher, topic, subscriber = ("" if end == _UNKNOWN else _ESCAPED.sub(r"\1", end) for end in ends)
    return topic, publisher, subscriber


def _end(name: str) -> str:
    return _UNKNOWN if not name else "\\?" if name == _UNKNOWN else _escaped(name)


def _escaped(name: str) -> str:
    return name.replace("\\", "\\\\").replace(">", "\\>") if ">" in name or "\\" in name else name
