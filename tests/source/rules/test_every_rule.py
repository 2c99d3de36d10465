"""What every native rule must have: said to whoever adds the next one.

A rule on files has ``tests/fixtures/rules/<family>/<module>.<ending>``, and more as ``<module>.<case>.<ending>``, in
the folders in which modules are below the family.
A line that it reports ends with a comment ``flagged``; where a comment would disturb, the file says
``flagged lines: 3, 7`` anywhere. What is not marked must not be reported. A rule on packages has a folder
``<module>`` of packages, each with a file ``flagged`` of lines ``path:line``, none for a package in order.
"""

import json
import re
from pathlib import Path

import pytest
from tree_sitter import Language as Grammar
from tree_sitter import Query

from roslens.model.source import Language
from roslens.source.parsed_file import parse_file
from roslens.source.rules.callbacks import callbacks_of
from roslens.source.rules.match_file import MOST_HITS, match_file
from roslens.source.rules.package_findings import rule_findings
from roslens.source.rules.place_hits import place_hits
from roslens.source.rules.profiles import PROFILES
from roslens.source.rules.rule import FileRule, PackageRule
from roslens.source.rules.table import FAMILIES, native_rules, rule_modules
from roslens.source.settings import MacroSettings, RuleSettings

FIXTURES = Path(__file__).parents[2] / "fixtures" / "rules"
RULES = native_rules()
FILE_RULES = [rule for rule in RULES.values() if isinstance(rule, FileRule)]
PACKAGE_RULES = [rule for rule in RULES.values() if isinstance(rule, PackageRule)]
ENDINGS = {"cpp": ".cpp", "python": ".py"}
BUILDS = ("CMakeLists.txt", "setup.py", "setup.cfg")
STRANGE = (b"", bytes(range(256)) * 4, b"x", "café\n".encode("latin-1"), b"(" * 3000, b"if (x) {\n", b"class :\n def")


def found_in(content, syntax, path, rule):
    """Return the lines at which the rule reports, as a user would see them."""
    language = Language.CPP if syntax == "cpp" else Language.PYTHON
    view = parse_file(content, language, MacroSettings()).view()
    matched = match_file(view)
    assert not matched.failures, matched.failures[0].detail
    selection = {rule.id: rule.severity}
    return [one.line for one in place_hits({path: matched.hits}, callbacks_of(view), selection, RULES, ())]


def marked(text):
    lines = [
        number
        for number, line in enumerate(text.splitlines(), 1)
        if re.search(r"(//|#|\*)\s*flagged\b(?! lines)", line)
    ]
    for match in re.finditer(r"flagged lines: ([\d, ]+)", text):
        lines += map(int, match[1].split(","))
    return sorted(lines)


def fixtures_of(rule):
    family, name = rule.id.split(".")
    found = {*(FIXTURES / family).rglob(f"{name}.*")}
    if (FIXTURES / family / name).is_dir():
        found |= {one for one in (FIXTURES / family / name).rglob("*") if one.is_file()}
    return sorted(found)


@pytest.mark.parametrize("rule", FILE_RULES, ids=lambda rule: rule.id)
def test_it_reports_what_its_fixture_marks_and_nothing_else(rule):
    fixtures = fixtures_of(rule)
    flagged = 0
    for fixture in fixtures:
        expected = marked(fixture.read_text("utf-8"))
        flagged += len(expected)
        assert sorted(set(found_in(fixture.read_bytes(), rule.syntax, fixture.name, rule))) == sorted(set(expected)), (
            fixture
        )
    assert flagged, (
        f"no line of {[one.name for one in fixtures]} is marked: add tests/fixtures/rules/{rule.id.replace('.', '/')}.…"
    )


@pytest.mark.parametrize("rule", PACKAGE_RULES, ids=lambda rule: rule.id)
def test_it_reports_what_its_packages_mark_and_nothing_else(rule, package_view):
    family, name = rule.id.split(".")
    folders = sorted(one.parent for one in (FIXTURES / family).rglob(f"{name}/*/package.xml"))
    assert folders, f"add packages in tests/fixtures/rules/{family}/{name}/"
    flagged = 0
    for folder in folders:
        marks = folder / "flagged"
        expected = sorted(marks.read_text().split()) if marks.is_file() else []
        flagged += len(expected)
        failures = []
        settings = RuleSettings(profiles=(), enable=(rule.id,))
        found = rule_findings(package_view(folder), settings, {}, (), (), failures)
        assert not failures, failures[0].detail
        assert sorted(f"{one.path}:{one.line}" for one in found) == expected, folder
    assert flagged, f"no package below {FIXTURES / family / name} has a file `flagged`"


@pytest.mark.parametrize("rule", FILE_RULES, ids=lambda rule: rule.id)
def test_its_examples_show_it(rule):
    name = f"example{ENDINGS[rule.syntax]}" if "header" not in rule.tags else "example.hpp"
    assert found_in(rule.bad.encode(), rule.syntax, name, rule), "`bad` is not reported"
    assert not found_in(rule.good.encode(), rule.syntax, name, rule), "`good` is reported"


