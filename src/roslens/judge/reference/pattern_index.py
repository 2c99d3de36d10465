"""An index of selectors: which of a thousand constraints are about an entity, without asking each of them."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Generic, TypeVar

from roslens.judge.patterns.pattern import Pattern
from roslens.judge.reference.expectation import Selector
from roslens.model.entity import EntityKind

T = TypeVar("T")


class CompiledSelector:
    """A selector with its patterns read.

    Raises:
        ValueError: one of its patterns is none.
    """

    __slots__ = ("_narrowed", "kind", "name", "without")

    def __init__(self, selector: Selector) -> None:
        self.kind = selector.kind
        self.name = Pattern.parse(selector.name)
        self.without = tuple(map(Pattern.parse, selector.without))
        others = (selector.host, selector.type, selector.publisher, selector.subscriber)
        self._narrowed = tuple((at, Pattern.parse(text)) for at, text in enumerate(others) if text)

    def matches(self, name: str, others: tuple[str, str, str, str]) -> bool:
        """Whether it selects an entity of its kind; ``others`` are host, type, publisher and subscriber."""
        return (
            self.name.matches(name)
            and all(pattern.matches(others[at]) for at, pattern in self._narrowed)
            and not any(pattern.matches(name) for pattern in self.without)
        )


class PatternIndex(Generic[T]):
    """Finds the items whose selectors match an entity.

    Names without wildcards lie in a dictionary, patterns by their first or last segment where that has none; only the
    others are asked one by one.

    Raises:
        ValueError: a pattern of a selector is none.
    """

    def __init__(self, items: Iterable[tuple[Selector, T]]) -> None:
        self._items: list[tuple[CompiledSelector, T]] = []
        self._buckets: dict[tuple[EntityKind, str, str], list[int]] = {}
        for selector, item in items:
            compiled = CompiledSelector(selector)
            key = (compiled.kind, *_bucket(compiled.name))
            self._buckets.setdefault(key, []).append(len(self._items))
            self._items.append((compiled, item))

    def find(
        self,
        kind: EntityKind,
        name: str,
        *,
        host: str = "",
        type: str = "",  # noqa: A002 - the field's word
        publisher: str = "",
        subscriber: str = "",
    ) -> tuple[T, ...]:
        """Return what is said about an entity, in the order given.

        Args:
            kind: of the entity.
            name: resolved; of a connection that of its topic.
            host: on which it is; empty where unknown, which only a pattern such as ``**`` matches.
            type: of its messages.
            publisher: node that publishes on it.
            subscriber: node that receives over it.
        """
        others = (host, type, publisher, subscriber)
        numbers = [
            number
            for place, text in (("name", name), ("first", _first(name)), ("last", _last(name)), ("any", ""))
            for number in self._buckets.get((kind, place, text), ())
            if self._items[number][0].matches(name, others)
        ]
        return tuple(self._items[number][1] for number in sorted(numbers))


def _bucket(pattern: Pattern) -> tuple[str, str]:
    """Return where a pattern lies: which part of a name is looked up there, and that part."""
    if pattern.literal is not None:
        return "name", pattern.literal
    if "/" in pattern.head[1:]:
        return "first", _first(pattern.head)
    if "/" in pattern.tail:
        return "last", _last(pattern.tail)
    return "any", ""


def _first(name: str) -> str:
    """Return ``/robot`` of ``/robot/arm/joint``."""
    end = name.find("/", 1)
    return name if end < 0 else name[:end]


def _last(name: str) -> str:
    """Return ``/joint`` of ``/robot/arm/joint``."""
    return name[name.rfind("/") :] if "/" in name else name
