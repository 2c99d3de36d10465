"""The whole result as JSON: ``docs/reference/report.schema.json`` says what it looks like.

Each item stands on a line of its own, so that a report can be searched and compared line by line, and the report is
written while it is read: its size costs no memory.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from typing import Any, TextIO

import msgspec

from roslens.judge.quality.unusual import percentiles
from roslens.model.entity import Entity, EntityKind
from roslens.model.failure import Failure
from roslens.model.finding import Finding, RuleInfo
from roslens.model.graphs.graph_scope import GraphScope
from roslens.model.process import RepositoryProcess
from roslens.model.quantity import Quantity
from roslens.model.repository import FoundRepository
from roslens.model.result import PackageSummary, RunHeader
from roslens.model.set_aside import SetAside
from roslens.model.source import OUTSIDE_PACKAGES, SourceFile
from roslens.model.tags import TagFilter
from roslens.report.writing.control_characters import shown_control_bytes
from roslens.report.writing.numbers import plain, written
from roslens.store.read import RunView

SCHEMA = "roslens-report/1"
"""Name and version; within a version keys are only added."""

_CHUNK = 1 << 16
_encode = msgspec.json.Encoder().encode


def write_json(
    view: RunView, stream: TextIO, tags: TagFilter | None = None, is_new: Callable[[Finding], bool] | None = None
) -> None:
    """Write the run as one JSON document in UTF-8.

    Two runs on the same input differ at most in ``run.started`` and ``run.seconds``.

    Args:
        view: the run.
        stream: where to; what it has as ``buffer`` is written to directly, whatever the stream's own encoding.
        tags: which findings are meant; all for None. Everything else is complete in any case.
        is_new: whether a finding is new since a baseline; None where there is none.

    Raises:
        StoreError: the store cannot be read.
        OSError: the stream cannot be written.
    """
    chunk: list[bytes] = []
    size = 0
    for part in _document(view, tags or TagFilter(), is_new):
        chunk.append(part)
        size += len(part)
        if size >= _CHUNK:
            _write(stream, b"".join(chunk))
            chunk.clear()
            size = 0
    _write(stream, b"".join(chunk))


def _write(stream: TextIO, content: bytes) -> None:
    buffer = getattr(stream, "buffer", None)
    if buffer is None:
        stream.write(content.decode())
        return
    stream.flush()
    buffer.write(shown_control_bytes(content))


def _document(view: RunView, tags: TagFilter, is_new: Callable[[Finding], bool] | None) -> Iterator[bytes]:
    yield b'{\n"schema": ' + _encode(SCHEMA)
    yield b',\n"run": ' + _encode(_run(view.header, tags))
    packages = (one for one in view.packages() if one.id != OUTSIDE_PACKAGES)
    yield from _array("packages", map(_encode, map(_package, packages)))
    yield from _array("files", (_encode(_file(package, file)) for package, file in view.files()))
    yield from _array("entities", map(_encode, map(_entity, view.entities())))
    yield from _array("measurements", _measurements(view.entities()))
    yield from _array("findings", (_encode(_finding(*owned, is_new)) for owned in view.owned_findings(tags)))
    yield from _array("failures", map(_encode, map(_failure, view.failures())))
    yield from _array("rules", map(_encode, map(_rule, view.rules())))
    yield from _array("quantities", map(_encode, map(_quantity, view.quantities())))
    if view.header.repositories:
        yield from _array("repositories", (_encode(_repository(one)) for one in view.header.repositories))
    if view.process:
        yield from _array("process", (_encode(_process(one)) for one in view.process))
    yield from _array("set_aside", (_encode(_set_aside(one)) for one in view.set_aside(tags=tags)))
    yield b"\n}\n"


def _array(name: str, items: Iterable[bytes]) -> Iterator[bytes]:
    yield b",\n" + _encode(name) + b": ["
    separator = b"\n"
    for item in items:
        yield separator
        yield item
        separator = b",\n"
    yield b"\n]"


def _run(header: RunHeader, tags: TagFilter) -> dict[str, Any]:
    return {
        "key": header.key,
        "root": header.root,
        "paths": header.paths,
        "commit": header.commit,
        "started": header.started,
        "seconds": header.seconds,
        "tools": header.tools,
        "models": header.models,
        "configuration": header.configuration,
        "tags": str(tags),
        **({"graphs": _graphs(header.graphs)} if header.graphs else {}),
    }


def _graphs(one: GraphScope) -> dict[str, Any]:
    known = {name: msgspec.to_builtins(each) for name, each in one.completeness.items()}
    return {"looked_at": one.looked_at, "left_out": one.left_out, "completeness": known}


def _process(one: RepositoryProcess) -> dict[str, Any]:
    """What a history says of its repository; packages and files have theirs among the measurements."""
    return {
        "repository": one.path,
        "head": one.head,
        "head_s": one.head_s,
        "as_of_s": plain(one.as_of_s),
        "skewed": one.skewed,
        "skew_s": one.skew_s,
        "metrics": {key: plain(value) for key, value in sorted(one.values.items())},
        "coupled_files": [msgspec.to_builtins(pair) for pair in one.coupled_files],
        "coupled_packages": [msgspec.to_builtins(pair) for pair in one.coupled_packages],
        "releases": [msgspec.to_builtins(release) for release in one.releases],
    }


def _repository(one: FoundRepository) -> dict[str, Any]:
    return {
        "name": one.name,
        "path": one.path,
        "url": one.url,
        "version": one.version,
        "commit": one.commit,
        "packages": one.packages,
    }


def _package(package: PackageSummary) -> dict[str, Any]:
    return {
        "id": package.id,
        "name": package.name,
        "path": package.path,
        **({"repository": package.repository} if package.repository else {}),
        "version": package.version,
        "build_type": package.build_type,
        "dependencies": package.dependencies,
        "metrics": {key: plain(value) for key, value in sorted(package.values.items())},
        "percentiles": {key: plain(value) for key, value in percentiles(EntityKind.PACKAGE, package.values).items()},
    }


def _file(package: str, file: SourceFile) -> dict[str, Any]:
    return {
        "path": file.path,
        "package": package,
        "language": file.language,
        "role": file.role,
        "size": file.size,
        "content_hash": file.content_hash,
    }


def _entity(entity: Entity) -> dict[str, Any]:
    shown: dict[str, Any] = {
        "id": entity.id,
        "kind": entity.kind,
        "name": entity.name,
        "path": entity.path,
        "line": entity.line,
        "parent": entity.parent,
    }
    if entity.approximate:
        shown["approximate"] = True
    return shown


def _measurements(entities: Iterable[Entity]) -> Iterator[bytes]:
    """Yield the measurements of each entity; put together by hand, for there are some hundred thousand of them."""
    keys = _Keys()
    for entity in entities:
        start = f'{{"entity":{_encode(entity.id).decode()},"quantity":'
        lines = [
            f"{start}{keys[quantity]}{repr(value) if type(value) is int else written(value)}}}"
            for quantity, value in sorted(entity.values.items())
        ]
        if lines:
            yield ",\n".join(lines).encode()


class _Keys(dict[str, str]):
    """What stands between the entity and the value of a measurement, by quantity."""

    def __missing__(self, quantity: str) -> str:
        self[quantity] = text = f'{_encode(quantity).decode()},"value":'
        return text


def _finding(package: str, finding: Finding, is_new: Callable[[Finding], bool] | None = None) -> dict[str, Any]:
    shown: dict[str, Any] = {
        "rule": finding.rule,
        "severity": finding.severity,
        "consequence": finding.weight[0],
        "certainty": finding.weight[1],
        "message": finding.message,
        "package": package,
        "path": finding.path,
        "line": finding.line,
        "column": finding.column,
        "end_line": finding.end_line,
        "end_column": finding.end_column,
        "entity": finding.entity,
        "tags": finding.tags,
        "tool": finding.tool,
        "fingerprint": finding.fingerprint,
        "gated": finding.gated,
    }
    if finding.witnesses:
        shown["witnesses"] = finding.witnesses
    if finding.others:
        shown["others"] = finding.others
    if finding.edits:
        shown["fix"] = [
            {"path": one.path, "start": one.start, "end": one.end, "text": one.text, "made_for": one.made_for}
            for one in finding.edits
        ]
    if is_new is not None:
        shown["new"] = is_new(finding)
    if finding.model:
        shown["model"] = finding.model
        shown["quantity"] = finding.quantity
        shown.update(
            {
                key: plain(value)
                for key, value in (("value", finding.value), ("bound", finding.bound))
                if value is not None and math.isfinite(value)
            }
        )
    return shown


def _set_aside(one: SetAside) -> dict[str, Any]:
    return {
        "state": one.state,
        "reason": one.reason,
        "by": one.by,
        "finding": _finding(one.package, one.finding),
    }


def _failure(failure: Failure) -> dict[str, Any]:
    place = failure.location
    return {
        "tool": failure.tool,
        "what": failure.what,
        "expected": failure.expected,
        "advice": failure.advice,
        "path": place.path if place else "",
        "line": place.line if place else 0,
        "column": place.column if place else 0,
        "entity": failure.entity,
        "package": failure.package,
        "partial": failure.partial,
    }


def _rule(rule: RuleInfo) -> dict[str, Any]:
    consequence, certainty = rule.weight
    fields = {name: getattr(rule, name) for name in rule.__struct_fields__}
    return {**fields, "consequence": consequence, "certainty": certainty}


def _quantity(quantity: Quantity) -> dict[str, Any]:
    return {
        "key": quantity.key,
        "title": quantity.title,
        "unit": quantity.unit,
        "kinds": quantity.kinds,
        "folds": quantity.folds,
        "better": quantity.better,
        "text": quantity.text,
    }
