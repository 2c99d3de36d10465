"""References that stand in parameters, where launch files put them, as documents to be read like files.

A value may be

- a text: a document in YAML;
- a list of texts: several documents;
- a table with the keys of a document, as a launch file loads it from YAML: that document;
- a list of tables with the keys of a constraint: one document that has these constraints;
- a table of any of these: several documents.

A table that has no ``name`` is called after the parameter.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Any

from roslens.judge.reading.read_reference import GivenText
from roslens.judge.reference.reference_keys import DOCUMENT_KIND, REFERENCE_KEYS
from roslens.model.errors import DocumentError

_DEEPEST = 8
_SAYS = ("constraints", "fields", "chains", "include", "kind")
"""Keys that make a table a document."""
_NOT_IN_NAMES = re.compile(r"[^a-z0-9_-]+")


def parameter_documents(name: str, value: Any, where: str) -> tuple[GivenText, ...]:
    """Return the documents that stand in a parameter.

    Args:
        name: of the parameter.
        value: of it.
        where: what holds it, for messages (``the parameter server at http://robot:11311``).

    Raises:
        DocumentError: the value is of no form that a document has.
    """
    found = tuple(_documents(name, value, where, 0))
    if not found:
        raise _wrong(name, value, where)
    return found


def _documents(name: str, value: Any, where: str, depth: int) -> Iterator[GivenText]:
    if depth > _DEEPEST:
        raise _wrong(name, value, where)
    if isinstance(value, str) and value.strip():
        yield GivenText(_shown(name, where), value.encode())
        return
    document = _document_in(value)
    if document is not None:
        yield _written(name, document, where)
        return
    parts = _parts(name, value)
    if not parts:
        raise _wrong(name, value, where)
    for part_name, part in parts:
        yield from _documents(part_name, part, where, depth + 1)


def _document_in(value: Any) -> Mapping[str, Any] | None:
    """Return the document that a value is by itself, if it is one."""
    if isinstance(value, Mapping) and any(key in value for key in _SAYS):
        return value
    if isinstance(value, list) and value and all(_is_constraint(one) for one in value):
        return {"constraints": value}
    return None


def _parts(name: str, value: Any) -> list[tuple[str, Any]]:
    """Return what a value is made of, each part with its name; nothing of one that has no parts."""
    if isinstance(value, Mapping):
        return [(f"{name.rstrip('/')}/{key}", value[key]) for key in sorted(value, key=str)]
    if isinstance(value, list):
        return [(f"{name}[{number}]", one) for number, one in enumerate(value)]
    return []


def _is_constraint(value: Any) -> bool:
    return isinstance(value, Mapping) and bool(value) and not any(key in REFERENCE_KEYS for key in value)


def _written(name: str, table: Mapping[str, Any], where: str) -> GivenText:
    import yaml

    last = re.sub(r"\[(\d+)\]\Z", r"-\1", name.rstrip("/").rpartition("/")[2].lower())
    called = _NOT_IN_NAMES.sub("-", last).lstrip("-0123456789_")[:60]
    document = {"kind": DOCUMENT_KIND, "name": called or "parameter", **table}
    text = yaml.safe_dump(document, sort_keys=False, allow_unicode=True, width=1000)
    return GivenText(_shown(name, where), text.encode())


def _shown(name: str, where: str) -> str:
    return f"parameter {name} of {where}"


def _wrong(name: str, value: Any, where: str) -> DocumentError:
    found = "an empty value" if value in ("", None) or value == [] or value == {} else repr(value)[:60]
    return DocumentError(
        f"the parameter holds {found}", where=_shown(name, where),
        expected=f"a {DOCUMENT_KIND} in YAML, a list of them, or a list of constraints",
        advice='Load it with <rosparam file="…"/> (ROS 1), or pass the text of the file as a parameter (ROS 2)',
    )  # fmt: skip
