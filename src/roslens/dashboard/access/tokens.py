"""The secrets that open the pages, and who holds each."""

from __future__ import annotations

import hashlib
import hmac
import re
import secrets
import stat
from collections.abc import Iterable, Mapping
from pathlib import Path

from roslens.dashboard.access.person import Person, Role
from roslens.intake.bounded_file import read_bounded
from roslens.model.errors import UsageError

SHORTEST = 43
"""Characters of a token: 256 bits where each stands for six."""

_FORM = re.compile(r"[A-Za-z0-9_-]+\Z")
_KINDS = tuple(map(re.compile, (r"[A-Z]", r"[a-z]", r"[0-9]")))
_FEWEST_DIFFERENT = 20
"""Characters: of 43 random ones of 64, fewer than 24 are different in one token of a million."""

_EXPECTED = "lines `ROLE NAME TOKEN`, ROLE being view or operate, TOKEN of 256 random bits (43 characters)"
_ADVICE = "Make one with: python3 -c 'import secrets; print(secrets.token_urlsafe(32))'"


class Tokens:
    """Identifies the holder of a token, and of the session that a browser was given for it.

    A browser keeps a session rather than the token: it is of no use to another run of the server.
    """

    def __init__(self, holders: Mapping[str, Person]) -> None:
        """``holders`` maps each token to its person."""
        key = secrets.token_bytes(32)
        self._people = tuple(holders.values())
        self._tokens = tuple(token.encode() for token in holders)
        self._sessions = tuple(hmac.new(key, token, hashlib.sha256).hexdigest().encode() for token in self._tokens)

    def __bool__(self) -> bool:
        """Whether there are any."""
        return bool(self._people)

    def holder(self, token: str) -> Person | None:
        """Return the holder of a token; None for an unknown token."""
        place = _place(token, self._tokens)
        return None if place is None else self._people[place]

    def session_of(self, token: str) -> str:
        """Return the session for the browser of the token's holder; empty for an unknown token."""
        place = _place(token, self._tokens)
        return "" if place is None else self._sessions[place].decode()

    def in_session(self, session: str) -> Person | None:
        """Return the person of a session; None for an unknown session."""
        place = _place(session, self._sessions)
        return None if place is None else self._people[place]


def _place(given: str, known: Iterable[bytes]) -> int | None:
    # All of them are compared, each in constant time: the duration reveals nothing.
    text = given.encode("utf-8", "surrogateescape")
    found = [hmac.compare_digest(text, one) for one in known]
    return found.index(True) if True in found else None


def made_token() -> str:
    """Return a new token of 256 random bits, of the form that :func:`read_tokens` asks for."""
    while not _looks_made(token := secrets.token_urlsafe(32)):
        pass
    return token


def read_tokens(path: Path) -> dict[str, Person]:
    """Read a file of tokens: one ``ROLE NAME TOKEN`` a line, ``#`` begins a comment.

    Raises:
        UsageError: it cannot be read, others than its owner can read it, or a line is wrong.
    """
    try:
        mode = path.stat().st_mode
        text = read_bounded(path).decode()
    except (OSError, UnicodeDecodeError) as error:
        reason = (error.strerror if isinstance(error, OSError) else None) or error
        raise UsageError(f"tokens cannot be read: {reason}", where=str(path), expected=_EXPECTED) from error
    if mode & (stat.S_IRWXG | stat.S_IRWXO):
        raise UsageError(
            f"others than its owner may read or write the tokens (mode {stat.S_IMODE(mode):o})",
            where=str(path), expected="mode 600", advice=f"chmod 600 {path}",
        )  # fmt: skip
    found: dict[str, Person] = {}
    for number, line in enumerate(text.splitlines(), 1):
        words = line.partition("#")[0].split()
        if not words:
            continue
        where = f"{path}:{number}"
        token, person = _person(words, where)
        if token in found:
            raise UsageError(
                f"{person.name!r} has the token of {found[token].name!r}", where=where, expected="one each"
            )
        found[token] = person
    if not found:
        raise UsageError("no token", where=str(path), expected=_EXPECTED, advice=_ADVICE)
    return found


def _looks_made(token: str) -> bool:
    """Return whether a token has the form of :func:`made_token`: people write neither digits nor so many characters."""
    if len(token) < SHORTEST or not _FORM.match(token):
        return False
    return len(set(token)) >= _FEWEST_DIFFERENT and all(kind.search(token) for kind in _KINDS)


def _person(words: list[str], where: str) -> tuple[str, Person]:
    """Return the token of a line, and who has it."""
    if len(words) != 3 or words[0] not in {one.value for one in Role}:
        # The line holds a secret: it is not quoted.
        raise UsageError(f"{len(words)} words that are not a token", where=where, expected=_EXPECTED)
    role, name, token = words
    if not _looks_made(token):
        raise UsageError(
            f"a token of {len(token)} characters for {name!r} that is not a generated one",
            where=where, expected=_EXPECTED, advice=_ADVICE,
        )  # fmt: skip
    return token, Person(name, Role(role))
