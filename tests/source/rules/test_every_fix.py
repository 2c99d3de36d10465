"""What every rule with a fix must have: said to whoever adds the next one.

Of each fixture of a rule (``tests/fixtures/rules``) that its edits change, ``tests/fixtures/fixes`` has, at the same
place, what they make of it; of a rule on packages the files that change. ``python -m source.rules.test_every_fix``
writes them, for somebody to read.
"""

from pathlib import Path

import pytest

from roslens.model.source import Language, SourceFile
from roslens.source.fix.chosen_fixes import chosen_fixes
from roslens.source.fix.edited_content import edited
from roslens.source.fix.still_parses import new_fault
from roslens.source.keys import content_hash
from roslens.source.parsed_file import parse_file
from roslens.source.rules.callbacks import callbacks_of
from roslens.source.rules.guard_style import ROS2, guard_name
from roslens.source.rules.hit import GUARD_NAME
from roslens.source.rules.match_file import match_file
from roslens.source.rules.package_findings import rule_findings
from roslens.source.rules.place_hits import place_hits
from roslens.source.rules.rule import FileRule, PackageRule
from roslens.source.rules.table import native_rules
from roslens.source.settings import MacroSettings, RuleSettings

FIXTURES = Path(__file__).parents[2] / "fixtures" / "rules"
FIXED = FIXTURES.parent / "fixes"
RULES = native_rules()
MENDING = [rule for rule in RULES.values() if rule.fix]
ENDINGS = {"cpp": ".cpp", "python": ".py"}
MOST_TURNS = 3


def fixtures_of(rule):
    family, name = rule.id.split(".")
    return sorted(one for one in (FIXTURES / family).rglob(f"{name}.*") if one.is_file())


def packages_of(rule):
    family, name = rule.id.split(".")
    return sorted(one.parent for one in (FIXTURES / family).rglob(f"{name}/*/package.xml"))


def findings_in(content, rule, name):
    """Return what a rule finds in a file, its edits placed."""
    language = Language.CPP if rule.syntax == "cpp" else Language.PYTHON
    view = parse_file(content, language, MacroSettings()).view()
    matched = match_file(view, frozenset({rule.id}))
    assert not matched.failures, matched.failures[0].detail
    found = place_hits({name: matched.hits}, callbacks_of(view), {rule.id: rule.severity}, RULES, ())
    return [placed(one, name) for one in found]


def placed(finding, name):
    import msgspec

    guard = guard_name(name, "robot", ROS2)
    edits = tuple(
        msgspec.structs.replace(edit, path=name, text=edit.text.replace(GUARD_NAME, guard)) for edit in finding.edits
    )
    return msgspec.structs.replace(finding, edits=edits)


def mended_file(content, rule, name):
    """Return a file with the fixes of a rule made, turn by turn; whatever it finds afterwards has no fix."""
    file = SourceFile(name, Language.CPP if rule.syntax == "cpp" else Language.PYTHON, size=0, content_hash="")
    for _ in range(MOST_TURNS):
        found = findings_in(content, rule, name)
        chosen = chosen_fixes(one for one in found if one.edits)
        if not chosen.made:
            return content
        after = edited(content, chosen.edits(name))
        assert not new_fault(file, content, after, MacroSettings())
        assert len(findings_in(after, rule, name)) == len(found) - len(chosen.made), "a finding is still there, or new"
        content = after
    raise AssertionError(f"the fix of {rule.id} comes to no end")


def mended_package(folder, rule, package_view, place):
    """Return the contents of the files of a package that the fixes of a rule change, by path."""
    import shutil

    if place != folder:
        shutil.copytree(folder, place, dirs_exist_ok=True)
    changed = {}
    for _ in range(MOST_TURNS):
        failures = []
        settings = RuleSettings(profiles=(), enable=(rule.id,))
        found = rule_findings(package_view(place), settings, {}, (), (), failures)
        assert not failures, failures[0].detail
        chosen = chosen_fixes(one for one in found if one.edits)
        if not chosen.made:
            return changed
        for path in chosen.paths:
            content = (place / path).read_bytes()
            assert {edit.made_for for edit in chosen.edits(path)} == {content_hash(content)}
            changed[path] = edited(content, chosen.edits(path))
            (place / path).write_bytes(changed[path])
        after = rule_findings(package_view(place), settings, {}, (), (), failures)
        assert len(after) == len(found) - len(chosen.made), "a finding is still there, or new"
    raise AssertionError(f"the fix of {rule.id} comes to no end")


