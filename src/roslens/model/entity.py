"""What can be measured or found fault with: one typed id for source and for live systems."""

from __future__ import annotations

from enum import Enum

import msgspec


class EntityKind(str, Enum):
    """The kinds of entity, in the field's words."""

    WORKSPACE = "workspace"
    DISTRIBUTION = "distribution"
    REPOSITORY = "repository"
    PACKAGE = "package"
    FILE = "file"
    CLASS = "class"
    FUNCTION = "function"
    LAUNCH_FILE = "launch_file"
    HOST = "host"
    PROCESS = "process"
    NODE = "node"
    TOPIC = "topic"
    SERVICE = "service"
    ACTION = "action"
    PARAMETER = "parameter"
    CONNECTION = "connection"
    OBSERVER = "observer"


class EntityId(msgspec.Struct, frozen=True, order=True):
    """A typed key; its text form ``kind:name`` is what reports and URLs show.

    ``name`` is unique within the kind:

    - package: its name, or ``name@path`` where a workspace holds the name twice
    - file: its path below the workspace root, with ``/``
    - class: ``path#qualified::name``
    - observer: ``<host>/<what it observes>``, as it calls itself in its frames
    - function: ``path#qualified::name(parameter types)``, with ``~2``, ``~3``… appended for the
      second, third… of the same text in one file
    """

    kind: EntityKind
    name: str

    def __str__(self) -> str:
        """Return ``kind:name``."""
        return f"{self.kind.value}:{self.name}"

    @classmethod
    def parse(cls, text: str) -> EntityId:
        """Read the text form back.

        Raises:
            ValueError: the text has no known kind before its first colon.
        """
        kind, separator, name = text.partition(":")
        if not separator or not name:
            raise ValueError(f"{text!r} is not an entity id: expected kind:name")
        return cls(EntityKind(kind), name)


class Entity(msgspec.Struct, frozen=True, omit_defaults=True):
    """A class, function, file or package with what was measured of it.

    Lines are 1-based; 0 means that the entity has no line of its own. ``parent`` is the text form
    of an entity id. ``values`` maps quantity keys to numbers, in the unit of the quantity.
    """

    id: str
    kind: EntityKind
    name: str
    path: str = ""
    line: int = 0
    end_line: int = 0
    parent: str = ""
    approximate: bool = False
    values: dict[str, float] = {}
