"""Mistakes of a manifest as hits of the rule on their kind."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView

if TYPE_CHECKING:
    from roslens.source.workspace.mistakes import Mistake


def mistaken(view: PackageView, rule: str, kind: str) -> Iterator[Hit]:
    """Yield each mistake of a kind of :mod:`~roslens.source.workspace.validity`."""
    for one in view.mistakes:
        if one.kind == kind:
            yield hit_of(rule, one)


def hit_of(rule: str, one: Mistake) -> Hit:
    """Return a mistake as what a rule found."""
    message = f"{one.what}; expected {one.expected}. {one.advice}".rstrip(".")
    return Hit(rule, message, one.location.line, one.location.column, context=one.what, path=one.location.path)
