"""What the walk over a C++ tree is in: a function, a class, a statement; and what it collects of each."""

from __future__ import annotations

from collections import defaultdict

from roslens.source.syntax.cpp_names import Declarator, scope_within
from roslens.source.syntax.facts import Control
from roslens.source.syntax.query.cpp_query import Span


class FunctionScope:
    """A function while the walk is in it, and what was collected of it."""

    def __init__(self, declarator: Declarator, span: Span, prefix: str, owner: ClassScope | None) -> None:
        """Begin a function whose enclosing scopes are ``prefix``."""
        self.declarator = declarator
        self.span = span
        self.body: Span = (span[1], span[1])
        parts = [part for part in (prefix, scope_within(prefix, declarator.scope), declarator.name) if part]
        self.qualified_name = "::".join(parts)
        if owner is not None:
            self.class_name = owner.qualified_name
        else:
            self.class_name = "::".join(parts[:-1]) if declarator.scope else ""
        self.access = owner.access if owner is not None else ""
        self.static = self.virtual = False
        self.counts: defaultdict[str, int] = defaultdict(int)
        self.lambda_counts: defaultdict[str, int] = defaultdict(int)
        self.alternative_counts: defaultdict[str, int] = defaultdict(int)
        self.control: list[Control] = []
        self.lambdas: list[Span] = []
        self.alternatives: list[Span] = []
        self.inner: list[Span] = []


class Member:
    """A data member or a declared member function."""

    def __init__(self, access: str, span: Span) -> None:
        """Begin a member; ``span`` of one defined here ends with its parameters."""
        self.access = access
        self.span = span
        self.names: list[str] = []
        self.declarator: Declarator | None = None
        self.static = self.virtual = self.defined = False


class ClassScope:
    """A class while the walk is in it, and what was collected of it."""

    def __init__(self, name: str, prefix: str, kind: str, span: Span, bases: tuple[str, ...], access: str) -> None:
        """Begin a class whose enclosing scopes are ``prefix``."""
        self.name = name
        self.qualified_name = f"{prefix}::{name}" if prefix else name
        self.kind = kind
        self.span = span
        self.bases = bases
        self.access = access
        self.members: list[Member] = []
        self.friends: list[str] = []


class Frame:
    """Where the walk is: until ``end``, so deep, in this part of that statement of this function or class."""

    __slots__ = ("alternative", "depth", "end", "in_lambda", "own_depth", "own_part", "owner", "part", "prefix", "role",
                 "scope", "start")  # fmt: skip

    def __init__(self, role: str, end: int, above: Frame | None) -> None:
        """Begin as a part of ``above``; None begins the file."""
        self.role = role
        self.start = 0
        self.end = end
        if above is None:
            self.depth = self.own_depth = 0
            self.part = self.own_part = "body"
            self.scope: FunctionScope | None = None
            self.owner: ClassScope | None = None
            self.prefix = ""
            self.in_lambda = self.alternative = False
            return
        self.depth = self.own_depth = above.depth
        self.part = self.own_part = above.part
        self.scope = above.scope
        self.owner = above.owner
        self.prefix = above.prefix
        self.in_lambda = above.in_lambda
        self.alternative = above.alternative
