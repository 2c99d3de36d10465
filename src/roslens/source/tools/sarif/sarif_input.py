"""SARIF 2.1.0 that any tool wrote, read into findings of this workspace.

Only what SARIF says of findings is looked at: nothing that it names is opened, and what points outside of the workspace
is left out and counted.
"""

from __future__ import annotations

import re
from collections import Counter
from typing import Any
from urllib.parse import unquote, urlsplit

import msgspec

from roslens.model.finding import RuleInfo, Severity
from roslens.source.tools.checks.tool_checks import checks_of, rule_id, rule_of
from roslens.source.tools.tool import ToolFinding, below_root

MOST_BYTES = 128 * 1024 * 1024
MOST_RESULTS = 200_000
"""The maximum number of results: a file that has more is rejected."""

LEVELS = {"error": Severity.ERROR, "warning": Severity.WARNING, "note": Severity.NOTE, "none": Severity.NOTE}
_SILENT_KINDS = frozenset({"pass", "informational", "notApplicable"})
_NAMELESS = re.compile(r"[^a-z0-9]+")
_LONGEST = 1000


class SarifError(Exception):
    """A document is not readable SARIF; the text states what was found."""


class _Text(msgspec.Struct, frozen=True, rename="camel"):
    text: str | None = None
    id: str | None = None
    arguments: list[str] | None = None


class _Region(msgspec.Struct, frozen=True, rename="camel"):
    start_line: int | None = None
    start_column: int | None = None
    end_line: int | None = None
    end_column: int | None = None


class _Artifact(msgspec.Struct, frozen=True, rename="camel"):
    uri: str | None = None
    uri_base_id: str | None = None
    index: int | None = None


class _Physical(msgspec.Struct, frozen=True, rename="camel"):
    artifact_location: _Artifact | None = None
    region: _Region | None = None


class _Location(msgspec.Struct, frozen=True, rename="camel"):
    physical_location: _Physical | None = None


class _RuleReference(msgspec.Struct, frozen=True, rename="camel"):
    id: str | None = None
    index: int | None = None
    tool_component: dict[str, Any] | None = None


class _Suppression(msgspec.Struct, frozen=True, rename="camel"):
    status: str | None = None


class _Result(msgspec.Struct, frozen=True, rename="camel"):
    message: _Text
    rule_id: str | None = None
    rule_index: int | None = None
    rule: _RuleReference | None = None
    level: str | None = None
    kind: str | None = None
    locations: list[_Location] | None = None
    suppressions: list[_Suppression] | None = None


class _Configuration(msgspec.Struct, frozen=True, rename="camel"):
    level: str | None = None


class _Descriptor(msgspec.Struct, frozen=True, rename="camel"):
    id: str
    name: str | None = None
    short_description: _Text | None = None
    full_description: _Text | None = None
    default_configuration: _Configuration | None = None
    help_uri: str | None = None
    message_strings: dict[str, _Text] | None = None
    properties: dict[str, Any] | None = None


class _Component(msgspec.Struct, frozen=True, rename="camel"):
    name: str
    version: str | None = None
    semantic_version: str | None = None
    rules: list[_Descriptor] | None = None


class _Tool(msgspec.Struct, frozen=True, rename="camel"):
    driver: _Component
    extensions: list[_Component] | None = None


class _Entry(msgspec.Struct, frozen=True, rename="camel"):
    location: _Artifact | None = None


class _Notification(msgspec.Struct, frozen=True, rename="camel"):
    message: _Text | None = None
    level: str | None = None


class _Invocation(msgspec.Struct, frozen=True, rename="camel"):
    execution_successful: bool | None = None
    tool_execution_notifications: list[_Notification] | None = None


class _Run(msgspec.Struct, frozen=True, rename="camel"):
    tool: _Tool
    results: list[_Result] | None = None
    original_uri_base_ids: dict[str, _Artifact] | None = None
    artifacts: list[_Entry] | None = None
    invocations: list[_Invocation] | None = None


class _Log(msgspec.Struct, frozen=True, rename="camel"):
    version: str
    runs: list[_Run] | None = None


