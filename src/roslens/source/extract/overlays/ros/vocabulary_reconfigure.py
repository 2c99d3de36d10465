"""The vocabulary of dynamic_reconfigure: a server that declares parameters, and lets them be changed while it runs."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import msgspec

from roslens.model.graph import Role
from roslens.source.extract.domain.abstract_value import Class, Handle, Named, Obj, Value, as_text
from roslens.source.extract.domain.kinds import all_of_kind
from roslens.source.extract.facts.node_facts import Evidence, ParameterFact, Sure
from roslens.source.extract.interpreter.vocabulary import CallSite, below, method, node_of, outer
from roslens.source.extract.overlays.ros.emit import endpoint, origin
from roslens.source.extract.symbolic.text import Conditions, Text, unknown
from roslens.source.extract.symbols.symbol_table import dotted

if TYPE_CHECKING:
    from roslens.source.extract.overlays.ros.reconfigure_file import Declaration, ReconfigureFile
    from roslens.source.extract.transfer.context import Context

_PYTHON = "dynamic_reconfigure.server.Server"
_ENDS = (
    ("parameter_descriptions", "dynamic_reconfigure::ConfigDescription", Role.PUBLISHER),
    ("parameter_updates", "dynamic_reconfigure::Config", Role.PUBLISHER),
    ("set_parameters", "dynamic_reconfigure::Reconfigure", Role.SERVICE_SERVER),
)
_CLASS_END = "Config"


@outer("dynamic_reconfigure.Server", _PYTHON)
def reconfigure(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A server that lets parameters of a node be changed while it runs."""
    python = called.evidence.path.endswith(".py") and not called.templates
    kind: Value = called.argument(0, "type") if python else called.templates[0] if called.templates else ""
    handle = _space(ctx, called) if python else _handle(ctx, called)
    for name, message, role in _ENDS:
        endpoint(ctx, handle, called, role, Text.of(name), message, latched=role is Role.PUBLISHER)
    _declare(ctx, handle, called, _written(ctx, kind))
    if python:
        ctx.callbacks.give(called.argument(1, "callback"))
    return Obj("dynamic_reconfigure.Server")


@method("dynamic_reconfigure.Server", "setCallback")
def reconfigured(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """What is called when parameters are changed."""
    ctx.callbacks.give(called.argument(0))
    return None


def _handle(ctx: Context, called: CallSite) -> Handle:
    """Return the namespace of a server in C++, ``~`` where none is given."""
    given = all_of_kind(called.arguments, Handle)
    return given[0] if given else Handle(ctx.emitter.node, Text.of("~"))


def _space(ctx: Context, called: CallSite) -> Handle:
    """Return the namespace of a server in Python: private where it does not begin with ``/`` or ``~`` (server.py)."""
    ctx.emitter.node.generation = "ros1"
    given = called.argument(2, "namespace")
    match given:
        case None | Text(parts=()):
            return Handle(ctx.emitter.node, Text.of("~"))
    name = as_text(given)
    if name.head[:1] not in ("/", "~"):
        name = Text.of("~", name)
    return Handle(ctx.emitter.node, _without_end(name))


def _without_end(name: Text) -> Text:
    return Text.of(*name.parts[:-1], name.tail.rstrip("/") or "/") if name.tail else name


def _written(ctx: Context, kind: Value) -> str:
    """Return the class that a server is of, without aliases; in Python it is a module."""
    match kind:
        case str():
            name = dotted(ctx.state.frame.templates.get(kind, kind))
            return ctx.index.meaning(name, ctx.state.frame.path, ctx.state.frame.scope)
        case Named() | Class():
            return kind.name
    return ""


def _declare(ctx: Context, handle: Handle, called: CallSite, kind: str) -> None:
    """Record the parameters that the ``.cfg`` file of a class declares; without it, that they are unknown."""
    node = node_of(ctx, handle)
    conditions = tuple(dict.fromkeys(ctx.state.conditions))
    file, sure = _file_of(ctx, kind)
    place, _ = origin(ctx, called, None)
    known = file is not None and file.whole
    for one in file.declarations if file is not None else ():
        fact = _fact(one, below(handle, one.name), place, conditions, sure)
        if fact not in node.parameters:
            node.parameters.append(fact)
    if not known:
        why = f"not all of {file.path} was understood" if file else f"no .cfg file of {kind or 'its class'} was found"
        name = below(handle, unknown(f"a parameter of the server of dynamic_reconfigure: {why}"))
        evidence = msgspec.structs.replace(place, how=why, sure=Sure.POSSIBLE)
        fact = ParameterFact(name, evidence, "declared", conditions=conditions)
        if fact not in node.parameters:
            node.parameters.append(fact)


def _fact(one: Declaration, name: Text, place: Evidence, conditions: Conditions, sure: Sure) -> ParameterFact:
    how = f"written by the server of dynamic_reconfigure at {place.path}:{place.line}"
    evidence = msgspec.structs.replace(one.evidence, how=how, sure=sure)
    writer = msgspec.structs.replace(place, how="default, which the callback may change", sure=Sure.LIKELY)
    return ParameterFact(
        name, evidence, "declared", one.type, one.default, one.range,
        tuple(dict.fromkeys((*conditions, *one.conditions))), one.description, writer=writer,
    )  # fmt: skip


def _file_of(ctx: Context, kind: str) -> tuple[ReconfigureFile | None, Sure]:
    """Return what declares the parameters of a class, and how sure that is: by its package, or what is around it."""
    from roslens.source.extract.overlays.ros.reconfigure_file import reconfigure_files

    pieces = [piece for piece in kind.split(".") if piece]
    if not pieces or not pieces[-1].endswith(_CLASS_END):
        return None, Sure.CERTAIN
    found = reconfigure_files(ctx.index, pieces[-1].removesuffix(_CLASS_END))
    if not found:
        return None, Sure.CERTAIN
    outer_pieces = [piece for piece in pieces[:-1] if piece != "cfg"]
    for package in outer_pieces[-1:] or _around(ctx, pieces[-1]):
        named = [one for one in found if one.package == package]
        if named:
            return named[0], Sure.CERTAIN
    if outer_pieces:
        return None, Sure.CERTAIN
    return (found[0], Sure.LIKELY) if len(found) == 1 else (None, Sure.CERTAIN)


def _around(ctx: Context, name: str) -> Iterator[str]:
    """Yield the packages that a class without a namespace may be of: what is around it, used whole, or included."""
    program = ctx.index.programs[ctx.state.frame.path]
    scope = ctx.state.frame.scope
    while scope := scope.rpartition(".")[0]:
        yield scope
    yield from program.using
    for header, _line in program.includes:
        package, _, last = header.strip('<>"').rpartition("/")
        if last == f"{name}.h":
            yield package
