"""One line of a journal: what happened, and the hash that binds it to all lines before it.

A line is a JSON object with the keys ``n`` (number of the entry, from 0), ``time`` (seconds since the epoch), ``what``,
``fields``, ``before`` (hash of the entry before it, empty for the first) and last ``hash``: SHA-256, in hexadecimal, of
the bytes of the line up to ``,"hash":``. So nothing can be changed, left out or put in between without every hash after
it being another one. That the end of a journal was cut off shows against a hash that was kept elsewhere. Behind it may
be ``code``, which shows that whoever wrote the entry has the key of the journal (``signing.py``).
"""

from __future__ import annotations

import hashlib
from typing import Any

import msgspec

from roslens.store.journals.signing import Signing

MOST_BYTES = 64_000
"""Of one line; longer texts in it are shortened until it fits."""

_SHORTENED = "… (shortened)"
_ENCODER = msgspec.json.Encoder(order="sorted")


class Entry(msgspec.Struct, frozen=True):
    """What a journal holds of one happening.

    Attributes:
        n: number, from 0.
        time: seconds since the epoch, on the clock of whoever wrote it.
        what: ``decided``, ``announced``, ``outcome`` and others that the journal's page lists.
        fields: what is known of it, in JSON's types.
        before: hash of the entry before it.
        hash: of this one.
        code: of its hash, made with the key of the journal; empty where it has none.
    """

    n: int
    time: float
    what: str
    fields: dict[str, Any]
    before: str
    hash: str
    code: str = ""


class EntryError(ValueError):
    """A line that is no entry, or whose hash is not that of its content."""


_DECODER = msgspec.json.Decoder(Entry)


def written(
    n: int, time: float, what: str, fields: dict[str, Any], before: str, signing: Signing | None = None
) -> tuple[Entry, bytes]:
    """Return an entry and its line, with the end of the line."""
    most = MOST_BYTES
    while True:
        body = _ENCODER.encode({"before": before, "fields": fields, "n": n, "time": time, "what": what})[:-1]
        if len(body) <= MOST_BYTES - 200:
            break
        most //= 4
        fields = _shortened(fields, most) if most else {"shortened": True}
    found = hashlib.sha256(body).hexdigest()
    line = body + b',"hash":"' + found.encode() + b'"'
    code = signing.code(found) if signing is not None else ""
    if code:
        line += b',"code":"' + code.encode() + b'"'
    return Entry(n, time, what, fields, before, found, code), line + b"}\n"


def read(line: bytes) -> Entry:
    """Read a line without its end.

    Raises:
        EntryError: it is no entry, or its hash is another one than that of its content.
    """
    try:
        entry = _DECODER.decode(line)
    except (msgspec.DecodeError, UnicodeDecodeError, RecursionError) as error:
        raise EntryError(f"{line[:60]!r} is not an entry: {error}") from None
    body, separator, _ = line.rpartition(b',"hash":"')
    if not separator or hashlib.sha256(body).hexdigest() != entry.hash:
        raise EntryError(f"entry {entry.n} was changed: its hash is not that of its content")
    return entry


def _shortened(value: Any, most: int) -> Any:
    if isinstance(value, str):
        return value if len(value) <= most else value[:most] + _SHORTENED
    if isinstance(value, dict):
        return {key: _shortened(one, most) for key, one in list(value.items())[:most]}
    if isinstance(value, (list, tuple)):
        return [_shortened(one, most) for one in value[:most]]
    return value
