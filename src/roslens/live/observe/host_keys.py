"""Which host belongs to which key: to the first that named it, as long as the monitor listens.

Agents may have keys of their own, so that who takes one from a host can speak for that host alone. A frame speaks for
the host of its sender, and for those whose values, processes and changes it tells. Being mentioned does not make a
host belong to a key, and what nobody names of itself may be reported by anybody.
"""

from __future__ import annotations

from collections.abc import Iterator

from roslens.model.entity import EntityKind
from roslens.model.wire import Frame

_OF_HOSTS = (EntityKind.HOST, EntityKind.PROCESS)
_PREFIXES = tuple(f"{kind.value}:" for kind in _OF_HOSTS)


class HostKeys:
    """Keys by the host that they named first. Keys are distinguished by number."""

    def __init__(self) -> None:
        self._key_of: dict[str, int] = {}

    def taken(self, frame: Frame, key: int) -> tuple[str, int] | None:
        """Let the host of a sender belong to a key; return a host that the frame speaks for and whose key is another.

        Returns:
            The host and its key; None where all is as it should be.
        """
        host = frame.sender.rpartition("/")[0] or frame.sender
        owner = self._key_of.setdefault(host, key)
        if owner != key:
            return host, owner
        if all(owner == key for owner in self._key_of.values()):
            return None
        return next(
            ((one, self._key_of[one]) for one in _reported_of(frame) if self._key_of.get(one, key) != key), None
        )


def _reported_of(frame: Frame) -> Iterator[str]:
    for sample in frame.samples:
        if sample.entity.kind in _OF_HOSTS:
            yield sample.entity.name.partition("/")[0]
    for tally in frame.tallies:
        yield tally.host
    for event in frame.events:
        if event.entity.startswith(_PREFIXES):
            yield event.entity.partition(":")[2].partition("/")[0]
    if frame.graph is not None:
        yield from frame.graph.hosts
        yield from frame.graph.identities
        for process in frame.graph.processes:
            yield process.host
