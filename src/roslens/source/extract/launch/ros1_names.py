"""Names that roslaunch changes: remappings that take the place of others, parameters of nodes, namespaces."""

from __future__ import annotations

import msgspec

from roslens.source.extract.facts.launched import Remap, Setting
from roslens.source.extract.symbolic.text import Text


def remap_also(remaps: list[Remap], one: Remap) -> None:
    """Add a remapping; it takes the place of one from the same name."""
    remaps[:] = [other for other in remaps if other.source != one.source]
    remaps.append(one)


def private(setting: Setting) -> Setting:
    """Return a parameter of a node; roslaunch takes ``/`` in front of its name for nothing."""
    name = setting.name
    return msgspec.structs.replace(setting, name=Text.of("~" + name.head.lstrip("~/"), *name.behind))


def without_end(text: Text) -> Text:
    """Return a namespace without the separator at its end."""
    if text.parts == ("/",) or not text.tail:
        return text
    return Text((*text.parts[:-1], text.tail.rstrip("/")))
