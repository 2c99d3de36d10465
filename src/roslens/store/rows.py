"""Between model values and rows of tables: writing and reading side by side, so that they cannot drift apart."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from enum import Enum
from typing import Any

import msgspec

from roslens.model.edit import Edit
from roslens.model.entity import Entity, EntityKind
from roslens.model.failure import Failure
from roslens.model.finding import Finding, Severity
from roslens.model.graphs.graph_scope import GraphScope
from roslens.model.repository import FoundRepository
from roslens.model.result import PackageSummary, RunHeader
from roslens.model.set_aside import Disposition, SetAside
from roslens.model.source import Language, Location, Package, Role, SourceFile
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.store.encodable import storable_number

Row = tuple[Any, ...]

FILE = "path, language, role, size, content_hash"
ENTITY = "id, kind, name, path, line, end_line, parent, approximate"
FINDING = (
    'rule, severity, message, path, line, "column", end_line, end_column, entity, tag_set, tool, fingerprint, '
    "quantity, value, bound, model, gated, witnesses, others, edits, consequence, certainty"
)
TAGS = FINDING.split(", ").index("tag_set") + 1
"""Place of the set of tags in a row of ``position, FINDING``."""
SET_ASIDE = "path, state, reason, said_by, package, finding"
FAILURE = "tool, what, expected, advice, location, entity, package, partial, detail"
RUN = 'key, root, paths, started, seconds, "commit", tools, configuration, models, repositories, graphs'

_encode = msgspec.json.Encoder().encode
_decode = msgspec.json.decode
_decode_summary = msgspec.json.Decoder(PackageSummary).decode
_decode_package = msgspec.json.Decoder(Package).decode
_decode_finding = msgspec.json.Decoder(Finding).decode
_decode_location = msgspec.json.Decoder(Location).decode
_decode_repositories = msgspec.json.Decoder(tuple[FoundRepository, ...]).decode
_decode_graphs = msgspec.json.Decoder(GraphScope | None).decode
_decode_edits = msgspec.json.Decoder(tuple[Edit, ...]).decode
_decode_texts = msgspec.json.Decoder(tuple[str, ...]).decode

_NONE = "[]"

_KINDS = {kind.value: kind for kind in EntityKind}
_SEVERITIES = {severity.value: severity for severity in Severity}
_EXCESS = (
    "CASE WHEN finding.value IS NULL OR finding.bound IS NULL THEN 0 ELSE max(finding.value, finding.bound) / "
    "CASE WHEN min(finding.value, finding.bound) > 0 THEN 1.0 * min(finding.value, finding.bound) ELSE 1.0 END END DESC"
)
"""SQL that orders by :attr:`roslens.model.finding.Finding.excess`."""


def _in_order(column: str, kind: Iterable[Enum]) -> str:
    """Return SQL that orders by a column as an enumeration does; what declares none comes last."""
    places = " ".join(f"WHEN '{one.value}' THEN {place}" for place, one in enumerate(kind))
    return f"CASE finding.{column} {places} ELSE 99 END"


WORST_FIRST = ", ".join(
    ("finding.gated DESC", _in_order("consequence", Consequence), _in_order("certainty", Certainty), _EXCESS)
)
"""Those that count for gates first, of these the gravest and surest, then those furthest beyond their bound."""

_CONSEQUENCES = {consequence.value: consequence for consequence in Consequence}
_CERTAINTIES = {certainty.value: certainty for certainty in Certainty}
_LANGUAGES = {language.value: language for language in Language}
_ROLES = {role.value: role for role in Role}


def to_json(value: object) -> str:
    """Return the value as JSON text."""
    return _encode(value).decode()


def to_texts(text: str) -> tuple[str, ...]:
    """Read a JSON array of texts."""
    return _decode_texts(text)


def to_summary(text: str) -> PackageSummary:
    """Read a summary."""
    return _decode_summary(text)


def to_package(text: str) -> Package:
    """Read a package as its manifest declares it."""
    return _decode_package(text)


def file_rows(files: Iterable[SourceFile]) -> Iterator[Row]:
    """Yield ``position, FILE``."""
    for position, file in enumerate(files):
        yield (position, file.path, file.language.value, file.role.value, file.size, file.content_hash)


def to_file(row: Row) -> SourceFile:
    """Read ``FILE``."""
    path, language, role, size, content_hash = row
    return SourceFile(path, _LANGUAGES[language], _ROLES[role], size, content_hash)


def entity_rows(entities: Iterable[Entity]) -> Iterator[Row]:
    """Yield ``position, ENTITY``."""
    for position, entity in enumerate(entities):
        yield (
            position,
            entity.id,
            entity.kind.value,
            entity.name,
            entity.path,
            entity.line,
            entity.end_line,
            entity.parent,
            entity.approximate,
        )


def to_entity(row: Row, values: dict[str, float]) -> Entity:
    """Read ``ENTITY``; its values come from elsewhere."""
    identity, kind, name, path, line, end_line, parent, approximate = row
    return Entity(identity, _KINDS[kind], name, path, line, end_line, parent, bool(approximate), values)


def finding_rows(findings: Iterable[Finding]) -> Iterator[Row]:
    """Yield ``position, FINDING`` with the tags themselves at :data:`TAGS`, of which only a store knows the number."""
    for position, finding in enumerate(findings):
        yield (
            position,
            finding.rule,
            finding.severity.value,
            finding.message,
            finding.path,
            finding.line,
            finding.column,
            finding.end_line,
            finding.end_column,
            finding.entity,
            finding.tags,
            finding.tool,
            finding.fingerprint,
            finding.quantity,
            storable_number(finding.value),
            storable_number(finding.bound),
            finding.model,
            finding.gated,
            to_json(finding.witnesses) if finding.witnesses else _NONE,
            to_json(finding.others) if finding.others else _NONE,
            to_json(finding.edits) if finding.edits else _NONE,
            finding.consequence.value if finding.consequence else "",
            finding.certainty.value if finding.certainty else "",
        )


def to_finding(row: Row, tags: Mapping[int, tuple[str, ...]]) -> Finding:
    """Read ``FINDING``; ``tags`` maps numbers to sets of tags."""
    rule, severity, *middle, tag_set, tool, fingerprint, quantity, value, bound, model, gated = row[:-5]
    witnesses, others, edits, consequence, certainty = row[-5:]
    message, path, line, column, end_line, end_column, entity = middle
    return Finding(
        rule,
        _SEVERITIES[severity],
        message,
        path,
        line,
        column,
        end_line,
        end_column,
        entity,
        tags[tag_set],
        tool,
        fingerprint,
        quantity,
        value,
        bound,
        model,
        bool(gated),
        others=() if others == _NONE else to_texts(others),
        witnesses=() if witnesses == _NONE else to_texts(witnesses),
        edits=() if edits == _NONE else _decode_edits(edits),
        consequence=_CONSEQUENCES.get(consequence),
        certainty=_CERTAINTIES.get(certainty),
    )


def set_aside_rows(items: Iterable[SetAside]) -> Iterator[Row]:
    """Yield ``position, SET_ASIDE``."""
    for position, one in enumerate(items):
        finding = msgspec.structs.replace(
            one.finding, value=storable_number(one.finding.value), bound=storable_number(one.finding.bound)
        )
        yield (position, finding.path, one.state.value, one.reason, one.by, one.package, to_json(finding))


def to_set_aside(row: Row) -> SetAside:
    """Read ``SET_ASIDE``."""
    _path, state, reason, by, package, finding = row
    return SetAside(_decode_finding(finding), Disposition(state), reason, by, package)


def failure_rows(failures: Iterable[Failure]) -> Iterator[Row]:
    """Yield ``position, FAILURE``."""
    for position, failure in enumerate(failures):
        yield (
            position,
            failure.tool,
            failure.what,
            failure.expected,
            failure.advice,
            to_json(failure.location) if failure.location else None,
            failure.entity,
            failure.package,
            failure.partial,
            failure.detail,
        )


def to_failure(row: Row) -> Failure:
    """Read ``FAILURE``."""
    tool, what, expected, advice, location, entity, package, partial, detail = row
    place = _decode_location(location) if location else None
    return Failure(tool, what, expected, advice, place, entity, package, bool(partial), detail)


def run_row(header: RunHeader) -> Row:
    """Return ``RUN``."""
    return (
        header.key,
        header.root,
        to_json(header.paths),
        header.started,
        header.seconds,
        header.commit,
        to_json(header.tools),
        to_json(header.configuration),
        to_json(header.models),
        to_json(header.repositories),
        to_json(header.graphs),
    )


def to_header(row: Row) -> RunHeader:
    """Read ``RUN``."""
    key, root, paths, started, seconds, commit, tools, configuration, models, repositories, graphs = row
    return RunHeader(
        key,
        root,
        to_texts(paths),
        started,
        seconds,
        commit,
        _decode(tools),
        _decode(configuration),
        to_texts(models),
        _decode_repositories(repositories),
        _decode_graphs(graphs),
    )
