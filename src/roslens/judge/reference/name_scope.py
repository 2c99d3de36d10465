"""Namespaces: what a relative name or pattern of a document means."""

from __future__ import annotations

import re

from roslens.judge.patterns.pattern import REGULAR_EXPRESSION, Pattern


def join(outer: str, inner: str) -> str:
    """Return the namespace of a document: ``inner`` below ``outer``, or alone where it begins with ``/``."""
    if not inner.startswith("/"):
        inner = f"{outer}/{inner}" if inner else outer
    return inner.rstrip("/")


def put_under(namespace: str, pattern: str) -> str:
    """Return what ``pattern`` means in ``namespace``.

    A pattern that begins with ``/`` stays as it is. Without a namespace ``**`` and regular expressions are about all
    names; in one they are about what is below it.

    Args:
        namespace: resolved, without a slash at its end; empty for none.
        pattern: as written.

    Raises:
        ValueError: a regular expression in a namespace that has wildcards.
    """
    if pattern.startswith(REGULAR_EXPRESSION):
        return _expression_under(namespace, pattern)
    if pattern.lstrip("{").startswith("/"):
        return pattern
    if not namespace:
        return pattern if pattern.startswith("**") else f"/{pattern}"
    if pattern.startswith("**/"):
        return f"{namespace}/{{,**/}}{pattern[3:]}"
    return f"{namespace}/{pattern}"


def _expression_under(namespace: str, pattern: str) -> str:
    expression = pattern.removeprefix(REGULAR_EXPRESSION)
    if not namespace or expression.lstrip("^(?:").startswith("/"):
        return pattern
    literal = Pattern.parse(namespace).literal
    if literal is None:
        raise ValueError(f"{pattern!r} in the namespace {namespace!r}, which has wildcards; begin it with `/`")
    return f"{REGULAR_EXPRESSION}{re.escape(literal)}/(?:{expression})"