class Imported(msgspec.Struct, frozen=True):
    """A document: findings by tool, what their rules are, versions of tools, and what is wrong with it."""

    findings: dict[str, tuple[ToolFinding, ...]]
    rules: dict[str, RuleInfo]
    versions: dict[str, str]
    trouble: tuple[str, ...] = ()


def read_sarif(content: bytes, root: str) -> Imported:
    """Read a document.

    Args:
        content: the document.
        root: of the workspace, absolute; locations that are relative start there.

    Raises:
        SarifError: it is no SARIF 2.1.0, or has too many results.
    """
    try:
        log = msgspec.json.decode(content.removeprefix(b"\xef\xbb\xbf"), type=_Log)
    except (msgspec.DecodeError, UnicodeDecodeError, RecursionError) as error:
        raise SarifError(f"no SARIF: {error}") from error
    if not log.version.startswith("2.1"):
        raise SarifError(f"SARIF of version {log.version!r}")
    if log.runs is None:
        raise SarifError("SARIF without `runs`")
    count = sum(len(run.results or ()) for run in log.runs)
    if count > MOST_RESULTS:
        raise SarifError(f"{count:,} results; at most {MOST_RESULTS:,} are read")
    reader = _Reader(root)
    for run in log.runs:
        reader.read(run)
    return reader.imported()


class _Reader:
    def __init__(self, root: str) -> None:
        self._root = root.rstrip("/")
        self._found: dict[str, set[ToolFinding]] = {}
        self._rules: dict[str, RuleInfo] = {}
        self._versions: dict[str, str] = {}
        self._left_out: Counter[str] = Counter()
        self._trouble: list[str] = []

    def imported(self) -> Imported:
        left_out = [f"{count:,} {why} left out" for why, count in sorted(self._left_out.items())]
        findings = {tool: tuple(sorted(found)) for tool, found in sorted(self._found.items())}
        return Imported(findings, self._rules, self._versions, (*self._trouble, *left_out))

    def read(self, run: _Run) -> None:
        driver = run.tool.driver
        tool = tool_name(driver.name)
        self._versions[tool] = driver.semantic_version or driver.version or "unknown"
        for invocation in run.invocations or ():
            if invocation.execution_successful is False:
                said = next((_plain(one.message) for one in invocation.tool_execution_notifications or ()), "")
                self._trouble.append(f"{driver.name} reports that its run failed" + (f": {said[:200]}" if said else ""))
        if run.results is None:
            self._trouble.append(f"{driver.name} has no `results`: it did not run to its end")
        for result in run.results or ():
            self._result(run, tool, result)

    def _result(self, run: _Run, tool: str, result: _Result) -> None:
        if result.kind in _SILENT_KINDS:
            return
        if any(one.status in (None, "accepted") for one in result.suppressions or ()):
            self._left_out["suppressed results were"] += 1
            return
        descriptor = _descriptor(run.tool, result)
        check = _check(result, descriptor)
        place = self._place(run, result)
        if place is None:
            return
        configured = descriptor.default_configuration.level if descriptor and descriptor.default_configuration else None
        level = result.level or configured or "warning"
        path, region = place
        finding = ToolFinding(
            path,
            _position(region.start_line),
            _position(region.start_column),
            check,
            _message(result, descriptor)[:_LONGEST] or check,
            _position(region.end_line),
            max(0, _position(region.end_column) - 1),
            level,
        )
        self._found.setdefault(tool, set()).add(finding)
        identity = rule_id(tool, check)
        if identity not in self._rules:
            self._rules[identity] = _rule(tool, check, descriptor, level)

    def _place(self, run: _Run, result: _Result) -> tuple[str, _Region] | None:
        for location in result.locations or ():
            physical = location.physical_location
            if physical is None or physical.artifact_location is None:
                continue
            address = _address(physical.artifact_location, run)
            path = below_root(address, self._root) if address is not None else ""
            if path:
                return path, physical.region or _Region()
            self._left_out["results that point outside of the workspace were"] += 1
            return None
        self._left_out["results without a place were"] += 1
        return None


