"""All native rules: every module below ``source/rules/<family>`` that has a ``RULE``."""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Iterator, Mapping
from functools import cache

import roslens.source.rules as home
from roslens.source.rules.rule import FileRule, PackageRule, Rule

FAMILIES = ("node", "cpp", "python", "package", "cmake", "launch", "distribution")
"""Folders with rules, each the first part of its rules' ids."""


@cache
def native_rules() -> Mapping[str, Rule]:
    """Return all native rules by their id, sorted.

    Raises:
        TypeError: two modules declare one id.
    """
    found: dict[str, Rule] = {}
    for name in sorted(rule_modules()):
        rule = getattr(importlib.import_module(name), "RULE", None)
        if not isinstance(rule, Rule):
            continue
        if rule.id in found:
            raise TypeError(f"two modules declare rule {rule.id!r}; the second is {name}")
        found[rule.id] = rule
    return dict(sorted(found.items()))


@cache
def file_rules(syntax: str) -> tuple[FileRule, ...]:
    """Return the rules that read files of a syntax."""
    return tuple(rule for rule in native_rules().values() if isinstance(rule, FileRule) and rule.syntax == syntax)


@cache
def package_rules() -> tuple[PackageRule, ...]:
    """Return the rules that read packages."""
    return tuple(rule for rule in native_rules().values() if isinstance(rule, PackageRule))


def rule_modules() -> Iterator[str]:
    """Yield the full names of the modules below the families."""
    for family in FAMILIES:
        for path in home.__path__:
            yield from _modules(f"{path}/{family}", f"{home.__name__}.{family}")


def _modules(folder: str, package: str) -> Iterator[str]:
    for module in pkgutil.iter_modules([folder]):
        name = f"{package}.{module.name}"
        if module.ispkg:
            yield from _modules(f"{folder}/{module.name}", name)
        else:
            yield name
