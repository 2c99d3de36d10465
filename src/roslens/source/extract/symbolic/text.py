"""Text of which a part may be unknown: what a name in source or a launch file comes to without running it."""

from __future__ import annotations

from collections.abc import Callable

import msgspec

from roslens.source.extract.symbolic.reason import OfMany, Reason, is_of_many

MOST_LENGTH = 100_000
MOST_PARTS = 1_000
"""What is put together of more parts, or longer ones, is no name: a loop that doubles a text ends here."""
_TOO_LONG = "a string that is too long to follow"


class Hole(msgspec.Struct, frozen=True, array_like=True, order=True, tag="hole", gc=False):
    """A part that cannot be known without running.

    Attributes:
        reason: what would have to be known.
        parameter: the parameter that decides it, where one does.
        default: what stands there where nothing is set; None where that is unknown too.
        below: the namespace that a relative name is below, where it is another one than the node's own.
        choice: the texts of which one stands there; none or one.
        among: the items of which it is one where nothing is set, as a list of YAML in one line; empty where unknown.
        named: the name of the parameter where a part of that is unknown too, and its default where it has one.
    """

    reason: Reason
    parameter: str = ""
    default: str | None = None
    below: Reason = ""
    choice: tuple[Choice, ...] = ()
    among: str = ""
    named: tuple[Text, ...] = ()


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
                    if len(last) > MOST_LENGTH:
                        return cls((Hole(_TOO_LONG),))
                elif piece != "":
                    joined.append(piece)
        return cls(tuple(joined) if len(joined) <= MOST_PARTS else (Hole(_TOO_LONG),))

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
        if None in pieces:
            return None
        whole = "".join(piece for piece in pieces if piece is not None)
        # What stands for the name of the node is it with something below only: not in ``~x``, nor in ``x~``.
        named = [place for place, one in enumerate(self.parts) if isinstance(one, Hole) and one.default == "~"]
        return None if named and (named != [0] or whole[:2] not in ("~", "~/")) else whole

    @property
    def holes(self) -> tuple[Hole, ...]:
        """What is unknown."""
        if self.known is not None:
            # Most texts are known as a whole.
            return ()
        return tuple([part for part in self.parts if not isinstance(part, str)])

    @property
    def only(self) -> Hole | None:
        """What is unknown where that is all of it; None else."""
        hole = self.parts[0] if len(self.parts) == 1 else None
        return hole if isinstance(hole, Hole) else None

    @property
    def head(self) -> str:
        """The known text that it begins with; empty where it begins with what is unknown."""
        first = self.parts[0] if self.parts else ""
        return first if isinstance(first, str) else ""

    @property
    def tail(self) -> str:
        """The known text that it ends with; empty where it ends with what is unknown."""
        last = self.parts[-1] if self.parts else ""
        return last if isinstance(last, str) else ""

    @property
    def is_global(self) -> bool:
        """Whether it is a name that begins with ``/``."""
        return self.head.startswith("/")

    @property
    def behind(self) -> tuple[str | Hole, ...]:
        """What stands behind the known text that it begins with."""
        return self.parts[1:] if self.head else self.parts

    @property
    def before(self) -> tuple[str | Hole, ...]:
        """What stands before the known text that it ends with."""
        return self.parts[:-1] if self.tail else self.parts

    @property
    def pattern(self) -> str:
        """The text with ``*`` for each hole."""
        return "".join([part if isinstance(part, str) else "*" for part in self.parts])

    def with_known(self, change: Callable[[str], str]) -> Text:
        """Return a text with each of its known pieces changed."""
        return Text.of(*(change(part) if isinstance(part, str) else part for part in self.parts))

    def with_holes(self, change: Callable[[Hole], str | Hole | Text]) -> Text:
        """Return a text with something in place of each of its holes."""
        return Text.of(*(part if isinstance(part, str) else change(part) for part in self.parts))

    def mapped(self, change: Callable[[Hole], Hole | Text]) -> Text:
        """Return a text with each of its holes changed, those of its choices too."""
        if not self.holes:
            return self
        return self.with_holes(lambda hole: _mapped(hole, change))

    def __bool__(self) -> bool:
        """Whether there is anything in it, known or not."""
        return bool(self.parts)

    def __str__(self) -> str:
        """Write it for people: holes as ``{reason}``."""
        return "".join([part if isinstance(part, str) else f"{{{part.reason}}}" for part in self.parts])


class Formula(msgspec.Struct, frozen=True, array_like=True, gc=False):
    """What may hold or not: a base of the classes of :data:`Condition`, which is closed.

    Conditions are ordered as their texts are, so that what is sorted by them has one order.
    """

    def __lt__(self, other: object) -> bool:
        """Compare texts."""
        return str(self) < str(other)

    def __gt__(self, other: object) -> bool:
        """Compare texts."""
        return str(self) > str(other)


