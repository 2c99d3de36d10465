"""The metadata of a message stream in a file of a recording."""

from __future__ import annotations

import msgspec


def resolved(name: str) -> str:
    """Return the name of a topic or node as playing the recording makes it: one without ``/`` is below the root."""
    return f"/{name}" if name and not name.startswith("/") else name


class Channel(msgspec.Struct, frozen=True):
    """A stream of messages in one file: a connection in ROS 1, a channel in MCAP, a topic in SQLite.

    Attributes:
        topic: its name, resolved.
        type: as the recording spells it.
        hash: of the type; empty where it is not stored.
        publisher: resolved name of the publishing node; empty where it is not stored.
        qos: offered profiles as stored.
        definition: text that defines the type, with those it is made of.
        language: of the definition: ``msg``, ``idl``, or empty where there is none.
        encoding: of messages: ``ros1``, ``cdr``, or what else the recording says.
        compression: of each message on its own; empty or ``zstd``.
    """

    topic: str
    type: str = ""
    hash: str = ""
    publisher: str = ""
    qos: str = ""
    definition: str = ""
    language: str = ""
    encoding: str = ""
    compression: str = ""
