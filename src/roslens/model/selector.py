"""Which entities something is about, by kind and patterns of names."""

from __future__ import annotations

import msgspec

from roslens.model.entity import EntityKind


class Selector(msgspec.Struct, frozen=True, omit_defaults=True):
    """Which entities a constraint is about; every part that is given has to hold.

    Patterns are matched against resolved names: ``*`` is any text within one segment, ``**`` any text, ``?`` one
    character of a segment, ``{a,b}`` one of these; a pattern that begins with ``re:`` is a regular expression.

    Attributes:
        kind: of the entities.
        name: pattern of the name; of a connection that of its topic.
        host: pattern of the host on which it is.
        type: pattern of the message type of a topic or connection.
        publisher: pattern of the publishing node of a topic or connection.
        subscriber: pattern of the receiving node of a connection.
        without: patterns of names that are left out.
    """

    kind: EntityKind
    name: str = "**"
    host: str = ""
    type: str = ""
    publisher: str = ""
    subscriber: str = ""
    without: tuple[str, ...] = ()
