"""What changed between two definitions of an interface, by what follows from it.

ROS 2 compares the layout of fields (RIHS01: names, types and order; no constants, no defaults), ROS 1 also constants
(MD5). Any of these makes another type on the wire; a constant that is gone stops code that names it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from roslens.model.interfaces.interface_change import Breaks, InterfaceChange
from roslens.source.extract.interfaces.interface import FieldType, Interface, InterfaceField, Message

_PARTS = {"msg": ("",), "srv": ("request", "response"), "action": ("goal", "result", "feedback")}
_WIRE, _SOURCE, _MEANING = Breaks.WIRE, Breaks.SOURCE, Breaks.MEANING
Placed = tuple[Interface, str]
"""An interface and the path of its file."""


def changes_of(before: Mapping[str, Placed], after: Mapping[str, Placed]) -> Iterator[InterfaceChange]:
    """Yield the differences of interfaces by their full names; what was not understood completely is left out."""
    renamed = _renamed(before, after)
    for name in sorted(before.keys() | after.keys()):
        old, new = before.get(name), after.get(name)
        if old is None and new is not None:
            if name not in renamed.values():
                yield InterfaceChange(name, "added", (), new[1])
        elif new is None and old is not None:
            what = f"renamed to {renamed[name]}" if name in renamed else "removed"
            yield InterfaceChange(name, what, (_WIRE, _SOURCE), old[1])
        elif old is not None and new is not None and old[0].complete and new[0].complete:
            yield from _between(name, old[0], new[0], new[1])


def _renamed(before: Mapping[str, Placed], after: Mapping[str, Placed]) -> dict[str, str]:
    """Return the later names, by the earlier ones, of interfaces that have the same fields and are named otherwise."""
    gone = [before[one][0] for one in sorted(before.keys() - after.keys())]
    come = [after[one][0] for one in sorted(after.keys() - before.keys())]
    found: dict[str, str] = {}
    for old in gone:
        fit = [new for new in come if new.package == old.package and new.kind == old.kind and _same(old, new)]
        if len(fit) == 1 and fit[0].full_name not in found.values() and any(part.fields for part in old.parts):
            found[old.full_name] = fit[0].full_name
    return found


def _same(old: Interface, new: Interface) -> bool:
    return [_layout(one) for one in old.parts] == [_layout(one) for one in new.parts]


def _layout(part: Message) -> list[tuple[str, FieldType]]:
    return [(one.name, _type(one)) for one in part.fields]


def _type(field: InterfaceField) -> FieldType:
    """Return the type without how it is written: ``Pose`` and ``geometry_msgs/Pose`` are the same."""
    of = field.type
    return FieldType(of.name, of.package, of.array, of.size, of.longest)


def _between(name: str, old: Interface, new: Interface, path: str) -> Iterator[InterfaceChange]:
    for part, earlier, later in zip(_PARTS[new.kind], old.parts, new.parts, strict=True):
        where = f"{part}: " if part else ""
        for what, breaks, line, gone in _of_part(earlier, later, new.generation):
            yield InterfaceChange(name, f"{where}{what}", breaks, path, line, gone)


_Difference = tuple[str, tuple[Breaks, ...], int, tuple[str, ...]]


def _of_part(old: Message, new: Message, generation: int) -> Iterator[_Difference]:
    yield from _of_fields(old.fields, new.fields)
    # In ROS 1 constants are part of the checksum.
    wire = (_WIRE,) if generation == 1 else ()
    before, after = ({one.name: one for one in side.constants} for side in (old, new))
    for name in before.keys() - after.keys():
        yield f"constant {name} removed", (*wire, _SOURCE), 0, ()
    for name, constant in after.items():
        if name not in before:
            yield f"constant {name} added", wire, constant.line, ()
            continue
        was = before[name]
        if was.type != constant.type:
            text = f"constant {name} is of type {constant.type}, was {was.type}"
            yield text, (*wire, _SOURCE), constant.line, ()
        elif was.value != constant.value:
            yield f"constant {name} is {constant.written}, was {was.written}", (*wire, _MEANING), constant.line, ()
        elif generation == 1 and was.written != constant.written:
            yield f"constant {name} is written {constant.written}, was {was.written}", wire, constant.line, ()


def _of_fields(old: Sequence[InterfaceField], new: Sequence[InterfaceField]) -> Iterator[_Difference]:
    before, after = ({one.name: one for one in side} for side in (old, new))
    renamed = _renamed_fields(old, new)
    for field in old:
        if field.name in renamed:
            other = after[renamed[field.name]]
            text = f"field {field.name} renamed to {other.name}"
            yield text, (_WIRE, _SOURCE), other.line, (field.name,)
        elif field.name not in after:
            yield f"field {field.name} removed", (_WIRE, _SOURCE), 0, (field.name,)
    for field in new:
        if field.name in renamed.values():
            continue
        was = before.get(field.name)
        if was is None:
            yield f"field {field.name} added", (_WIRE,), field.line, ()
        elif _type(was) != _type(field):
            text = f"field {field.name} is of type {field.type.written}, was {was.type.written}"
            yield text, (_WIRE, _SOURCE), field.line, ()
        elif was.default != field.default:
            text = f"default of field {field.name} is {_value(field)}, was {_value(was)}"
            yield text, (_MEANING,), field.line, ()
    common = [one.name for one in old if one.name in after]
    order = [one.name for one in new if one.name in before]
    if common != order:
        first = next(later for earlier, later in zip(common, order, strict=True) if earlier != later)
        yield f"fields reordered: {', '.join(order)}", (_WIRE,), after[first].line, ()


def _value(field: InterfaceField) -> str:
    return "none" if field.default is None else repr(field.default)


def _renamed_fields(old: Sequence[InterfaceField], new: Sequence[InterfaceField]) -> dict[str, str]:
    """Return the later names, by the earlier ones, of fields that stand at the same place with the same type."""
    if len(old) != len(new):
        return {}
    before, after = ({one.name for one in side} for side in (old, new))
    return {
        was.name: now.name
        for was, now in zip(old, new, strict=True)
        if was.name not in after and now.name not in before and _type(was) == _type(now)
    }
