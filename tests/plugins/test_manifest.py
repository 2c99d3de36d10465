"""A manifest that cannot work is reported with what it says and what it should say."""

import msgspec
import pytest

from roslens.model.entity import EntityKind
from roslens.model.finding import RuleInfo, Severity
from roslens.model.quantity import Quantity
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.plugins.manifest import check_manifest, hooks_of, read_manifest
from roslens.plugins.points import Manifest, Option

GOOD = Manifest(
    "mine",
    "1.0",
    "2.3",
    languages=("cpp",),
    rules=(RuleInfo("mine.a", "A", "An a."),),
    quantities=(Quantity("mine.b", "B", "1", (EntityKind.FILE,), "A b."),),
    options=(Option("c", "int", "A c.", default=1),),
)


def breaches(builtin=False, hooks=("analyse_file",), **changes):
    manifest = msgspec.structs.replace(GOOD, **changes)
    return [
        f"{breach.what}; {breach.expected}. {breach.advice}"
        for breach in check_manifest(manifest, hooks, builtin=builtin)
    ]


def test_a_good_one_has_no_breaches():
    assert breaches() == []


RULE = RuleInfo("mine.a", "A", "An a.")
FOREIGN = RuleInfo("loc", "A", "An a.")


@pytest.mark.parametrize(
    ("changes", "expected"),
    [
        ({"name": "My Plug"}, "name is 'My Plug'; lower case letters"),
        ({"name": ""}, "name is ''"),
        ({"version": " "}, "version is empty"),
        ({"interface": "one"}, "interface is 'one'; a version as '1.0'"),
        ({"interface": "1.7"}, "it is written for interface 1.7; 1.0 to 1.0. Upgrade roslens"),
        ({"interface": "0.9"}, "it is written for interface 0.9; 1.0 to 1.0. Ask its author"),
        ({"scopes": ()}, "scopes is empty"),
        (
            {"scopes": ("fiel",)},
            "scope 'fiel' is unknown; one of file, package, repository, workspace, results, configuration. Did",
        ),
        ({"hooks": ()}, "it declares scope 'file' and has no analyse_file"),
        ({"languages": ("c++",)}, "language 'c++' is unknown"),
        ({"rules": (RULE, RULE)}, "rule 'mine.a' is declared 2 times; once"),
        ({"rules": (FOREIGN,)}, "rule 'loc' is not the plug-in's own; mine.…"),
        ({"quantities": (Quantity("mine.b", "B", "1", (), "A b."),)}, "quantity 'mine.b' has no kinds"),
        (
            {"options": (Option("c", "integer", "A c."),)},
            "option 'c' has type 'integer'; one of str, int, float, bool, list",
        ),
        ({"options": (Option("c", "int", "A c.", default="1"),)}, "option 'c' has a default that is '1' (str)"),
        ({"options": (Option("c", "int", "A c."),) * 2}, "option 'c' is declared 2 times"),
    ],
)
def test_what_is_wrong_is_told(changes, expected):
    assert any(breach.startswith(expected) for breach in breaches(**changes)), breaches(**changes)


def test_built_in_plugins_need_no_prefix():
    assert breaches(rules=(FOREIGN,), builtin=True) == []


class Plugin:
    manifest = GOOD

    def analyse_file(self, file, report):
        pass

    analyse_package = None


@pytest.mark.parametrize(
    ("plugin", "expected"),
    [
        (Plugin, "it is the class Plugin"),
        (object(), "it has no `manifest`"),
        (type("P", (), {"manifest": {"name": "x"}})(), "it has a `manifest` that is a dict"),
        (type("P", (), {"manifest": msgspec.structs.replace(GOOD, rules=("a",))})(), "its manifest does not fit"),
        (type("P", (), {"manifest": msgspec.structs.replace(GOOD, text=object())})(), "its manifest does not fit"),
    ],
)
def test_what_has_no_manifest_is_told(plugin, expected):
    breach = read_manifest(plugin)
    assert not isinstance(breach, Manifest)
    assert breach.what.startswith(expected)


def test_hooks_are_what_can_be_called():
    read = read_manifest(Plugin())
    assert isinstance(read, Manifest)
    assert msgspec.structs.replace(read, rules=GOOD.rules) == GOOD
    assert hooks_of(Plugin()) == ("analyse_file",)


@pytest.mark.parametrize(
    ("declared", "severity", "weight"),
    [
        ({"severity": Severity.NOTE}, Severity.NOTE, (Consequence.HARD_TO_MAINTAIN, Certainty.LIKELY)),
        ({}, Severity.WARNING, (Consequence.MAY_BE_WRONG, Certainty.LIKELY)),
        ({"severity": Severity.ERROR}, Severity.ERROR, (Consequence.WRONG, Certainty.PROVEN)),
        (
            {"severity": Severity.ERROR, "consequence": Consequence.STYLE, "certainty": Certainty.PROVEN},
            Severity.NOTE,
            (Consequence.STYLE, Certainty.PROVEN),
        ),
        (
            {"consequence": Consequence.WRONG, "certainty": Certainty.HEURISTIC, "unproven": True},
            Severity.NOTE,
            (Consequence.WRONG, Certainty.HEURISTIC),
        ),
        (
            {"severity": Severity.NOTE, "consequence": Consequence.WRONG},
            Severity.NOTE,
            (Consequence.HARD_TO_MAINTAIN, Certainty.LIKELY),
        ),
    ],
)
def test_a_rule_has_the_severity_that_follows_from_its_weight(declared, severity, weight):
    plugin = type("P", (), {})()
    plugin.manifest = msgspec.structs.replace(GOOD, rules=(RuleInfo("mine.a", "A", "An a.", **declared),))
    read = read_manifest(plugin)
    assert isinstance(read, Manifest)
    assert (read.rules[0].severity, read.rules[0].weight) == (severity, weight)
