"""What the walk over a Python tree collects: for functions, for the file outside functions, and for classes.

Names are kept as written, in bytes; :mod:`roslens.source.syntax.python` makes them readable once, at the end.
Spans are ``(start, end)`` in bytes.
"""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass, field

from roslens.source.syntax.facts import Control

Counts = defaultdict[str, int]
Span = tuple[int, int]


def _counts() -> Counts:
    return defaultdict(int)


@dataclass(slots=True)
class Scope:
    """A function, or the file outside functions (``inner`` is then false).

    Attributes:
        name: as written; ``qualified_name`` has the enclosing classes and functions.
        span: from ``def`` or ``async`` to the end of the body.
        body: the block of the body.
        owner: the class it is a method of; ``field_owner`` the class whose objects it can reach, which a function
            inside a method can too.
        receivers: the texts in front of names that belong to the object or class (``self.``, ``Laser.``).
        own_calls: how the function would call itself.
        nested: the functions defined directly inside; ``level`` is 1 for one that is in no other.
        header_counts: what stands in its own defaults and annotations.
    """

    name: str
    qualified_name: str
    span: Span
    inner: bool = True
    level: int = 1
    owner: ClassScope | None = None
    field_owner: ClassScope | None = None
    nested_in: str = ""
    decorators: tuple[str, ...] = ()
    parameters: tuple[str, ...] = ()
    body: Span = (0, 0)
    receivers: tuple[bytes, ...] = ()
    own_calls: frozenset[bytes] = frozenset()
    counts: Counts = field(default_factory=_counts)
    lambda_counts: Counts = field(default_factory=_counts)
    aside_counts: Counts = field(default_factory=_counts)
    header_counts: Counts = field(default_factory=_counts)
    control: list[Control] = field(default_factory=list)
    calls: set[bytes] = field(default_factory=set)
    types: set[bytes] = field(default_factory=set)
    parameter_types: set[bytes] = field(default_factory=set)
    nested: list[Scope] = field(default_factory=list)


@dataclass(slots=True)
class Attribute:
    """A data member: ``shared`` when it is set in the class body and never through an object."""

    name: bytes
    shared: bool
    types: set[bytes] = field(default_factory=set)
    calls: set[bytes] = field(default_factory=set)


@dataclass(slots=True)
class ClassScope:
    """A class: ``calls`` and ``types`` are those of its body outside methods."""

    name: str
    qualified_name: str
    span: Span
    bases: tuple[str, ...] = ()
    types: set[bytes] = field(default_factory=set)
    calls: set[bytes] = field(default_factory=set)
    methods: list[Scope] = field(default_factory=list)
    attributes: dict[bytes, Attribute] = field(default_factory=dict)


@dataclass(slots=True)
class Place:
    """Where in a scope something stands, which decides what it counts for.

    Attributes:
        scope: the function it belongs to, or the file.
        sinks: the counts that grow.
        types: the set that takes type names; ``calls`` the one that takes callees.
        owner: the class whose body this is, outside of its methods.
        aside: within what some tools do not look into; ``in_lambda`` within a lambda.
    """

    scope: Scope
    sinks: tuple[Counts, ...]
    types: set[bytes]
    calls: set[bytes]
    owner: ClassScope | None = None
    aside: bool = False
    in_lambda: bool = False

    def set_aside(self) -> Place:
        """Return this place as one that some tools do not look into."""
        if self.aside or not self.scope.inner:
            return self
        sinks = (*self.sinks, self.scope.aside_counts)
        return Place(self.scope, sinks, self.types, self.calls, self.owner, True, self.in_lambda)

    def inside_lambda(self) -> Place:
        """Return the place within a lambda that stands here."""
        if self.in_lambda:
            return self
        sinks = (*self.sinks, self.scope.lambda_counts)
        return Place(self.scope, sinks, self.types, self.calls, None, self.aside, True)


class Frame:
    """A node the walk is inside of.

    ``depth`` and ``part`` are those of events directly in it, ``own_part`` is where the node itself stands in its
    parent. Of an ``and`` or ``or``, ``own_depth`` is its own depth, ``left`` and ``right`` are the extents of its
    sides. ``defines`` is the function whose header this is.
    """

    __slots__ = ("defines", "depth", "end", "left", "own_depth", "own_part", "part", "place", "right", "role")

    defines: Scope
    left: Span
    right: Span
    own_depth: int

    def __init__(self, role: str, end: int, depth: int, part: str, own_part: str, place: Place) -> None:
        """Take everything as given."""
        self.role = role
        self.end = end
        self.depth = depth
        self.part = part
        self.own_part = own_part
        self.place = place
