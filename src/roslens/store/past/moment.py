"""How a whole system stood at an instant, as it is kept."""

from __future__ import annotations

import zlib

import msgspec

from roslens.model.graph import Graph
from roslens.model.verdict import Verdict
from roslens.store.encodable import encodable

MOST_BYTES = 64_000_000
"""Of a moment when it is inflated; a file from elsewhere may claim anything."""


class Moment(msgspec.Struct, frozen=True, omit_defaults=True):
    """What cannot be seen in values: who is there, and how every constraint stands.

    Attributes:
        time: seconds since the epoch.
        graph: who is there.
        verdicts: how every constraint stands about every entity.
        former: by topic that nobody publishes, the nodes that did.
        hosts: by node where it runs or ran.
        observers: by text form of the id of an entity, how its values are observed.
    """

    time: float
    graph: Graph = Graph("")
    verdicts: tuple[Verdict, ...] = ()
    former: dict[str, tuple[str, ...]] = {}
    hosts: dict[str, str] = {}
    observers: dict[str, str] = {}


def packed(moment: Moment) -> bytes:
    """Return a moment as it is kept."""
    try:
        content = _ENCODER.encode(moment)
    except UnicodeEncodeError:
        # Names from outside may hold lone surrogates, which no encoding has.
        content = _ENCODER.encode(encodable(moment))
    return zlib.compress(content, 3)


def unpacked(content: bytes) -> Moment:
    """Read a moment.

    Raises:
        ValueError: it is none.
    """
    inflater = zlib.decompressobj()
    try:
        text = inflater.decompress(content, MOST_BYTES)
    except zlib.error as error:
        raise ValueError(f"a moment that cannot be read: {error}") from None
    if inflater.unconsumed_tail:
        raise ValueError(f"a moment of more than {MOST_BYTES:,} bytes")
    return _DECODER.decode(text)


_ENCODER = msgspec.msgpack.Encoder()
_DECODER = msgspec.msgpack.Decoder(Moment)
