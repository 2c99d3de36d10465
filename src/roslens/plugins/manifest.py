"""Whether a manifest is one that the framework can work with."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator

import msgspec

from roslens.model.source import Language
from roslens.model.weight.consequence import severity_of
from roslens.plugins.contract_failures import Violation
from roslens.plugins.nearest import did_you_mean
from roslens.plugins.options import TYPES, check_option
from roslens.plugins.points import HOOKS, INTERFACE_VERSION, Manifest

_NAME = re.compile(r"[a-z][a-z0-9_]*\Z")
_VERSION = re.compile(r"(\d+)\.(\d+)\Z")
_LANGUAGES = tuple(language.value for language in Language)


def read_manifest(plugin: object) -> Manifest | Violation:
    """Return the manifest of a loaded plug-in with the types of all its values checked."""
    if isinstance(plugin, type):
        return Violation(f"it is the class {plugin.__name__}", "a module or an instance", "Name an instance instead")
    manifest = getattr(plugin, "manifest", None)
    if not isinstance(manifest, Manifest):
        found = "no `manifest`" if manifest is None else f"a `manifest` that is a {type(manifest).__name__}"
        return Violation(f"it has {found}", "a roslens.plugins.points.Manifest", "See docs/reference/plugins.md")
    try:
        return _weighed(msgspec.convert(msgspec.to_builtins(manifest), Manifest))
    except (msgspec.ValidationError, TypeError, ValueError) as error:
        return Violation(f"its manifest does not fit: {error}", "the types of roslens.plugins.points.Manifest")


def _weighed(manifest: Manifest) -> Manifest:
    """Return a manifest whose rules have the severity that follows from what they declare, or what theirs implies."""
    rules = []
    for rule in manifest.rules:
        if rule.consequence is not None and rule.certainty is not None:
            severity = severity_of(rule.consequence, rule.certainty, unproven=rule.unproven)
            rules.append(msgspec.structs.replace(rule, severity=severity))
        else:
            consequence, certainty = rule.weight
            rules.append(msgspec.structs.replace(rule, consequence=consequence, certainty=certainty))
    return msgspec.structs.replace(manifest, rules=tuple(rules))


def hooks_of(plugin: object) -> tuple[str, ...]:
    """Return the names of the hooks that a plug-in has, in the order of scopes."""
    return tuple(hook for hook in HOOKS.values() if callable(getattr(plugin, hook, None)))


def check_manifest(manifest: Manifest, hooks: Collection[str], *, builtin: bool = False) -> tuple[Violation, ...]:
    """Return what is wrong with a manifest; empty when the plug-in may run.

    Args:
        manifest: what the plug-in declares.
        hooks: the names of the hooks it has.
        builtin: whether it comes with roslens and need not prefix its keys.
    """
    return (
        *_check_identity(manifest),
        *_check_scopes(manifest, hooks),
        *_check_languages(manifest),
        *_check_keys(manifest, builtin=builtin),
        *_check_options(manifest),
    )


def _check_identity(manifest: Manifest) -> Iterator[Violation]:
    if not _NAME.match(manifest.name):
        yield Violation(f"name is {manifest.name!r}", "lower case letters, digits and _, a letter first")
    if not manifest.version.strip():
        yield Violation("version is empty", "the version of the plug-in", "Results are kept by version")
    ours, theirs = _VERSION.match(INTERFACE_VERSION), _VERSION.match(manifest.interface)
    if ours is None or theirs is None:
        yield Violation(f"interface is {manifest.interface!r}", f"a version as {INTERFACE_VERSION!r}")
    elif theirs[1] != ours[1] or int(theirs[2]) > int(ours[2]):
        newer = (int(theirs[1]), int(theirs[2])) > (int(ours[1]), int(ours[2]))
        yield Violation(
            f"it is written for interface {manifest.interface}",
            f"{ours[1]}.0 to {INTERFACE_VERSION}",
            "Upgrade roslens" if newer else "Ask its author for a newer plug-in",
        )


def _check_scopes(manifest: Manifest, hooks: Collection[str]) -> Iterator[Violation]:
    if not manifest.scopes:
        yield Violation("scopes is empty", f"any of {', '.join(HOOKS)}")
    for scope in manifest.scopes:
        if scope not in HOOKS:
            yield Violation(f"scope {scope!r} is unknown", f"one of {', '.join(HOOKS)}", did_you_mean(scope, HOOKS))
        elif HOOKS[scope] not in hooks:
            yield Violation(f"it declares scope {scope!r} and has no {HOOKS[scope]}", "a hook for each scope")
    for scope, hook in HOOKS.items():
        if hook in hooks and scope not in manifest.scopes:
            yield Violation(f"it has {hook} and does not declare scope {scope!r}", "a scope for each hook")


def _check_languages(manifest: Manifest) -> Iterator[Violation]:
    for language in manifest.languages:
        if language not in _LANGUAGES:
            expected = f"one of {', '.join(_LANGUAGES)}"
            yield Violation(f"language {language!r} is unknown", expected, did_you_mean(language, _LANGUAGES))


def _check_keys(manifest: Manifest, *, builtin: bool) -> Iterator[Violation]:
    prefix = f"{manifest.name}."
    for kind, keys in (
        ("rule", [rule.id for rule in manifest.rules]),
        ("quantity", [quantity.key for quantity in manifest.quantities]),
    ):
        for key in sorted({key for key in keys if keys.count(key) > 1}):
            yield Violation(f"{kind} {key!r} is declared {keys.count(key)} times", "once")
        for key in keys:
            if not builtin and (not key.startswith(prefix) or key == prefix):
                yield Violation(f"{kind} {key!r} is not the plug-in's own", f"{prefix}…")
    for quantity in manifest.quantities:
        if not quantity.kinds:
            yield Violation(f"quantity {quantity.key!r} has no kinds", "the kinds of entity it is measured on")


def _check_options(manifest: Manifest) -> Iterator[Violation]:
    names = [option.name for option in manifest.options]
    for name in sorted({name for name in names if names.count(name) > 1}):
        yield Violation(f"option {name!r} is declared {names.count(name)} times", "once")
    for option in manifest.options:
        if option.type not in TYPES:
            yield Violation(f"option {option.name!r} has type {option.type!r}", f"one of {', '.join(TYPES)}")
        elif option.default is not None and (wrong := check_option(option, option.default)):
            yield Violation(f"option {option.name!r} has a default that is {wrong}", f"a default of type {option.type}")