class Written(Formula, frozen=True, tag="written"):
    """A condition that is not looked into, as source has it."""

    text: str

    def changed(self, change: Callable[[Text], Text]) -> Condition:  # noqa: ARG002 - it asks about no text
        """Return it as it is."""
        return self

    def __str__(self) -> str:
        """Write it for people."""
        return self.text


class NoException(Formula, frozen=True, tag="no exception"):
    """A block has run to its end."""

    def changed(self, change: Callable[[Text], Text]) -> Condition:  # noqa: ARG002 - it asks about no text
        """Return it as it is."""
        return self

    def __str__(self) -> str:
        """Write it for people."""
        return "no exception"


class IsTrue(Formula, frozen=True, tag="true"):
    """A text has a true value, by the rules of parameters."""

    text: Text

    def changed(self, change: Callable[[Text], Text]) -> Condition:
        """Return the condition with its text changed."""
        return IsTrue(change(self.text))

    def __str__(self) -> str:
        """Write it for people."""
        return str(self.text)


class IsSet(Formula, frozen=True, tag="set"):
    """The parameter that a text stands for is set."""

    text: Text

    def changed(self, change: Callable[[Text], Text]) -> Condition:
        """Return the condition with its text changed."""
        return IsSet(change(self.text))

    def __str__(self) -> str:
        """Write it for people."""
        return f"{self.text} is set"


class AreEqual(Formula, frozen=True, tag="equal"):
    """Two texts are equal."""

    one: Text
    other: Text

    def changed(self, change: Callable[[Text], Text]) -> Condition:
        """Return the condition with its texts changed."""
        return AreEqual(change(self.one), change(self.other))

    def __str__(self) -> str:
        """Write it for people."""
        return f"{self.one} == {self.other}"


class Not(Formula, frozen=True, tag="not"):
    """Another condition does not hold. See :func:`~roslens.source.extract.symbolic.condition.negated`."""

    of: Condition

    def changed(self, change: Callable[[Text], Text]) -> Condition:
        """Return the condition with its texts changed."""
        return Not(self.of.changed(change))

    def __str__(self) -> str:
        """Write it for people: in brackets what would be read otherwise."""
        if type(self.of) is NoException:
            return "an exception"
        written = str(self.of)
        return f"not ({written})" if " and " in written or " or " in written else f"not {written}"


class And(Formula, frozen=True, tag="and"):
    """All of several conditions hold; of none: always."""

    of: tuple[Condition, ...]

    def changed(self, change: Callable[[Text], Text]) -> Condition:
        """Return the condition with its texts changed."""
        return And(tuple(one.changed(change) for one in self.of))

    def __str__(self) -> str:
        """Write it for people."""
        return " and ".join(f"({one})" if type(one) is Or else str(one) for one in self.of) if self.of else "always"


class Or(Formula, frozen=True, tag="or"):
    """One of several conditions holds at least; of none: never."""

    of: tuple[Condition, ...]

    def changed(self, change: Callable[[Text], Text]) -> Condition:
        """Return the condition with its texts changed."""
        return Or(tuple(one.changed(change) for one in self.of))

    def __str__(self) -> str:
        """Write it for people."""
        return " or ".join(map(str, self.of)) if self.of else "never"


Atom = Written | NoException | IsTrue | IsSet | AreEqual
Condition = Atom | Not | And | Or
"""A condition of code, and what decides one: the two have the same form."""
Conditions = tuple[Condition, ...]
"""Conditions that hold together, outermost first."""


class Choice(msgspec.Struct, frozen=True, array_like=True, order=True, tag="choice", gc=False):
    """One text where a condition holds, another one else; ``test`` is what decides it, none or one."""

    condition: Condition
    then: Text
    otherwise: Text
    test: tuple[Condition, ...] = ()


def _mapped(hole: Hole, change: Callable[[Hole], Hole | Text]) -> Hole | Text:
    if not hole.choice:
        return change(hole)
    (one,) = hole.choice
    test = tuple(each.changed(lambda text: text.mapped(change)) for each in one.test)
    choice = Choice(one.condition, one.then.mapped(change), one.otherwise.mapped(change), test)
    return msgspec.structs.replace(hole, choice=(choice,))


def said(*parts: str | Text, most: int = 1000) -> Reason:
    """Return texts as a reason; one of many strings is described as such.

    Args:
        parts: that are written one after the other.
        most: so many signs are kept.
    """
    words = "".join(map(str, parts))[:most]
    many = any(is_of_many(hole.reason) for one in parts if isinstance(one, Text) for hole in one.holes)
    return OfMany(words) if many else words


def unknown(reason: Reason, *, parameter: str = "", default: str | None = None) -> Text:
    """Return a text of which nothing is known but why."""
    return Text((Hole(reason, parameter, default),))
