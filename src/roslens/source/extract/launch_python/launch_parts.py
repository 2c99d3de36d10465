"""Parts of what launch files make: remappings, names of containers, types of parameters."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from roslens.source.extract.domain.abstract_value import Named
from roslens.source.extract.launch_python.deferred import Deferred, Value
from roslens.source.extract.launch_python.launch_values import Made, as_value, plain


def type_of(found: Any) -> str:
    """Return the name of a type that is given to a parameter."""
    return found.name.rpartition(".")[2] if isinstance(found, Named) else ""


def name_of(container: Made) -> Value:
    """Return the name of a container that is meant by the object."""
    namespace, name = plain(container.named.get("namespace")), plain(container.named.get("name"))
    if namespace in (None, ""):
        return as_value(name)
    return Deferred("text", (as_value(namespace), "/", as_value(name)))


def pairs_of(remaps: Any) -> Iterator[tuple[Value, Value]]:
    """Yield the pairs of names of remappings."""
    for pair in remaps if isinstance(remaps, list | tuple) else ():
        if isinstance(pair, list | tuple) and len(pair) == 2:
            yield as_value(pair[0]), as_value(pair[1])
