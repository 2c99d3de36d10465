"""The secrets that open the pages, and who holds each."""

from __future__ import annotations

import hashlib
import hmac
import os
import secrets
import stat
from collections.abc import Iterable, Mapping
from pathlib import Path

from roslens.dashboard.access.person import Person, Role
from roslens.intake.bounded_file import read_bounded
from roslens.intake.generated_secret import Secret, new_secret, not_generated
from roslens.model.errors import UsageError

_EXPECTED = "lines `ROLE NAME TOKEN`, ROLE being view or operate, TOKEN one that roslens generated"
_ADVICE = "Add one with: roslens serve --new-token ROLE NAME --tokens"


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


def add_token(role: str, name: str, path: Path | None) -> str:
    """Return a new token, written to a file of tokens for its owner alone if there is a ``path``.

    Raises:
        UsageError: the role is not a role, or the name has spaces or a ``#``.
        OSError: the file cannot be written.
    """
    if role not in {one.value for one in Role}:
        raise UsageError(f"the role {role!r}", expected=" or ".join(one.value for one in Role))
    if not name.isprintable() or "#" in name or len(name.split()) != 1:
        raise UsageError(f"the name {name!r}", expected="one word, without `#`")
    token = new_secret(Secret.TOKEN)
    if path is not None:
        file = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_APPEND | os.O_CLOEXEC, 0o600)
        with os.fdopen(file, "a", encoding="utf-8") as stream:
            stream.write(f"{_line_end(path)}{role} {name} {token}\n")
    return token


def _line_end(path: Path) -> str:
    """Return what ends a last line that was left open."""
    text = read_bounded(path)
    return "\n" if text and not text.endswith(b"\n") else ""


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
        token, person = _person(words, path, where)
        if token in found:
            raise UsageError(
                f"{person.name!r} has the token of {found[token].name!r}", where=where, expected="one each"
            )
        found[token] = person
    if not found:
        raise UsageError("no token", where=str(path), expected=_EXPECTED, advice=f"{_ADVICE} {path}")
    return found


def _person(words: list[str], path: Path, where: str) -> tuple[str, Person]:
    """Return the token of a line, and who has it."""
    if len(words) != 3 or words[0] not in {one.value for one in Role}:
        # The line holds a secret: it is not quoted.
        raise UsageError(f"{len(words)} words that are not a token", where=where, expected=_EXPECTED)
    role, name, token = words
    if problem := not_generated(Secret.TOKEN, token):
        advice = f"Add another one with: roslens serve --new-token {role} {name} --tokens {path}"
        raise UsageError(
            f"{problem}, for {name!r}", where=where, expected="a token that roslens generated", advice=advice
        )
    return token, Person(name, Role(role))
