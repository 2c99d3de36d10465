"""The kit passes what keeps the contract and tells the author of anything else what to add."""

import pytest

from roslens.model.errors import PluginError
from roslens.plugins.contract import assert_plugin, check_plugin, look_at


def test_a_plugin_that_keeps_the_contract_passes(fixtures):
    assert_plugin(fixtures / "orderly.py", fixtures / "kit")


def test_everything_that_is_missing_is_told_with_what_to_add(fixtures):
    problems = check_plugin(fixtures / "careless.py", fixtures / "careless_kit")
    for expected in (
        "manifest has no text: state the purpose of the plug-in in one line",
        "rule careless.word has no rationale: add why it matters to a robot's code",
        "rule careless.word only repeats its title",
        "quantity careless.never has no unit: add its unit, `1` for a ratio",
        "quantity careless.never has no formula: add how it is counted",
        "option depth has no text: add what it changes",
        "on a strange file: binary.py: plug-in 'careless' failed while running analyse_file: UnicodeDecodeError",
        "rule careless.word has no triggers fixture: add word/triggers… in which it occurs",
        "rule careless.word finds \"words ['",
        "two runs over word/clean.py differ: sort what comes out of sets, leave times out",
        "quantity careless.never is never measured: add values/… for which it has a value",
    ):
        assert any(problem.startswith(expected) for problem in problems), (expected, problems)
    with pytest.raises(AssertionError, match=r"careless.py does not keep the contract:\n- manifest has no text"):
        assert_plugin(fixtures / "careless.py")


def test_a_rule_that_finds_nothing_is_told(fixtures):
    problems = check_plugin(fixtures / "orderly.py", fixtures / "kit", options={"word": "nowhere"})
    assert problems == (
        "rule orderly.word finds nothing in word/triggers.cpp: it must find what the fixture shows",
        "rule orderly.many finds nothing in many/triggers.py: it must find what the fixture shows",
    )


def test_a_plugin_without_fixtures_is_told(fixtures):
    assert check_plugin(fixtures / "orderly.py") == (
        "no fixtures: give a folder with triggers… and clean… below the name of each rule",
    )


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("raises_at_import.py", "plug-in 'raises_at_import' would not load: RuntimeError: not today"),
        ("without_manifest.py", "plug-in 'without_manifest' breaks the contract: it has no `manifest`"),
    ],
)
def test_a_plugin_that_does_not_load_is_told(name, expected, fixtures):
    (problem,) = check_plugin(fixtures / name)
    assert problem.startswith(expected)
    with pytest.raises(PluginError):
        look_at(fixtures / name, fixtures)
    assert check_plugin("no.such.module")[0].startswith("plug-in 'no.such.module' would not load: ModuleNotFoundError")


def test_single_values_can_be_looked_at(fixtures):
    outcome = look_at(fixtures / "orderly.py", fixtures / "kit" / "many" / "triggers.py")
    assert [(m.entity, m.value) for m in outcome.measurements] == [("file:triggers.py", 3.0)]
    whole = look_at(fixtures / "orderly.py", fixtures / "kit", options={"most": 100})
    assert {finding.path for finding in whole.findings} == {"word/triggers.cpp", "many/triggers.py"}
