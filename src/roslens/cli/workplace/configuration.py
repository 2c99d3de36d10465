"""``roslens.toml`` (or ``[tool.roslens]`` in pyproject.toml): what it may say and where it is found.

Unknown keys are errors that name file, line, column and the nearest valid key.
"""

from __future__ import annotations

import difflib
import re
import typing
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import msgspec

from roslens.intake.bounded_file import TooLargeError, read_bounded
from roslens.intake.file_budget import file_budget
from roslens.intake.time_budget import OverBudgetError
from roslens.judge.quality.gate import GateConditions
from roslens.model.errors import DocumentError, UsageError
from roslens.model.finding import Severity
from roslens.model.source import Location, Role
from roslens.source.fetch.settings import FetchSettings
from roslens.source.settings import (
    CountingSettings,
    GraphSettings,
    IgnoreRule,
    MacroSettings,
    ProcessSettings,
    RuleSettings,
    SourceSettings,
    WorkspaceSettings,
)

FILE_NAME = "roslens.toml"
MOST_BYTES = 1_000_000
"""Of a configuration: hundreds of times what one needs. Commands that nobody watches read it in their own process."""


class Configuration(msgspec.Struct, frozen=True):
    """What a configuration file sets; ``base`` is the folder its relative paths start from.

    ``fail_on`` is the severity from which findings fail a check (``never`` for none);
    ``gate`` holds conditions besides, and where it is set ``fail_on`` is ``never`` unless it is set too;
    ``engine`` is where packages are measured: here, or on a cluster;
    ``store`` is a database in which runs are kept, in place of a file;
    ``accept_partial`` lets a check pass although parts of files could not be parsed.
    """

    source: SourceSettings = SourceSettings()
    fail_on: str = "error"
    gate: GateConditions | None = None
    accept_partial: bool = False
    jobs: int = 0
    engine: str = ""
    store: str = ""
    fetch: FetchSettings = FetchSettings()
    path: str = ""
    base: str = ""


_TOP: dict[str, Any] = {
    "models": tuple[str, ...],
    "plugins": tuple[str, ...],
    "disable": tuple[str, ...],
    "gate_roles": tuple[Role, ...],
    "time_limit_s": float,
    "fail_on": str,
    "accept_partial": bool,
    "jobs": int,
    "engine": str,
    "store": str,
    "ignore": tuple[IgnoreRule, ...],
    "distro": str,
}
_TABLES: dict[str, type[msgspec.Struct]] = {
    "workspace": WorkspaceSettings,
    "counting": CountingSettings,
    "macros": MacroSettings,
    "graph": GraphSettings,
    "rules": RuleSettings,
    "process": ProcessSettings,
}
FAIL_ON = (*(severity.value for severity in Severity), "never")


def find_configuration(start: Path, given: str | None) -> Configuration:
    """Read the file ``given``, or the nearest one in ``start`` or a folder above it.

    The search ends at the root of a repository. Without a file everything has its default.

    Raises:
        UsageError: the file given does not exist.
        DocumentError: the file is not valid.
    """
    if given is not None:
        path = Path(given)
        if not path.is_file():
            raise UsageError(
                f"no configuration file {given!r}", expected=f"a {FILE_NAME}", advice="Make one with `roslens init`"
            )
        return read_configuration(path)
    folder = start if start.is_dir() else start.parent
    for above in (folder, *folder.parents):
        if (above / FILE_NAME).is_file():
            return read_configuration(above / FILE_NAME)
        pyproject = above / "pyproject.toml"
        if pyproject.is_file() and _has_table(pyproject):
            return read_configuration(pyproject)
        if (above / ".git").exists():
            break
    return Configuration(base=str(folder))


def _has_table(pyproject: Path) -> bool:
    try:
        # One that is larger than a configuration may be is refused where it is read, not passed over.
        return b"[tool.roslens" in read_bounded(pyproject)
    except OSError:
        return False


def read_configuration(path: Path) -> Configuration:
    """Read a configuration file.

    Raises:
        DocumentError: it is not valid TOML, or a key or value is not valid.
    """
    text = _text(path)
    document: dict[str, Any] = _toml(path, text)
    prefix: tuple[str, ...] = ()
    if path.name == "pyproject.toml":
        prefix = ("tool", "roslens")
        document = document.get("tool", {}).get("roslens", {})
    reader = _Reader(path, text, prefix)
    return reader.read(document)


