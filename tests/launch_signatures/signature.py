"""What the constructor of a class takes: positional parameters, keywords with the inherited ones, what is required."""

from __future__ import annotations

import ast

import msgspec

from launch_signatures.library import Module, bases, definition

KINDS = (
    ("launch.substitution.Substitution", "substitution"),
    ("launch.action.Action", "action"),
    ("launch.condition.Condition", "condition"),
    ("launch.event_handler.BaseEventHandler", "event handler"),
    ("launch.event_handler.EventHandler", "event handler"),
    ("launch.event.Event", "event"),
    ("launch.launch_description_source.LaunchDescriptionSource", "source"),
    ("launch.launch_description_entity.LaunchDescriptionEntity", "entity"),
)
"""What classes are for, by the class that they are derived from."""


class Signature(msgspec.Struct):
    """What a class takes; an open one takes keywords that nobody can list."""

    positional: list[str] = []
    keywords: list[str] = []
    required: list[str] = []
    is_open: bool = False
    kind: str = ""


def signature(modules: dict[str, Module], full: str, depth: int = 0) -> Signature | None:
    """Return what the class of a full name takes; None where that is no class of the libraries."""
    found = definition(modules, full)
    if found is None or depth > 8:
        return None
    module, node = found
    above = [signature(modules, base, depth + 1) for base in bases(modules, module, node)]
    base = next((one for one in above if one is not None), None)
    own_kind = next((kind for name, kind in KINDS if name == f"{module.name}.{node.name}"), "")
    kind = own_kind or next((one.kind for one in above if one is not None and one.kind), "")
    constructor = next((one for one in node.body if isinstance(one, ast.FunctionDef) and one.name == "__init__"), None)
    if constructor is None:
        inherited = base or Signature()
        is_foreign = base is None and bool(node.bases)
        return msgspec.structs.replace(inherited, kind=kind, is_open=inherited.is_open or is_foreign)
    return _of(constructor, base, kind)


def _of(constructor: ast.FunctionDef, base: Signature | None, kind: str) -> Signature:
    given = constructor.args
    places = [one.arg for one in (*given.posonlyargs, *given.args)][1:]
    required = places[: len(places) - len(given.defaults)]
    for one, default in zip(given.kwonlyargs, given.kw_defaults, strict=True):
        required += [one.arg] if default is None else []
    keywords = [*places, *(one.arg for one in given.kwonlyargs)]
    found = Signature(places, keywords, required, kind=kind)
    if given.vararg is not None:
        found.positional.append("*")
    if given.kwarg is None:
        return found
    passed, taken, goes_on = _passed(constructor, given.kwarg.arg)
    if not goes_on or base is None:
        found.is_open = goes_on and base is None
        return found
    inherited = [one for one in base.keywords if one not in passed and one not in base.positional[:taken]]
    found.keywords += [one for one in inherited if one not in keywords]
    found.required += [one for one in base.required if one in inherited and one not in found.required]
    found.is_open = base.is_open
    return found


def _passed(constructor: ast.FunctionDef, name: str) -> tuple[set[str], int, bool]:
    """Return the keywords and the number of arguments that go to the base class, and whether the others do."""
    passed: set[str] = set()
    taken, goes_on = 0, False
    for one in ast.walk(constructor):
        if isinstance(one, ast.Subscript) and isinstance(one.ctx, ast.Store) and ast.unparse(one.value) == name:
            passed.add(str(getattr(one.slice, "value", "")))
        if not (isinstance(one, ast.Call) and ast.unparse(one.func).endswith(".__init__")):
            continue
        passed |= {keyword.arg for keyword in one.keywords if keyword.arg}
        goes_on = goes_on or any(k.arg is None and ast.unparse(k.value) == name for k in one.keywords)
        taken = max(taken, len(one.args))
    return passed, taken, goes_on
