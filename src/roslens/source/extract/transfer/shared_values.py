"""Values that have several names, of Python or by reference: what changes one of them changes it for all."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.source.extract.domain.abstract_value import Obj, QosValue, Value
from roslens.source.extract.ir.program import Member, Name
from roslens.source.extract.symbols.declared_field import declared_field

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context


def changed_for_all(engine: Context, holder: Name | Member, before: Value, after: QosValue) -> None:
    """Let a quality of service be what it was changed to under its other names too."""
    shared = engine.dialect.names_share_objects
    if isinstance(before, QosValue) and before is not after and (shared or _is_reference(engine, holder)):
        engine.summaries.forget_all()
        engine.state.changes.refine(before, after)
        if shared:
            _in_constants(engine, before, after)
            changed_by_call(engine)


def newest(engine: Context, value: Value) -> Value:
    """Return what an object became of which another name is known too: a name of Python, or a reference."""
    while isinstance(value, QosValue) and id(value) in engine.state.changes.refined:
        value = engine.state.changes.refined[id(value)][1]
    return value


def changed_by_call(engine: Context) -> None:
    """In Python names are given to an object: under each of them it is changed, by whoever changes it."""
    if not engine.dialect.names_share_objects:
        return
    thing = engine.state.frame.self
    for held in (engine.state.frame.names, thing.fields if isinstance(thing, Obj) else {}):
        for name, value in held.items():
            if isinstance(value, QosValue) and id(value) in engine.state.changes.refined:
                engine.state.changes.put(held, name, newest(engine, value))


def _in_constants(engine: Context, before: QosValue, after: QosValue) -> None:
    """What a module or class holds is changed for all that use it; under a condition it may be."""
    for place, value in engine.state.constants.items():
        if value is before:
            why = f"it may be changed, if {engine.state.conditions[-1]}" if engine.state.conditions else ""
            engine.state.constants[place] = QosValue(after.qos, after.unknown or why) if why else after


def _is_reference(engine: Context, holder: Name | Member) -> bool:
    """Whether what is changed is a member that refers to something outside of its object."""
    thing = engine.state.frame.self
    if not isinstance(thing, Obj) or holder.name in engine.state.frame.names:
        return False
    return declared_field(engine.index, thing.defined, holder.name).endswith("&")