@pytest.mark.parametrize("rule", RULES.values(), ids=lambda rule: rule.id)
def test_it_says_what_a_reader_asks(rule):
    for part in ("title", "finds", "why", "bad", "good"):
        assert getattr(rule, part).strip(), f"{rule.id} has no {part}"
    assert rule.finds.endswith("."), "`finds` is made of sentences"
    assert not rule.title.endswith("."), "`title` is a heading"
    assert set(rule.profiles) <= PROFILES.keys(), f"unknown profile: one of {', '.join(PROFILES)}"
    assert rule.family in FAMILIES


@pytest.mark.parametrize("rule", FILE_RULES, ids=lambda rule: rule.id)
def test_something_makes_it_look(rule):
    assert rule.anchors or rule.kinds or rule.quoted or rule.whole, "name `anchors`, `kinds`, `quoted` or `whole`"
    assert rule.whole or not rule.words, "`words` go with `whole`; for the others `anchors` do the same"
    if rule.found_among is not None:
        others = (rule.anchors, rule.quoted, rule.whole)
        assert rule.kinds, "`found_among` is asked about nodes of `kinds`"
        assert not any(others), "`found_among` is asked about nodes of `kinds` alone"
        assert not list(rule.found(None, None)), "`found_among` stands for `found`"
    import tree_sitter_cpp
    import tree_sitter_python

    grammar = Grammar((tree_sitter_cpp if rule.syntax == "cpp" else tree_sitter_python).language())
    for kind in (*rule.kinds, *rule.gathers):
        if kind.startswith("("):
            assert "@node" in kind, f"{kind!r} has no node that is meant"
            Query(grammar, kind)
        else:
            assert grammar.id_for_node_kind(kind, True), f"{kind!r} is no type of node of the {rule.syntax} grammar"


def test_each_module_is_named_after_its_rule():
    homes = {f"{name.split('.')[3]}.{name.rpartition('.')[2]}" for name in rule_modules()}
    assert RULES.keys() <= homes, f"a rule's id is its family and the name of its module: {RULES.keys() - homes}"


def test_no_profile_contradicts_itself():
    for rule in RULES.values():
        for other in rule.unlike:
            assert other in RULES, f"{rule.id} is unlike {other}, which is no rule"
            assert not set(rule.profiles) & set(RULES[other].profiles), f"{rule.id} and {other} are on together"


@pytest.mark.parametrize("content", STRANGE, ids=range(len(STRANGE)))
@pytest.mark.parametrize("language", [Language.CPP, Language.PYTHON])
def test_strange_files_break_no_rule(content, language):
    matched = match_file(parse_file(content, language, MacroSettings()).view())
    assert not matched.failures, matched.failures[0].detail


@pytest.mark.parametrize("content", STRANGE, ids=range(len(STRANGE)))
def test_strange_packages_break_no_rule(content, package_view, tmp_path):
    manifest = (
        "<package><name>odd</name><depend>pluginlib</depend><export><build_type>{}</build_type></export></package>"
    )
    for build_type in ("ament_cmake", "ament_python", "catkin"):
        folder = tmp_path / build_type
        for name in (
            *BUILDS,
            "launch/a.launch",
            "launch/b.launch.py",
            "config/a.yaml",
        ):
            path = folder / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)
        (folder / "a.cpp").write_bytes(b"PLUGINLIB_EXPORT_CLASS(" + content)
        (folder / "plugins.xml").write_bytes(b"<library base_class_type" + content)
        (folder / "package.xml").write_text(manifest.format(build_type))
        failures = []
        rule_findings(package_view(folder), RuleSettings(profiles=(), enable=("*",)), {}, (), (), failures)
        assert not failures, failures[0].detail


def test_what_grows_without_bound_is_cut(package_view, tmp_path):
    (tmp_path / "config").mkdir()
    (tmp_path / "package.xml").write_text("<package><name>vast</name></package>")
    (tmp_path / "config/a.yaml").write_text("a: /home/ada/map.yaml\n" * 5_000)
    twice = 'set(V{0} "${{V{1}}}${{V{1}}}")\nlist(APPEND L ${{L}} ${{V{0}}} a{0})\n'
    doubled = "".join(twice.format(number, number - 1) for number in range(1, 60))
    build = f"set(V0 text)\nset(L a b c)\n{doubled}add_executable(${{L}}${{L}}${{L}})\n"
    (tmp_path / "CMakeLists.txt").write_text(build)
    failures = []
    view = package_view(tmp_path)
    found = rule_findings(view, RuleSettings(profiles=(), enable=("*",)), {}, (), (), failures)
    assert not failures
    assert sum(one.rule == "launch.absolute_path" for one in found) == MOST_HITS
    assert max(len(word) for one in view.cmake.commands for word in one.words) < 100_000


def test_a_package_is_analysed_anew_when_a_file_without_language_comes(tmp_path, capsys):
    from roslens.cli.main import main

    folder = tmp_path / "arm"
    (folder / "arm").mkdir(parents=True)
    (folder / "package.xml").write_text(
        '<package format="3"><name>arm</name><version>1.0.0</version><description>d</description>'
        '<maintainer email="a@example.org">a</maintainer><license file="LICENSE">MIT</license>'
        "<export><build_type>ament_python</build_type></export></package>"
    )

    def rules():
        main(["check", str(tmp_path), "--jobs", "1", "-q", "--fail-on", "never", "--format", "json"])
        return {one["rule"] for one in json.loads(capsys.readouterr().out)["findings"]}

    assert "package.licence_file" in rules()
    (folder / "LICENSE").write_text("text")
    assert "package.licence_file" not in rules()
