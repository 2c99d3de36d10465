"""What classes, functions and methods of ROS do that are not in the workspace: found by name, one function each.

The words are in the modules of ``overlays``, all of which are loaded; each registers itself by :func:`outer` and
:func:`method`.
"""

from __future__ import annotations

from collections.abc import Callable as Function1
from functools import cache
from importlib import import_module
from pathlib import Path
from pkgutil import iter_modules
from typing import TYPE_CHECKING, Any, TypeVar

import msgspec

from roslens.source.extract.domain.abstract_value import (
    Handle,
    Made,
    Named,
    Names,
    NodeBuilder,
    Obj,
    QosValue,
    Unknown,
    Value,
)
from roslens.source.extract.domain.kinds import first_of_kind
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.ir.program import Expression
from roslens.source.extract.symbolic.text import Text

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context


_Kind = TypeVar("_Kind")


class CallSite(msgspec.Struct, frozen=True):
    """A call of something outside of the workspace.

    Attributes:
        name: of the function, class or method.
        arguments: values by position.
        keywords: values by name.
        templates: template arguments, as written.
        written: the arguments as expressions, for those that are set by the call.
        evidence: where it is written.
    """

    name: str
    arguments: list[Value]
    keywords: Names
    templates: tuple[str, ...]
    written: tuple[Expression, ...]
    evidence: Evidence

    def argument(self, place: int, *names: str, default: Value = None) -> Value:
        """Return an argument by position or the first of its names."""
        for name in names:
            if name in self.keywords:
                return self.keywords[name]
        return self.arguments[place] if 0 <= place < len(self.arguments) else default

    def given(self, kind: type[_Kind], place: int, *names: str) -> _Kind | None:
        """Return an argument where it is of a kind; None where it is anything else, or is not given."""
        value = self.argument(place, *names)
        return value if isinstance(value, kind) else None


def expression_of(ctx: Context, called: CallSite, place: int) -> Expression | None:
    """Return an argument by position as an expression; None where that is not known.

    Where an object is made, its arguments are those of the call that makes it.
    """
    written = called.written or ctx.state.written
    return written[place] if written and len(written) == len(called.arguments) else None


def written_as(ctx: Context, called: CallSite, place: int) -> str:
    """Return an argument by position as source has it; empty where that is not known."""
    written = expression_of(ctx, called, place)
    return ctx.index.memo.text(written) if written is not None else ""


Word = Function1[["Context", Any, CallSite], Value]
"""What a call does; the second is the object that it is made on, of the kind under which the word is registered."""
_OUTER: dict[str, Word] = {}
_METHODS: dict[tuple[str, str], Word] = {}
_ANYWHERE: dict[str, Word] = {}
_NAMES: set[str] = set()
"""Of methods that are known of any kind of object."""
_QUIET: set[Word] = set()
_BETTER = {
    "rosbag.Bag": ("rosbag.Bag", ""),
    "tf2_ros.Buffer": ("tf2_ros.Buffer", ""),
    "Buffer": ("tf2_ros.Buffer", "/tf2_ros/buffer.py"),
}
"""By the qualified name of a class of a library its whole name, and the end of the path of the file that has it."""
LISTENER = "ParamListener"
"""The class that generate_parameter_library makes, in whatever namespace: it declares parameters."""
_OVERLAYS = Path(__file__).parents[1] / "overlays"
"""Each module in its folders is loaded, and registers what it knows."""


def outer(*names: str, quiet: bool = False) -> Function1[[Word], Word]:
    """Register what a function or constructor does, by whole names joined by ``.``.

    Args:
        names: of it.
        quiet: whether it only answers: it makes nothing, and changes nothing of a node.
    """

    def keep(word: Word) -> Word:
        _OUTER.update(dict.fromkeys(names, word))
        _QUIET.update({word} if quiet else ())
        return word

    return keep


