"""Names of what modules and classes have, as they are written: ``package.module.NAME``."""

from __future__ import annotations

from roslens.source.extract.ir.program import Expression, Member, Name


def dotted_name(expression: Expression) -> str:
    """Return names joined by dots as they are written; empty where something else is among them."""
    match expression:
        case Name():
            return expression.name
        case Member() if before := dotted_name(expression.of):
            return f"{before}.{expression.name}"
    return ""
