"""Unmodified HAROS plug-ins: every hook, everything they may ask, and what happens when they fail."""

import pytest

from roslens.model.finding import Severity
from roslens.plugins.discovery import discover
from roslens.plugins.isolation import run_plugins


@pytest.fixture
def found(member):
    return lambda *names: member(*(f"haros_plugin_{name}" for name in names))


def said(outcome, rule, **place):
    return [
        finding.message
        for finding in outcome.findings
        if finding.rule == rule and all(getattr(finding, key) == value for key, value in place.items())
    ]


def test_the_manifest_becomes_rules_and_quantities(found):
    (member,) = found("hooks")
    manifest = member.manifest
    assert (member.name, manifest.version, manifest.scopes) == ("haros_plugin_hooks", "0.3", ("workspace", "results"))
    assert manifest.languages == ("c", "cpp", "python", "launch_python")
    rules = {rule.id: rule for rule in manifest.rules}
    assert sorted(rules) == [
        "haros_plugin_hooks.asked",
        "haros_plugin_hooks.max_file_length_400",
        "haros_plugin_hooks.seen",
    ]
    seen = rules["haros_plugin_hooks.seen"]
    assert (seen.title, seen.description) == ("Seen", "A hook was called, and says so.")
    assert (seen.tags, seen.severity) == (("code-standards", "formatting"), Severity.NOTE)
    core = rules["haros_plugin_hooks.max_file_length_400"]
    assert (core.severity, core.tags[0]) == (Severity.WARNING, "metrics")
    ranges = {quantity.key: (quantity.minimum, quantity.maximum) for quantity in manifest.quantities}
    assert ranges == {
        "haros_plugin_hooks.ploc": (0, None),
        "haros_plugin_hooks.share": (0, 1),
        "haros_plugin_hooks.weight": (0, None),
    }


def test_every_hook_of_the_first_pass(found, make_workspace, tmp_path):
    outcome = run_plugins(found("hooks"), make_workspace("a.py", "b.cpp", "c.msg", artifacts=str(tmp_path / "kept")))
    seen = "haros_plugin_hooks.seen"
    assert said(outcome, seen, path="pack/a.py", line=2) == ["file_analysis", "in a function"]
    assert said(outcome, seen, path="pack/b.cpp", line=2) == ["file_analysis", "in a function"]
    assert not said(outcome, seen, path="pack/c.msg"), "its language is not listed"
    assert said(outcome, seen, path="pack/package.xml") == ["the manifest"]
    of_package = said(outcome, seen, entity="package:pack", path="")
    for text in (
        "package_analysis",
        "id package:pack",
        "found True",
        "meta False",
        "dependencies lib",
        "lines 10 sloc 7",
        "tier 2",
        "languages cpp,msg,package,python",
        "configuration None",
        "post_analysis: a.py,b.cpp",
        "resource: a resource",
        "made: True",
        "no scope: must provide a scope",
    ):
        assert text in of_package, text
    assert "tier 1" in said(outcome, seen, entity="package:lib")
    assert said(outcome, "haros_plugin_hooks.max_file_length_400") == ["a core rule"]
    assert (tmp_path / "kept" / "haros_plugin_hooks" / "made.txt").read_text() == "made in the temporary folder"


def test_values_find_their_entities(found, make_workspace):
    outcome = run_plugins(found("hooks"), make_workspace("a.py"))
    values = {(m.entity, m.quantity.partition(".")[2]): m.value for m in outcome.measurements}
    assert values == {
        ("function:pack/a.py#f()", "share"): 0.5,
        ("file:pack/a.py", "ploc"): 2,
        ("package:pack", "weight"): 2,
        ("package:lib", "weight"): 1,
    }
    assert any(
        failure.what == "1 values of haros_plugin_hooks.share name functions or classes that are not known"
        for failure in outcome.failures
    )


def test_what_haros_would_drop_or_die_of_is_a_failure(found, make_workspace):
    outcome = run_plugins(found("hooks"), make_workspace("wrong.py"))
    texts = [str(failure) for failure in outcome.failures]
    for expected in (
        "breaks the contract: rule 'haros_plugin_hooks.sean' is not declared",
        "breaks the contract: haros_plugin_hooks.share is 7; expected a number from 0 to 1",
        "rule 'haros_plugin_hooks:asked' is a query, which is not evaluated",
        "failed while running post_analysis: ValueError: 'seen' needs a configuration",
    ):
        assert any(expected in text for text in texts), expected


