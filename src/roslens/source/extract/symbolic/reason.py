"""Why a part of a text is not known: the reasons that decide what fills it have types, all others are words.

A reason is written in one place, its ``__str__``. Where something depends on a reason, it asks for its type.
"""

from __future__ import annotations

from enum import Enum

import msgspec

FIRST = 0
"""The node that is evaluated first, of those that one evaluation makes."""
MAKER = -1
"""The node that makes the node in question."""


class _Reason(msgspec.Struct, frozen=True, array_like=True, gc=False):
    """Orders reasons as their texts are."""

    def __lt__(self, other: object) -> bool:
        return str(self) < str(other)

    def __gt__(self, other: object) -> bool:
        return str(self) > str(other)


class NamePart(Enum):
    """What a node fills in of its own name."""

    NAME = "name of"
    FULL_NAME = "full name of"
    NAMESPACE = "namespace of"
    ABOVE = "namespace above"
    """The namespace without its last part."""


class OfNode(_Reason, frozen=True, tag="of node"):
    """A part of the name of a node: of this one, of a further one by its number, or of :data:`MAKER`."""

    what: NamePart
    node: int = FIRST

    def __str__(self) -> str:
        """Write it for people."""
        return f"{self.what.value} the node{' that creates it' if self.node == MAKER else _numbered(self.node)}"


class OfParameter(_Reason, frozen=True, tag="of parameter"):
    """The value of a parameter of a node, identified as in :class:`OfNode`."""

    name: str
    node: int = FIRST

    def __str__(self) -> str:
        """Write it for people."""
        if self.node == MAKER:
            return f"parameter {self.name} of the node that creates it"
        return f"parameter {self.name}{' of node' if self.node else ''}{_numbered(self.node)}"


class OfHandle(_Reason, frozen=True, tag="of handle"):
    """The namespace that a node handle is given."""

    of: Reason

    def __str__(self) -> str:
        """Write it for people."""
        return f"namespace of the handle: {self.of}"


class OfController(_Reason, frozen=True, tag="of controller"):
    """The namespace of a controller, which who loads it knows."""

    def __str__(self) -> str:
        """Write it for people."""
        return "namespace of the controller"


class EachOf(_Reason, frozen=True, tag="each of"):
    """Whichever item of a list."""

    of: Reason

    def __str__(self) -> str:
        """Write it for people."""
        return f"each of {self.of}"


class ItemOf(_Reason, frozen=True, tag="item of"):
    """The item at a place of a list."""

    place: int
    of: Reason

    def __str__(self) -> str:
        """Write it for people."""
        return f"item {self.place} of {self.of}"


class PartOf(_Reason, frozen=True, tag="part of"):
    """What a map in a list has under a key."""

    key: str
    of: Reason

    def __str__(self) -> str:
        """Write it for people."""
        return f"{self.key} of {self.of}"


class NumberBelow(_Reason, frozen=True, tag="number below"):
    """Whichever number a loop counts, from 0 on, that ends at the value of a parameter.

    Attributes:
        of: the value.
        default: of the parameter; empty where it has none, or an unknown one.
    """

    of: Reason
    default: str = ""

    def __str__(self) -> str:
        """Write it for people."""
        return f"each number below {self.of}"


class OfEnvironment(_Reason, frozen=True, tag="of environment"):
    """A variable of the environment."""

    name: str

    def __str__(self) -> str:
        """Write it for people."""
        return f"environment {self.name}"


class RandomEnd(_Reason, frozen=True, tag="random end"):
    """A part that is another one at each start, so that a name is there once."""

    def __str__(self) -> str:
        """Write it for people."""
        return "random end"


class NotSet(_Reason, frozen=True, tag="not set"):
    """Something that has a value only where it is given one."""

    what: str

    def __str__(self) -> str:
        """Write it for people."""
        return f"{self.what}, which is not set"


class InstalledAt(_Reason, frozen=True, tag="installed at"):
    """The folder into which a package is installed."""

    package: str

    def __str__(self) -> str:
        """Write it for people."""
        return f"folder into which {self.package} is installed"


class RewrittenFile(_Reason, frozen=True, tag="rewritten file"):
    """The path of a copy of a file that a launch file makes when it starts.

    Attributes:
        of: the path of the file.
        number: of the changes that are made to it, in one evaluation of a launch file.
    """

    of: str
    number: int

    def __str__(self) -> str:
        """Write it for people."""
        return f"a rewritten copy of {self.of}"


class OfPackage(_Reason, frozen=True, tag="of package"):
    """The folder of a package that is not in the workspace."""

    name: str

    def __str__(self) -> str:
        """Write it for people."""
        return f"folder of package {self.name}, which is not in the workspace"


class OfMany(_Reason, frozen=True, tag="of many"):
    """One of so many texts that they are not distinguished, or what is made of it."""

    text: str

    def __str__(self) -> str:
        """Write it for people."""
        return self.text


Reason = (
    str | OfNode | OfParameter | OfHandle | OfController | EachOf | ItemOf | PartOf | NumberBelow
    | OfEnvironment | RandomEnd | NotSet
    | InstalledAt | RewrittenFile | OfMany | OfPackage
)  # fmt: skip
"""Why something is unknown; nothing depends on the content of plain text."""


def is_outside(reason: Reason) -> bool:
    """Return whether something is unknown as it is not in the workspace."""
    match reason:
        case OfPackage() | OfEnvironment():
            return True
    return False


def is_of_many(reason: Reason) -> bool:
    """Return whether something is one of many strings, or a part of one."""
    match reason:
        case EachOf(of=of) | ItemOf(of=of) | PartOf(of=of) | NumberBelow(of=of) | OfHandle(of=of):
            return is_of_many(of)
    return isinstance(reason, OfMany)


def node_of_reason(reason: Reason) -> int:
    """Return the number of the node whose parameter or name decides; :data:`FIRST` where the reason names none."""
    match reason:
        case OfParameter(node=node) | OfNode(node=node):
            return node
        case EachOf(of=of) | ItemOf(of=of) | PartOf(of=of) | NumberBelow(of=of) | OfHandle(of=of):
            return node_of_reason(of)
    return FIRST


def for_node(reason: Reason, node: int) -> Reason:
    """Return a reason that a node decides as one that another node does, by its number."""
    match reason:
        case OfParameter(name=name):
            return OfParameter(name, node)
        case OfNode(what=what):
            return OfNode(what, node)
        case EachOf(of=of):
            return EachOf(for_node(of, node))
        case ItemOf(place=place, of=of):
            return ItemOf(place, for_node(of, node))
        case PartOf(key=key, of=of):
            return PartOf(key, for_node(of, node))
        case NumberBelow(of=of, default=default):
            return NumberBelow(for_node(of, node), default)
        case OfHandle(of=of):
            return OfHandle(for_node(of, node))
    return reason


def _numbered(node: int) -> str:
    return f" no. {node}" if node > FIRST else ""
