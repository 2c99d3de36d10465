"""The ``ParamListener`` that generate_parameter_library makes: it declares the parameters of a file, and reads them.

They are declared where the listener is made; what says so is the file. What its structure of parameters holds are texts
that the parameters decide, so that names made of them are followed.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

import msgspec

from roslens.source.extract.domain.abstract_value import Obj, Unknown, Value, as_text
from roslens.source.extract.domain.kinds import fields_of, object_of
from roslens.source.extract.domain.unknown_lists import each_of
from roslens.source.extract.facts.node_facts import Sure
from roslens.source.extract.interpreter.vocabulary import LISTENER, CallSite, method, node_of, outer, written_as
from roslens.source.extract.overlays.ros.emit import Described, parameter
from roslens.source.extract.parameters.parameter_library import MAP, Declaration, ParameterLibrary
from roslens.source.extract.symbolic.text import Text

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context

_PARAMS, _ENTRIES = "ParameterStruct", "ParameterEntries"


@outer(LISTENER)
def listener(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A listener is made: it declares the parameters of its file, below a prefix where one is given."""
    made = Obj(called.name, None, {})
    if not called.arguments:
        # A member or variable that is made later.
        return made
    found = _library(ctx, called)
    if found is None or found.unread:
        why = found.unread if found is not None else f"no build of the workspace generates {called.name}"
        node = node_of(ctx, called.argument(0))
        node.unresolved.append((called.evidence, f"the parameters of {called.name} are unknown: {why}"))
        return made
    made.fields["params"] = _Declaring(ctx, called, found).structure()
    return made


@method(LISTENER, "get_params", "get_stack_params")
def params(_ctx: Context, thing: Value, _called: CallSite) -> Value:
    """All parameters are read."""
    known = fields_of(thing).get("params")
    return known if known is not None else Unknown("parameters of a listener")


@method(LISTENER, "try_get_params", "try_update_params", "try_get_stack_params")
def params_into(ctx: Context, thing: Value, called: CallSite) -> Value:
    """All parameters are read into a variable."""
    known = fields_of(thing).get("params")
    if known is not None and called.written:
        ctx.assign(called.written[0], known)
    return Unknown("whether parameters changed")


@method(_ENTRIES, "at", "get_entry")
def entry(_ctx: Context, thing: Value, _called: CallSite) -> Value:
    """One of the entries of a map, which stands for each."""
    match thing:
        case Obj():
            return thing.fields["entry"]
    return Unknown("an entry")


class _Declaring:
    """Declares the parameters of a library for one listener."""

    def __init__(self, ctx: Context, called: CallSite, library: ParameterLibrary) -> None:
        self._ctx, self._called, self._library = ctx, called, library
        self._prefix = _prefix(ctx, called)
        self._known: dict[str, Text] = {}

    def structure(self) -> Obj:
        """Return what holds the values, as the generated structure does."""
        whole = Obj(_PARAMS, None, {})
        # What names the items of a map may stand behind it.
        for one in sorted(self._library.declarations, key=lambda one: MAP in one.name):
            value = self._declared(one)
            at, (*path, last) = whole, one.name.split(".")
            for piece in path:
                at = _inside(at, piece)
            at.fields[last] = value
        return whole

    def _declared(self, one: Declaration) -> Value:
        pieces = one.name.split(".")
        parts: list[str | Text] = []
        for place, piece in enumerate(pieces):
            parts.append("." if place else "")
            known = self._keys(piece.removeprefix(MAP), pieces[:place]) if piece.startswith(MAP) else None
            parts.append(piece if known is None else as_text(each_of(known)))
        name = Text.of(self._prefix, *parts)
        called = self._called
        at = f"{called.evidence.path}:{called.evidence.line}"
        sure = Sure.LIKELY if name.holes else Sure.CERTAIN
        evidence = msgspec.structs.replace(one.evidence, how=f"declared by the {LISTENER} created at {at}", sure=sure)
        value = parameter(
            self._ctx, called.argument(0), called, "declared", name,
            default=None if one.default is None else Text.of(one.default), given=one.default is not None,
            kind=one.type, described=Described(one.range, one.description, one.terms), evidence=evidence,
        )  # fmt: skip
        self._known[one.name] = as_text(value)
        return value

    def _keys(self, name: str, around: Iterable[str]) -> Text:
        """Return the list that names the items of a map: in the nearest structure around it that has it."""
        pieces = list(around)
        while pieces:
            known = self._known.get(".".join((*pieces, name)))
            if known is not None:
                return known
            pieces.pop()
        return self._known.get(name) or as_text(Unknown(f"the items of {name}"))


