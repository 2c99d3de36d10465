"""Configurations as JSON: ``docs/reference/graph.schema.json`` says what it looks like."""

from __future__ import annotations

from typing import Any

import msgspec

from roslens.model.configuration import Configuration
from roslens.model.errors import DocumentError
from roslens.model.graphs.completeness import Completeness, completeness_of
from roslens.report.writing.document_schema import document_schema

SCHEMA = "roslens-graph/1"


class GraphDocument(msgspec.Struct, frozen=True):
    """What ``roslens graph --format json`` writes; within version 1 keys are only added.

    Attributes:
        schema: name and version of this form.
        configurations: what would run together.
        completeness: how much of each of these is known, in their order.
    """

    schema: str
    configurations: tuple[Configuration, ...]
    completeness: tuple[Completeness, ...] = ()


def to_graph_json(configurations: tuple[Configuration, ...]) -> str:
    """Return configurations as a JSON document."""
    encoded = msgspec.json.encode(GraphDocument(SCHEMA, configurations, tuple(map(completeness_of, configurations))))
    return msgspec.json.format(encoded, indent=1).decode() + "\n"


def read_graph_json(content: bytes, shown: str) -> tuple[Configuration, ...]:
    """Read a document back.

    Raises:
        DocumentError: it is none.
    """
    try:
        document = msgspec.json.decode(content, type=GraphDocument)
    except msgspec.DecodeError as error:
        raise DocumentError(str(error), where=shown, expected="a file of `roslens graph --format json`") from error
    if document.schema != SCHEMA:
        raise DocumentError(f'"schema": "{document.schema}"', where=shown, expected=f'"{SCHEMA}"')
    return document.configurations


def graph_schema() -> dict[str, Any]:
    """Return the JSON Schema of the document."""
    return document_schema(GraphDocument, SCHEMA)
