"""What a HAROS plug-in declares in its ``plugin.yaml``, as roslens' rules and quantities."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import msgspec
import yaml

from roslens.intake.bounded_file import read_bounded
from roslens.intake.safe_yaml import MOST_BYTES, UnsafeYamlError, load_yaml
from roslens.model.entity import EntityKind
from roslens.model.errors import PluginError
from roslens.model.finding import RuleInfo, Severity
from roslens.model.quantity import Better, Fold, Quantity
from roslens.model.source import Language
from roslens.model.weight.consequence import Certainty, Consequence

_KINDS = (EntityKind.FILE, EntityKind.FUNCTION, EntityKind.CLASS, EntityKind.PACKAGE)
_FORMAL = {"formatting", "whitespace"}
_FROM_HAROS = {
    "cpp": (Language.C, Language.CPP),
    "python": (Language.PYTHON, Language.LAUNCH_PYTHON),
    "package": (Language.MANIFEST,),
    "launch": (Language.LAUNCH_XML, Language.XML),
    "msg": (Language.MSG,),
    "srv": (Language.SRV,),
    "action": (Language.ACTION,),
    "yaml": (Language.YAML, Language.LAUNCH_YAML),
    "cmake": (Language.CMAKE,),
}
TO_HAROS = {language: name for name, languages in _FROM_HAROS.items() for language in languages}
"""HAROS' name of a language; it knows no others, and no files of others."""


class HarosRule(msgspec.Struct, frozen=True, omit_defaults=True):
    """A rule as HAROS plug-ins see it: ``id`` has the prefix ``plugin:`` unless it is a core rule."""

    id: str
    name: str
    scope: str = "file"
    description: str = ""
    tags: tuple[str, ...] = ()
    query: str | None = None


class HarosMetric(msgspec.Struct, frozen=True, omit_defaults=True):
    """A metric as HAROS plug-ins see it."""

    id: str
    name: str
    scope: str = "file"
    description: str = ""
    minimum: float | None = None
    maximum: float | None = None


class Declared(msgspec.Struct, frozen=True):
    """What a plug-in may report, by the id it uses: its own, and the core ids it may use."""

    name: str
    version: str
    languages: tuple[str, ...]
    rules: dict[str, HarosRule]
    metrics: dict[str, HarosMetric]


def read_declared(folder: Path) -> Declared:
    """Read ``plugin.yaml``.

    Core rules and metrics belong to a plug-in when it lists them as supported, or names them
    anywhere in its source: HAROS itself accepts them from every plug-in.

    Raises:
        PluginError: the file is no such manifest, or its name is not that of the folder.
    """
    path = folder / "plugin.yaml"
    try:
        content = load_yaml(read_bounded(path, MOST_BYTES))
    except (OSError, UnsafeYamlError) as error:
        words = " ".join(str(error).split())
        raise PluginError(f"cannot read plugin.yaml: {words}", expected="a YAML file with name and version") from error
    if not isinstance(content, dict) or "name" not in content or "version" not in content:
        raise PluginError("plugin.yaml has no name or no version", expected="both, as HAROS demands")
    if content["name"] != folder.name:
        raise PluginError(f"plugin.yaml has name: {content['name']!r}", expected=f"{folder.name!r}, the package's name")
    core = _core()
    used = _ids_in_source(folder, {*core["rules"], *core["metrics"]})
    used |= {str(key) for part in ("supported_rules", "supported_metrics") for key in content.get(part) or ()}
    rules = {key: _core_rule(key, core["rules"][key]) for key in sorted(used & set(core["rules"]))}
    metrics = {key: _core_metric(key, core["metrics"][key]) for key in sorted(used & set(core["metrics"]))}
    rules.update(_own(folder.name, content, "rules", set(core["rules"]), _own_rule))
    metrics.update(_own(folder.name, content, "metrics", set(core["metrics"]), _own_metric))
    languages = tuple(str(language) for language in content.get("languages") or ())
    return Declared(folder.name, str(content["version"]), languages, rules, metrics)