def _text(path: Path) -> str:
    try:
        return read_bounded(path, MOST_BYTES).decode("utf-8-sig")
    except TooLargeError as error:
        raise DocumentError(
            str(error.strerror),
            where=str(path),
            expected="a TOML file",
            advice="Remove what it does not need, or give another --config",
        ) from error
    except UnicodeDecodeError as error:
        raise DocumentError(
            f"byte {error.start} is not UTF-8", where=str(path), expected="a TOML file in UTF-8"
        ) from error


def _toml(path: Path, text: str) -> dict[str, Any]:
    import tomli

    try:
        with file_budget(str(path), size=len(text)):
            return tomli.loads(text)
    except OverBudgetError as error:
        raise DocumentError(
            str(error), where=str(path), expected="TOML of some kilobytes", advice="Remove what it does not need"
        ) from error
    except RecursionError:
        raise DocumentError(
            "brackets are nested too deep", where=str(path), expected="TOML", advice="Remove some of them"
        ) from None
    except tomli.TOMLDecodeError as error:
        match = re.search(r"\(at line (\d+), column (\d+)\)", str(error))
        # What is not closed is told of the end of the document.
        before = text.rstrip().split("\n")
        line, column = (int(match[1]), int(match[2])) if match else (len(before), len(before[-1]) + 1)
        where = Location(str(path), line, column)
        what = str(error).split(" (at ")[0]
        raise DocumentError(what, where=where, expected="TOML", advice="Fix that line") from error
    except ValueError as error:
        # Python converts no number of more than some thousand digits.
        raise DocumentError(str(error), where=str(path), expected="TOML", advice="Shorten the number") from error