def method(kind: str, *names: str, anywhere: bool = False, quiet: bool = False) -> Function1[[Word], Word]:
    """Register what a method of a kind of object does.

    Args:
        kind: ``node``, ``handle``, ``qos``, ``made``, or the whole name of a class.
        names: of the method.
        anywhere: whether it is meant where the object is unknown too.
        quiet: whether it only answers.
    """

    def keep(word: Word) -> Word:
        _METHODS.update({(kind, name): word for name in names})
        _NAMES.update(names)
        if anywhere:
            _ANYWHERE.update(dict.fromkeys(names, word))
        _QUIET.update({word} if quiet else ())
        return word

    return keep


@cache
def _load() -> None:
    for folder in ("language", "ros"):
        for module in iter_modules([str(_OVERLAYS / folder)]):
            import_module(f"roslens.source.extract.overlays.{folder}.{module.name}")


def known_names() -> frozenset[str]:
    """Return the whole names of the classes and functions that are known."""
    _load()
    return frozenset(_OUTER)


def find_outer(ctx: Context, name: str) -> Word | None:
    """Return what calling a function or class by its whole name does."""
    _load()
    word = _OUTER.get(name)
    if word is None and name.endswith(LISTENER):
        word = _OUTER.get(LISTENER)
    return _said(ctx, word)


def is_method(name: str) -> bool:
    """Return whether there is a method of this name, of whatever kind of object."""
    _load()
    return name in _NAMES


def find_class(ctx: Context, name: str, path: str) -> tuple[str, Word] | None:
    """Return whole name and word of a class that is in the workspace, and known better than what its code says."""
    known = _BETTER.get(name)
    if known is None or (known[1] and not path.endswith(known[1])):
        return None
    word = find_outer(ctx, known[0])
    return None if word is None else (known[0], word)


def _said(ctx: Context, word: Word | None) -> Word | None:
    if word is not None and word not in _QUIET:
        ctx.summaries.touch()
    return word


def find_method(ctx: Context, receiver: Value, called: CallSite) -> Word | None:
    """Return what a method of an object does; None where it is not known."""
    _load()
    name = called.name
    for kind in kinds_of(ctx, receiver) if name in _NAMES else ():
        word = _METHODS.get((kind, name))
        if word is not None:
            return _said(ctx, word)
    match receiver:
        case None | Unknown() | Obj(defined=None):
            return _said(ctx, _ANYWHERE.get(name))
    return None


def guessed_method(ctx: Context, receiver: Value, called: CallSite) -> Word | None:
    """Return what a method does that an object may have of a base or a declaration outside of the workspace.

    None where nothing is known of it, or the object has no such base.
    """
    _load()
    word = _ANYWHERE.get(called.name)
    if word is None:
        return None
    match receiver:
        case Obj(defined=defined, node=None) if defined is not None and ctx.index.outer_bases(defined):
            return _said(ctx, word)
        case Named() if ctx.dialect.declared_apart:
            return _said(ctx, word)
    return None


def kinds_of(ctx: Context, receiver: Value) -> tuple[str, ...]:
    """Return what an object is, to find its methods."""
    match receiver:
        case Obj():
            defined = receiver.defined
            key = (receiver.type, 0 if defined is None else id(defined.what), receiver.node is not None)
            known = ctx.index.memo.kinds
            found = known.get(key)
            if found is None:
                kinds = [receiver.type, *(ctx.index.outer_bases(defined) if defined is not None else ())]
                if receiver.node is not None:
                    kinds.append("node")
                found = known[key] = (*kinds, *(kind.rpartition(".")[2] for kind in kinds))
            return found
        case Handle():
            return ("handle", "node")
        case QosValue():
            return ("qos",)
        case Text():
            return ("text",)
        case Made():
            return ("made",)
    return ()


def node_of(ctx: Context, value: Value) -> NodeBuilder:
    """Return the node that a value stands for: the one that is built where it is unknown."""
    match value:
        case Handle():
            return value.node
        case Obj():
            if value.node is not None:
                return value.node
            handle = first_of_kind(value.fields.values(), Handle)
            if handle is not None:
                return handle.node
    return ctx.emitter.node


def below(value: Value, name: Text) -> Text:
    """Return a name below what a handle puts in front of it."""
    match value:
        case Handle(prefix=prefix) if prefix.parts and name.head[:1] not in ("/", "~"):
            return Text.of(prefix, "/", name) if name.parts else prefix
    return name