def _inside(at: Obj, piece: str) -> Obj:
    """Return a part of a structure, made where it is not there; the entries of a map are one for all."""
    if not piece.startswith(MAP):
        return _object_at(at, piece, _PARAMS)
    found = _object_at(_object_at(at, f"{piece.removeprefix(MAP)}_map", _ENTRIES), "entry", _PARAMS)
    at.fields["get_entry"] = Unknown("an entry")
    return found


def _object_at(at: Obj, name: str, kind: str) -> Obj:
    """Return the object that a member is, made where there is no member of that name."""
    made = Obj(kind, None, {})
    return object_of(at.fields.setdefault(name, made)) or made


def _prefix(ctx: Context, called: CallSite) -> Text:
    """Return what is put before the names: the last argument, where it is no logger."""
    given = called.keywords.get("prefix", called.arguments[-1] if len(called.arguments) > 1 else None)
    if given is None or (len(called.arguments) == 2 and _is_logger(ctx, given, called)):
        return Text()
    prefix = as_text(given)
    return Text.of(prefix, ".") if prefix.parts and not prefix.tail.endswith(".") else prefix


def _is_logger(ctx: Context, value: Value, called: CallSite) -> bool:
    """Return whether a value is a logger: an object of such a class, or what source names so."""
    match value:
        case Obj():
            return "logger" in value.type.lower()
        case Unknown():
            return "logger" in written_as(ctx, called, -1).lower()
    return False


def _library(ctx: Context, called: CallSite) -> ParameterLibrary | None:
    """Return what the class of a listener is made of: by its namespace; of several of one package or included."""
    frame, index = ctx.state.frame, ctx.index
    python = called.evidence.path.endswith(".py")
    known = [one for one in index.parameter_libraries if one.python is python]
    names = [called.name] if python else [called.name, *index.named(called.name, frame.path, frame.scope)]
    for name in names:
        space = name.rpartition(".")[0]
        found = [
            one
            for one in known
            if (space.endswith(f"{one.target}.{one.namespace}") if python else space == one.namespace)
        ]
        if found:
            return _nearest(found, ctx, frame.path)
    unread = [one for one in known if one.unread and one.package == index.package(frame.path)]
    return unread[0] if len(unread) == 1 else None


def _nearest(found: list[ParameterLibrary], ctx: Context, path: str) -> ParameterLibrary | None:
    """Return the one of several of a namespace whose header is included, or that the package makes."""
    if len(found) == 1:
        return found[0]
    package = ctx.index.package(path)
    heads = _included(ctx, path)
    for some in ([one for one in found if one.package == package], found):
        included = [one for one in some if f"{one.target}.hpp" in heads]
        if len(included) == 1 or len(some) == 1:
            return (included or some)[0]
    return None


def _included(ctx: Context, path: str) -> set[str]:
    """Return the headers that a file includes, and those of the workspace that it includes, without their folders."""
    programs = ctx.index.programs
    own = {name.strip('<>"') for name, _ in programs[path].includes}
    ends = tuple(f"/{name}" for name in own)
    near = [path, *(other for other in programs if other.endswith(ends))]
    return {name.strip('<>"').rpartition("/")[2] for other in near for name, _ in programs[other].includes}
