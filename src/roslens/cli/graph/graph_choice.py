"""Which part of a configuration is shown."""

from __future__ import annotations

from collections.abc import Sequence
from fnmatch import fnmatchcase

import msgspec

from roslens.model.configuration import Configuration
from roslens.model.errors import UsageError


def chosen(configuration: Configuration, nodes: Sequence[str], *, implicit: bool) -> Configuration:
    """Return the part of a configuration that is asked for.

    Args:
        configuration: all of it.
        nodes: names, with or without ``/`` in front, or patterns; none means all.
        implicit: whether endpoints that every node has are part of it.
    """
    kept = [one for one in configuration.nodes if not nodes or any(_fits(one.name, name) for name in nodes)]
    names = {one.name for one in kept}
    if not implicit:
        kept = [
            msgspec.structs.replace(one, endpoints=tuple(end for end in one.endpoints if not end.implicit))
            for one in kept
        ]
    unresolved = tuple(one for one in configuration.unresolved if not nodes or one.node in names)
    return msgspec.structs.replace(configuration, nodes=tuple(kept), unresolved=unresolved)


def require_nodes(configurations: Sequence[Configuration], nodes: Sequence[str]) -> None:
    """Check that every node that is asked for is there.

    Raises:
        UsageError: one is not.
    """
    import difflib

    names = sorted({node.name for one in configurations for node in one.nodes})
    for name in nodes:
        if not any(_fits(one, name) for one in names):
            near = difflib.get_close_matches(name, names, 1, 0.4)
            advice = f'Did you mean "{near[0]}"?' if near else ""
            raise UsageError(f'no node "{name}"', expected=f"one of {', '.join(names[:8]) or 'none'}", advice=advice)


def _fits(name: str, wanted: str) -> bool:
    return fnmatchcase(name, wanted) or fnmatchcase(name, f"/{wanted.lstrip('/')}") or name.endswith(f"/{wanted}")