def test_the_second_pass_sees_what_all_reported(found, make_workspace):
    outcome = run_plugins(found("hooks", "second"), make_workspace("a.py", "b.cpp"), jobs=2)
    heard = "haros_plugin_second.heard"
    assert said(outcome, heard, path="pack/a.py") == ["haros_plugin_hooks:seen by Seen in a.py of pack, line 2"]
    of_package = said(outcome, heard, entity="package:pack", path="")
    assert "package violation in pack" in of_package
    assert "haros_plugin_hooks:weight = 3" in of_package
    assert "file violations: 7" in of_package
    values = {m.entity: m.value for m in outcome.measurements if m.quantity == "haros_plugin_second.most"}
    assert values == {"file:pack/a.py": 0.5, "file:pack/b.cpp": 0.5}
    assert "post_process: pre_analysis" in said(outcome, "haros_plugin_hooks.seen"), "both passes share a process"


def test_a_file_that_fails_loses_itself_alone(found, make_workspace):
    names = ("a.py", "dies.py", "exits.py", "hangs.py", "raises.py", "strange.py", "z.py")
    outcome = run_plugins(found("fragile"), make_workspace(*names), time_limit_s=1.0)
    seen = "haros_plugin_fragile.seen"
    for name in ("a.py", "z.py"):
        assert said(outcome, seen, path=f"pack/{name}") == ["after", "again: after", "again: before", "before"]
    assert said(outcome, seen, path="pack/raises.py") == ["again: before", "before"]
    assert said(outcome, seen, path="pack/strange.py") == ["after", "before"]
    assert said(outcome, seen, path="pack/dies.py") == []
    failures = {failure.location.path: failure.what.partition("running ")[2] for failure in outcome.failures}
    assert failures == {
        "pack/dies.py": "file_analysis pack/dies.py: its process ended with exit code 1",
        "pack/exits.py": "file_analysis pack/exits.py: it called sys.exit(1)",
        "pack/hangs.py": "file_analysis pack/hangs.py: it took longer than 1 s",
        "pack/raises.py": "file_analysis pack/raises.py: KeyError: 'no'",
        "pack/strange.py": "process_file_violation pack/strange.py: ValueError: strange",
    }
    assert said(outcome, seen, entity="package:pack", path="") == ["state: raises.py,strange.py,z.py"]


def test_messages_go_to_the_log(found, make_workspace, tmp_path):
    run_plugins(found("hooks"), make_workspace("a.py"), log=tmp_path / "log")
    log = (tmp_path / "log").read_text()
    for line in ("debug: looking at file:pack//a.py", "warning: nearly over", "error: an error to log"):
        assert f"haros_plugin_hooks: {line}" in log


@pytest.mark.parametrize(
    ("yaml", "plugin", "expected"),
    [
        ("name: [", "", "cannot read plugin.yaml: while parsing"),
        ("- a list", "", "plugin.yaml has no name or no version"),
        ("name: haros_plugin_x", "", "plugin.yaml has no name or no version"),
        ("name: haros_plugin_y\nversion: 1", "", "plugin.yaml has name: 'haros_plugin_y'"),
        ("name: haros_plugin_x\nversion: 1\nrules: [a]", "", "rules in plugin.yaml is a list"),
        ("name: haros_plugin_x\nversion: 1\nrules: {a: b}", "", "rules.a in plugin.yaml is 'b'"),
        ("name: haros_plugin_x\nversion: 1", "x = 1", "plugin.py has no hook"),
        ("name: haros_plugin_x\nversion: 1", "import no_such_module", "ModuleNotFoundError: No module named 'no_such"),
        ("name: haros_plugin_x\nversion: 1", None, "ModuleNotFoundError: No module named 'haros_plugin_x.plugin'"),
    ],
)
def test_what_is_no_haros_plugin_is_told(yaml, plugin, expected, tmp_path):
    folder = tmp_path / "haros_plugin_x"
    folder.mkdir()
    (folder / "plugin.yaml").write_text(yaml)
    if plugin is not None:
        (folder / "plugin.py").write_text(plugin)
    found = discover(["haros_plugin_x"], base=tmp_path, search=())
    assert not found.members
    (failure,) = found.failures
    assert failure.what.startswith(f"plug-in 'haros_plugin_x' would not load: {expected}")


def test_installed_ones_are_found_by_name(fixtures, tmp_path):
    found = discover([], base=tmp_path, search=[str(fixtures)], disable=["fragile"])
    names = [member.name for member in found.members]
    assert names == ["haros_plugin_hooks", "haros_plugin_second"]
    assert found.members[0].origin == "HAROS plug-in haros_plugin_hooks"
