"""Where ``roslens top`` gets what it shows: a monitor that serves its page, or one in this process."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol
from urllib.parse import quote

import msgspec

from roslens.dashboard.live.detail import Detail
from roslens.dashboard.live.snapshot import VERSION, Snapshot
from roslens.model.errors import UsageError


class Feed(Protocol):
    """Something that knows how a robot stands; asked from a thread of its own."""

    title: str

    def snapshot(self) -> Snapshot | None:
        """Return the newest snapshot; None before the first.

        Raises:
            UsageError: there is no answer.
        """

    def detail(self, entity: str) -> Detail | None:
        """Return all that is known of an entity; None of one that is not there any more.

        Raises:
            UsageError: there is no answer.
        """


class AddressFeed:
    """A monitor at an address."""

    def __init__(self, address: str, fetch: Callable[[str, str], bytes]) -> None:
        """Ask ``address`` by ``fetch``, which is called with it and the name of a document."""
        self.title = address
        self._address = address
        self._fetch = fetch

    def snapshot(self) -> Snapshot | None:
        """Return the newest snapshot."""
        content = self._fetch(self._address, "snapshot.json")
        return decoded(content, self._address) if content else None

    def detail(self, entity: str) -> Detail | None:
        """Return all that is known of an entity."""
        content = self._fetch(self._address, f"detail.json?select={quote(entity, safe='')}")
        return msgspec.json.decode(content, type=Detail) if content else None


class PageFeed:
    """A monitor in this process: what its page would show."""

    def __init__(self, title: str, newest: Callable[[], bytes], detail: Callable[[str], bytes]) -> None:
        """Read what ``newest`` and ``detail`` return."""
        self.title = title
        self._newest = newest
        self._detail = detail

    def snapshot(self) -> Snapshot | None:
        """Return the newest snapshot."""
        content = self._newest()
        return decoded(content, self.title) if content else None

    def detail(self, entity: str) -> Detail | None:
        """Return all that is known of an entity."""
        content = self._detail(entity)
        return msgspec.json.decode(content, type=Detail) if content else None


def decoded(content: bytes, source: str) -> Snapshot:
    """Read a snapshot.

    Raises:
        UsageError: it is none, or of another version.
    """
    try:
        found = msgspec.json.decode(content, type=Snapshot)
    except msgspec.DecodeError as error:
        raise UsageError(f"{source} answers with no snapshot: {error}", expected="a `roslens watch --serve`") from None
    if found.version != VERSION:
        raise UsageError(
            f"{source} sends snapshots of version {found.version}", expected=f"version {VERSION}",
            advice="Use the same version of roslens on both",
        )  # fmt: skip
    return found
