"""Text of which a part may be unknown: what a name in source or a launch file comes to without running it."""

from __future__ import annotations

import msgspec


class Hole(msgspec.Struct, frozen=True, array_like=True, order=True, tag="hole", gc=False):
    """A part that cannot be known without running.

    Attributes:
        reason: in words: ``parameter "topic"``, ``argument "robot"``, ``environment ROBOT``, ``result of read()``.
        parameter: the parameter that decides it, where one does.
        default: what stands there where nothing is set; None where that is unknown too.
        below: the namespace that a relative name is below, where it is another one than the node's own.
    """

    reason: str
    parameter: str = ""
    default: str | None = None
    below: str = ""


class Text(msgspec.Struct, frozen=True, array_like=True, order=True):
    """Known pieces and holes in the order in which they stand; neighbours that are known are joined."""

    parts: tuple[str | Hole, ...] = ()

    @classmethod
    def of(cls, *parts: str | Hole | Text) -> Text:
        """Return the text of these parts one after the other."""
        joined: list[str | Hole] = []
        for part in parts:
            for piece in part.parts if isinstance(part, Text) else (part,):
                if isinstance(piece, str) and joined and isinstance(last := joined[-1], str):
                    joined[-1] = last + piece
                elif piece != "":
                    joined.append(piece)
        return cls(tuple(joined))

    @property
    def known(self) -> str | None:
        """The text, None where a part of it is unknown."""
        if not self.parts:
            return ""
        return self.parts[0] if len(self.parts) == 1 and isinstance(self.parts[0], str) else None

    @property
    def usual(self) -> str | None:
        """The text with the defaults of its holes, None where one has none."""
        pieces = [part if isinstance(part, str) else part.default for part in self.parts]
        return None if None in pieces else "".join(piece for piece in pieces if piece is not None)

    @property
    def holes(self) -> tuple[Hole, ...]:
        """What is unknown."""
        return tuple(part for part in self.parts if isinstance(part, Hole))

    @property
    def pattern(self) -> str:
        """The text with ``*`` for each hole."""
        return "".join(part if isinstance(part, str) else "*" for part in self.parts)

    def __bool__(self) -> bool:
        """Whether there is anything in it, known or not."""
        return bool(self.parts)

    def __str__(self) -> str:
        """Write it for people: holes as ``{reason}``."""
        return "".join(part if isinstance(part, str) else f"{{{part.reason}}}" for part in self.parts)


def unknown(reason: str, *, parameter: str = "", default: str | None = None) -> Text:
    """Return a text of which nothing is known but why."""
    return Text((Hole(reason, parameter, default),))