@pytest.mark.parametrize("rule", [one for one in MENDING if isinstance(one, FileRule)], ids=lambda rule: rule.id)
def test_its_fixtures_become_what_is_expected(rule):
    seen = 0
    for fixture in fixtures_of(rule):
        content = fixture.read_bytes()
        after = mended_file(content, rule, fixture.name)
        expected = FIXED / fixture.relative_to(FIXTURES)
        if after != content or expected.exists():
            assert after.decode() == expected.read_text("utf-8"), f"{expected}: `python {__file__}` writes what is made"
            seen += 1
    assert seen, "no fixture shows its fix"


@pytest.mark.parametrize("rule", [one for one in MENDING if isinstance(one, PackageRule)], ids=lambda rule: rule.id)
def test_its_packages_become_what_is_expected(rule, package_view, tmp_path):
    seen = 0
    for folder in packages_of(rule):
        changed = mended_package(folder, rule, package_view, tmp_path / folder.name)
        expected = FIXED / folder.relative_to(FIXTURES)
        held = sorted(one.relative_to(expected).as_posix() for one in expected.rglob("*") if one.is_file())
        assert sorted(changed) == held, folder
        for path, content in changed.items():
            assert content.decode() == (expected / path).read_text("utf-8"), expected / path
        seen += bool(changed)
    assert seen, "no package shows its fix"


@pytest.mark.parametrize("rule", [one for one in MENDING if isinstance(one, FileRule)], ids=lambda rule: rule.id)
def test_its_bad_example_is_mended(rule):
    name = f"example{ENDINGS[rule.syntax]}" if "header" not in rule.tags else "example.hpp"
    if any(one.edits for one in findings_in(rule.bad.encode(), rule, name)):
        after = mended_file(rule.bad.encode(), rule, name)
        assert not [one for one in findings_in(after, rule, name) if one.edits]


@pytest.mark.parametrize("rule", RULES.values(), ids=lambda rule: rule.id)
def test_who_has_edits_says_what_they_do(rule):
    if isinstance(rule, FileRule):
        edits = [
            edit
            for one in fixtures_of(rule)
            for hit in findings_in(one.read_bytes(), rule, one.name)
            for edit in hit.edits
        ]
        assert bool(edits) == bool(rule.fix), "`fix` says what edits do, and only where there are any"
    assert not rule.fix or rule.fix.endswith("."), "`fix` is made of sentences"


def test_nothing_else_is_expected():
    homes = {one.id for one in MENDING}
    for path in FIXED.rglob("*"):
        if path.is_file():
            parts = path.relative_to(FIXED).parts
            assert any(f"{parts[0]}.{part.partition('.')[0]}" in homes for part in parts[1:]), path


def write():
    """Write what is made of every fixture."""
    import shutil
    import tempfile

    from conftest import package_view

    views = package_view.__wrapped__()
    shutil.rmtree(FIXED, ignore_errors=True)
    for rule in MENDING:
        if isinstance(rule, FileRule):
            for fixture in fixtures_of(rule):
                after = mended_file(fixture.read_bytes(), rule, fixture.name)
                if after != fixture.read_bytes():
                    target = FIXED / fixture.relative_to(FIXTURES)
                    target.parent.mkdir(parents=True, exist_ok=True)
                    target.write_bytes(after)
            continue
        for folder in packages_of(rule):
            with tempfile.TemporaryDirectory() as scratch:
                made = mended_package(folder, rule, views, Path(scratch) / folder.name)
            for path, content in made.items():
                target = FIXED / folder.relative_to(FIXTURES) / path
                target.parent.mkdir(parents=True, exist_ok=True)
                target.write_bytes(content)


if __name__ == "__main__":
    write()