class _Reader:
    def __init__(self, path: Path, text: str, prefix: tuple[str, ...]) -> None:
        self._path = path
        self._lines = text.splitlines()
        self._prefix = prefix

    def read(self, document: Mapping[str, Any]) -> Configuration:
        valid = (*_TOP, *_TABLES, "fetch", "gate", "options", "tools")
        for key in document:
            if key not in valid:
                raise self._unknown((key,), valid)
        top: dict[str, Any] = {
            key: self._value((key,), document[key], kind) for key, kind in _TOP.items() if key in document
        }
        tables = self._tables(document)
        self._check_ignored(top.get("ignore", ()))
        self._check_distro(top.get("distro", ""))
        gate = self._gate(document["gate"]) if "gate" in document else None
        fail_on = str(top.pop("fail_on", "error" if gate is None else "never"))
        if fail_on not in FAIL_ON:
            raise DocumentError(
                f"fail_on = {fail_on!r}", where=self._where(("fail_on",)), expected=f"one of {', '.join(FAIL_ON)}"
            )
        if "gate_roles" in top:
            top["gate_roles"] = tuple(role.value for role in top["gate_roles"])
        own: dict[str, Any] = {key: top.pop(key) for key in ("accept_partial", "jobs", "engine", "store") if key in top}
        if "fetch" in document:
            own["fetch"] = self._table("fetch", document["fetch"], FetchSettings)
        if own.get("store") and not own["store"].startswith(("postgresql://", "postgres://")):
            raise DocumentError(
                f"store = {own['store']!r}", where=self._where(("store",)), expected="postgresql://HOST/DATABASE"
            )
        source = SourceSettings(**top, **tables, options=self._options(document.get("options", {})))
        return Configuration(source, fail_on, gate, path=str(self._path), base=str(self._path.parent), **own)

    def _tables(self, document: Mapping[str, Any]) -> dict[str, Any]:
        """Return the tables of settings of the source half, by their names."""
        tables: dict[str, Any] = {
            key: self._table(key, document[key], kind) for key, kind in _TABLES.items() if key in document
        }
        if "tools" in document:
            from roslens.cli.workplace.tools_table import read_tools

            tables["tools"] = read_tools(document["tools"], self._value, self._where)
        if "macros" in tables:
            self._check_macros(tables["macros"])
        return tables

    def _check_distro(self, name: str) -> None:
        """Tell of a distribution that there is not."""
        from roslens.source.distributions.known_distributions import distributions

        if name and name not in distributions():
            near = difflib.get_close_matches(name, distributions(), 1)
            raise DocumentError(
                f"distro = {name!r}",
                where=self._where(("distro",)),
                expected=f"one of {', '.join(distributions())}",
                advice=f"Did you mean {near[0]!r}?" if near else "",
            )

    def _check_ignored(self, rules: Iterable[Any]) -> None:
        """Tell of an ``[[ignore]]`` that lacks what it is for."""
        for number, rule in enumerate(rules, 1):
            lacks = (
                "no reason" if not rule.reason.strip() else "" if rule.paths or rule.rules else "no paths and no rules"
            )
            if lacks:
                raise DocumentError(
                    f"[[ignore]] {number} has {lacks}",
                    where=self._where(("ignore",)),
                    expected='paths = ["…"] or rules = ["…"] or both, and reason = "why"',
                )

    def _gate(self, table: object) -> GateConditions:
        gate = self._table("gate", table, GateConditions)
        if not isinstance(gate, GateConditions) or gate == GateConditions():
            raise DocumentError(
                "[gate] asks for nothing, so that everything would pass",
                where=self._where(("gate",)),
                expected=f"at least one of {', '.join(GateConditions.__struct_fields__)}",
            )
        return gate

    def _table(self, name: str, table: object, kind: type[msgspec.Struct]) -> msgspec.Struct:
        if not isinstance(table, dict):
            raise DocumentError(f"{name} = {table!r}", where=self._where((name,)), expected=f"a table [{name}]")
        fields = {field.name: field.type for field in msgspec.structs.fields(kind)}
        for key, value in table.items():
            if key not in fields:
                raise self._unknown((name, key), tuple(fields))
            self._check_entries((name, key), value, fields[key])
        return kind(**{key: self._value((name, key), value, fields[key]) for key, value in table.items()})

    def _check_macros(self, macros: MacroSettings) -> None:
        """Tell of a name of a macro that is no expression, rather than of each file that it cannot be looked for in."""
        from roslens.source.syntax.macro.own_macros import OwnMacros

        for key in ("blank", "statement"):
            try:
                OwnMacros({key: getattr(macros, key)})
            except ValueError as error:
                raise DocumentError(
                    f"{key}: {error}", where=self._where(("macros", key)), expected="names, or expressions of names"
                ) from None

    def _check_entries(self, keys: tuple[str, ...], table: object, kind: Any) -> None:
        """Tell which key of which entry is unknown where a table holds tables by name."""
        inside = typing.get_args(kind)
        if not isinstance(table, dict) or len(inside) != 2 or not hasattr(inside[1], "__struct_fields__"):
            return
        for name, entry in table.items():
            for key in entry if isinstance(entry, dict) else ():
                if key not in inside[1].__struct_fields__:
                    raise self._unknown((*keys, name, key), inside[1].__struct_fields__)
            self._value((*keys, name), entry, inside[1])

    def _options(self, options: object) -> dict[str, dict[str, object]]:
        if not isinstance(options, dict) or not all(isinstance(table, dict) for table in options.values()):
            raise DocumentError(
                f"options = {options!r}", where=self._where(("options",)), expected="tables [options.<plug-in>]"
            )
        return options

    def _value(self, keys: tuple[str, ...], value: object, kind: Any) -> Any:
        try:
            return msgspec.convert(value, kind)
        except msgspec.ValidationError as error:
            raise DocumentError(
                f"{'.'.join(keys)} = {value!r}",
                where=self._where(keys),
                expected=str(error).removeprefix("Expected ").split(" - at")[0],
            ) from error

    def _unknown(self, keys: tuple[str, ...], valid: tuple[str, ...]) -> DocumentError:
        near = difflib.get_close_matches(keys[-1], valid, 1)
        return DocumentError(
            f"unknown key {'.'.join(keys)!r}",
            where=self._where(keys),
            expected=f"one of {', '.join(valid)}",
            advice=f"Did you mean {near[0]!r}?" if near else "",
        )

    def _where(self, keys: tuple[str, ...]) -> Location:
        """Find the line of a key; TOML readers give values without places."""
        *table, last = (*self._prefix, *keys)
        current: list[str] = []
        whole = ".".join((*table, last))
        for number, line in enumerate(self._lines, 1):
            if header := re.match(r"\s*\[\[?([^\]]+)\]", line):
                current = [part.strip().strip("\"'") for part in header[1].split(".")]
                if ".".join(current) == whole:
                    return Location(str(self._path), number, line.index("[") + 1)
            elif match := re.match(r"\s*([\w.\"'-]+)\s*=", line):
                key = [part.strip("\"'") for part in match[1].split(".")]
                if ".".join((*current, *key)) == whole:
                    return Location(str(self._path), number, match.start(1) + 1)
        return Location(str(self._path))
