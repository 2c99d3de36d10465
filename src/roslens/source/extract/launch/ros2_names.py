"""Names of nodes of ROS 2 in their namespaces."""

from __future__ import annotations

from roslens.source.extract.facts.launched import Launched
from roslens.source.extract.symbolic.text import Text


def within(namespace: Text, name: Text) -> Text:
    """Return a namespace below another one, or itself where it begins with ``/``."""
    if not name.parts:
        return namespace
    is_global = name.is_global
    if len(name.parts) > 1 and name.tail.endswith("/"):
        name = Text((*name.parts[:-1], name.tail.rstrip("/")))
    elif len(name.parts) == 1 and len(name.head) > 1:
        name = Text.of(name.head.rstrip("/"))
    if is_global:
        return name
    return Text.of("/", name) if namespace.parts == ("/",) else Text.of(namespace, "/", name)


def full_name(launched: Launched) -> Text:
    """Return the resolved name of a node that was given one."""
    return within(launched.namespace, launched.name) if launched.name.parts else Text()