def tool_name(name: str) -> str:
    """Return the name of a driver as rules are prefixed here: ``Clang-Tidy`` is ``clang_tidy``."""
    plain = _NAMELESS.sub("_", name.lower()).strip("_") or "sarif"
    return plain if plain[0].isalpha() else f"tool_{plain}"


def _address(artifact: _Artifact, run: _Run) -> str | None:
    """Return the path of an artifact, absolute or relative to the workspace; None where it is no file."""
    named = artifact if artifact.uri is not None else _entry(artifact.index, run)
    if named is None or named.uri is None:
        return None
    path = _path_of(named.uri)
    bases = run.original_uri_base_ids or {}
    base = named.uri_base_id
    for _ in range(10):
        if path is None or path.startswith("/") or base is None or base not in bases:
            break
        above = _path_of(bases[base].uri or "")
        path = f"{above.rstrip('/')}/{path}" if above else path
        base = bases[base].uri_base_id
    return path


def _entry(index: int | None, run: _Run) -> _Artifact | None:
    """Return the artifact that a run lists under an index."""
    entries = run.artifacts or []
    return entries[index].location if index is not None and 0 <= index < len(entries) else None


def _path_of(uri: str) -> str | None:
    """Return the path of a URI; None where it is none of a file, or has bytes that no path has."""
    try:
        parts = urlsplit(uri)
    except ValueError:
        return None
    if parts.scheme not in ("", "file") or parts.netloc not in ("", "localhost"):
        return None
    path = unquote(parts.path)
    return None if "\0" in path else path


def _descriptor(tool: _Tool, result: _Result) -> _Descriptor | None:
    index = result.rule_index if result.rule_index is not None else (result.rule.index if result.rule else None)
    component = (result.rule.tool_component or {}).get("index") if result.rule else None
    extensions = tool.extensions or []
    holder = extensions[component] if isinstance(component, int) and 0 <= component < len(extensions) else tool.driver
    rules = holder.rules or []
    if index is not None and 0 <= index < len(rules):
        return rules[index]
    named = result.rule_id or (result.rule.id if result.rule else None)
    return next((one for holder in (tool.driver, *extensions) for one in holder.rules or () if one.id == named), None)


def _check(result: _Result, descriptor: _Descriptor | None) -> str:
    named = result.rule_id or (result.rule.id if result.rule else None) or (descriptor.id if descriptor else "")
    return "".join(character for character in named if character.isprintable() and character != " ")[:200] or "result"


def _message(result: _Result, descriptor: _Descriptor | None) -> str:
    text = result.message.text
    if text is None and result.message.id and descriptor and descriptor.message_strings:
        named = descriptor.message_strings.get(result.message.id)
        text = named.text if named else None
    for number, argument in enumerate(result.message.arguments or ()):
        text = (text or "").replace(f"{{{number}}}", argument)
    return " ".join((text or "").split())


def _rule(tool: str, check: str, descriptor: _Descriptor | None, level: str) -> RuleInfo:
    known = rule_of(tool, check)
    if checks_of(tool).about or descriptor is None:
        return known
    title = _plain(descriptor.short_description) or descriptor.name or check
    about = _plain(descriptor.full_description)
    tags = (descriptor.properties or {}).get("tags", [])
    kept = tuple(str(tag) for tag in tags if isinstance(tag, str))[:10] if isinstance(tags, list) else ()
    url = descriptor.help_uri or ""
    return msgspec.structs.replace(
        known,
        title=title[:200],
        description=f"{known.description} {about}".strip()[:_LONGEST],
        severity=LEVELS.get(level, Severity.WARNING),
        tags=tuple(dict.fromkeys((*known.tags, *kept))),
        url=url if url.startswith(("https://", "http://")) else "",
    )


def _plain(text: _Text | None) -> str:
    return " ".join(((text.text if text else "") or "").split())


def _position(number: int | None) -> int:
    return number if number is not None and 0 < number < 2**31 else 0
