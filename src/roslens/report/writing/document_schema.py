"""The JSON Schema of a document, made from the type that is written; the same from every Python."""

from __future__ import annotations

from inspect import cleandoc
from typing import Any

import msgspec


def document_schema(document: type[msgspec.Struct], title: str) -> dict[str, Any]:
    """Return the JSON Schema of a document.

    Args:
        document: what is encoded.
        title: name and version of its form.
    """
    schema = msgspec.json.schema(document)
    for part in schema["$defs"].values():
        # Python 3.13 takes the indentation of docstrings away, earlier ones keep it.
        if "description" in part:
            part["description"] = cleandoc(part["description"])
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", "title": title, **schema}