def _core() -> dict[str, dict[str, dict[str, Any]]]:
    content: dict[str, dict[str, dict[str, Any]]] = yaml.safe_load(Path(__file__).with_name("core.yaml").read_text())
    return content


def _ids_in_source(folder: Path, ids: set[str]) -> set[str]:
    text = "\n".join(path.read_text("utf-8", "replace") for path in sorted(folder.rglob("*.py")))
    return {key for key in ids if f'"{key}"' in text or f"'{key}'" in text}


def _own(plugin: str, content: Mapping[str, Any], part: str, core: set[str], make: Any) -> Iterator[tuple[str, Any]]:
    declared = content.get(part) or {}
    if not isinstance(declared, dict):
        raise PluginError(f"{part} in plugin.yaml is a {type(declared).__name__}", expected="a table of ids")
    for key, value in declared.items():
        if not isinstance(value, dict):
            raise PluginError(f"{part}.{key} in plugin.yaml is {value!r}", expected="a table with name and description")
        if key not in core:
            yield str(key), make(f"{plugin}:{key}", value)


def _own_rule(key: str, value: Mapping[str, Any]) -> HarosRule:
    return HarosRule(
        key,
        str(value.get("name", key)),
        str(value.get("scope", "file")),
        " ".join(str(value.get("description", "")).split()),
        tuple(str(tag) for tag in value.get("tags") or ()),
        value.get("query"),
    )


def _own_metric(key: str, value: Mapping[str, Any]) -> HarosMetric:
    low, high = (_bound(value, short, long) for short, long in (("min", "minimum"), ("max", "maximum")))
    text = " ".join(str(value.get("description", "")).split())
    return HarosMetric(key, str(value.get("name", key)), str(value.get("scope", "file")), text, low, high)


def _bound(value: Mapping[str, Any], *names: str) -> float | None:
    found = next((value[name] for name in names if value.get(name) is not None), None)
    return float(found) if isinstance(found, int | float) else None


def _core_rule(key: str, value: Mapping[str, Any]) -> HarosRule:
    return HarosRule(key, value["title"], value["scope"], f"{value['title']}.", tuple(value["tags"]))


def _core_metric(key: str, value: Mapping[str, Any]) -> HarosMetric:
    return HarosMetric(
        key, value["title"], value["scope"], f"{value['title']}.", value.get("minimum"), value.get("maximum")
    )


def rule_infos(declared: Declared) -> tuple[RuleInfo, ...]:
    """Return the rules with ids ``plugin.rule``; what is tagged as formatting is a note, all else a warning."""
    return tuple(
        RuleInfo(
            id=f"{declared.name}.{key}",
            title=rule.name,
            description=rule.description or rule.name,
            severity=Severity.NOTE if _FORMAL & set(rule.tags) else Severity.WARNING,
            tags=rule.tags,
            tool=declared.name,
            languages=roslens_languages(declared.languages),
            scope=rule.scope,
            consequence=Consequence.STYLE if _FORMAL & set(rule.tags) else Consequence.MAY_BE_WRONG,
            certainty=Certainty.LIKELY,
        )
        for key, rule in sorted(declared.rules.items())
    )


def quantities(declared: Declared) -> tuple[Quantity, ...]:
    """Return the metrics as quantities ``plugin.metric`` of files, functions, classes and packages."""
    return tuple(
        Quantity(
            key=f"{declared.name}.{key}",
            title=metric.name,
            unit="1",
            kinds=_KINDS,
            text=metric.description or metric.name,
            folds=(Fold.MAX,),
            better=Better.HIGHER if key == "maintainability_index" else Better.LOWER,
            formula=f"as {declared.name} computes it",
            minimum=metric.minimum,
            maximum=metric.maximum,
            decimals=2,
        )
        for key, metric in sorted(declared.metrics.items())
    )


def roslens_languages(languages: tuple[str, ...]) -> tuple[str, ...]:
    """Return the languages of roslens that HAROS' languages stand for."""
    return tuple(known.value for language in languages for known in _FROM_HAROS.get(language, ()))
