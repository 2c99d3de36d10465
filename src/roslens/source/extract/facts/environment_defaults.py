"""Names that depend on the environment of the machine: with their defaults they are likely, never certain."""

from __future__ import annotations

from roslens.source.extract.facts.resolve_name import Place, Rule, tidy
from roslens.source.extract.symbolic.reason import OfEnvironment
from roslens.source.extract.symbolic.text import Hole, Text


def supposed(text: Text) -> tuple[Text, tuple[str, ...]]:
    """Return a text with defaults of the environment in place of holes, and in words which they are.

    A default that would make another kind of name, a global one within another, stays a hole.
    """
    if not any(_has_default(hole) for hole in text.holes):
        return text, ()
    parts: list[str | Hole] = []
    words: list[str] = []
    for part in text.parts:
        match part:
            case Hole(default=str(default)) if _has_default(part) and (
                not default.startswith("/") or parts in ([], ["/"])
            ):
                parts.append(default)
                words.append(f"default of {part.reason}")
            case _:
                parts.append(part)
    return Text.of(*parts), tuple(dict.fromkeys(words))


def with_defaults(text: Text) -> str:
    """Return a text in words, with what stands there where a variable of the environment is not set."""
    return str(text.with_holes(lambda hole: _or_default(hole) if _has_default(hole) else hole))


def _or_default(hole: Hole) -> str:
    return f"{{{hole.reason}, {hole.default!r} where that is not set}}"


def supposed_name(name: Text) -> Text:
    """Return a resolved name with defaults of the environment."""
    return tidy(supposed(name)[0]) if name.holes else name


def supposed_place(place: Place) -> Place:
    """Return where a node is with defaults of the environment."""
    namespace, of_namespace = supposed(place.namespace)
    # A node without a name is none: the default of its name is not its name.
    nameless = bool(place.node.parts) and not place.node.tail and not place.node.holes[-1].default
    node, of_node = (place.node, ()) if nameless else supposed(place.node)
    words = tuple(dict.fromkeys((*of_namespace, *of_node)))
    return Place(tidy(namespace), tidy(node), place.generation, words) if words else place


def supposed_rule(rule: Rule) -> tuple[Rule, tuple[str, ...], tuple[str, ...]]:
    """Return a remapping with defaults of the environment, and which they are: of its source, and of its target."""
    source, of_source = supposed(rule.source)
    target, of_target = supposed(rule.target)
    return Rule(source, target, rule.evidence, rule.node), of_source, of_target


def _has_default(hole: Hole) -> bool:
    return hole.default is not None and not hole.parameter and isinstance(hole.reason, OfEnvironment)
