"""What sides of a comparison say differently, as JSON: ``docs/reference/conformance.schema.json`` says its form."""

from __future__ import annotations

from typing import Any

import msgspec

from roslens.compare.conformance.disparity import Conformance, Disparity
from roslens.report.writing.document_schema import document_schema

SCHEMA = "roslens-conformance/1"


class ConformanceDocument(msgspec.Struct, frozen=True):
    """What ``roslens compare A B --format json`` writes of sides; within version 1 keys are only added.

    Attributes:
        schema: and its version.
        titles: of the sides.
        kinds: of the sides: ``source``, ``running``, ``recording``, ``reference``.
        agreed: how many nodes, endpoints, parameters and topics at least two sides have in common.
        disparities: the gravest first; ``values`` is what each side reports, in the order of the sides.
        notes: what readers have to know of the comparison.
    """

    schema: str
    titles: tuple[str, ...]
    kinds: tuple[str, ...]
    agreed: dict[str, int]
    disparities: tuple[Disparity, ...]
    notes: tuple[str, ...] = ()


def to_conformance_json(found: Conformance) -> str:
    """Return a comparison as a JSON document."""
    document = ConformanceDocument(SCHEMA, found.titles, found.kinds, found.agreed, found.disparities, found.notes)
    return msgspec.json.format(msgspec.json.encode(document), indent=1).decode() + "\n"


def conformance_schema() -> dict[str, Any]:
    """Return the JSON Schema of the document."""
    return document_schema(ConformanceDocument, SCHEMA)
