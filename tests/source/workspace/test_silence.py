"""Comments, [[ignore]] and accepted findings: what counts, what does not, and what is wrong with them."""

import pytest

from roslens.model.finding import Finding, RuleInfo, Severity
from roslens.model.set_aside import Disposition
from roslens.source.settings import IgnoreRule
from roslens.source.workspace.acceptances import Acceptance, Acceptances, read_acceptances, to_toml
from roslens.source.workspace.silence import Nameable, Silence, about_comments
from roslens.source.workspace.suppress import suppressions


def finding(rule="ros.calls.max", path="src/a.cpp", line=3, **more):
    more.setdefault("message", "calls are 12; at most 10")
    more.setdefault("fingerprint", f"{rule}{path}{line}")
    return Finding(rule, Severity.WARNING, path=path, line=line, **more)


def states(silence, *findings, comments=None, **more):
    found = silence.sorted_out(findings, comments or {}, **more)
    return [(one.state.value, one.reason, one.by) for one in found.set_aside], len(found.kept)


def test_a_comment_sets_aside_and_gives_its_reason():
    comments = {"src/a.cpp": suppressions(b"\n\nf(); // roslens: ignore[calls.max] generated table\n")}
    assert states(Silence(), finding(), finding(line=4), comments=comments) == (
        [("suppressed", "generated table", "src/a.cpp:3")],
        1,
    )


def test_a_witness_may_be_named():
    comments = {"src/a.cpp": suppressions(b"\n\nf(); // NOLINT(runtime/int)\n")}
    assert states(Silence(), finding(witnesses=("cpplint.runtime/int",)), comments=comments)[1] == 0
    assert states(Silence(), finding(), comments=comments)[1] == 1


@pytest.mark.parametrize(
    ("paths", "rules", "count"),
    [
        (("src/*.cpp",), (), 1),
        ((), ("ros.calls.*",), 1),
        ((), ("complexity",), 1),
        (("src/*.cpp",), ("ros.cbo.max",), 0),
        (("other/**",), ("ros.calls.max",), 0),
    ],
)
def test_globs_and_rules(paths, rules, count):
    silence = Silence((IgnoreRule("x", ("nowhere/**",)), IgnoreRule("legacy", paths, rules)))
    found = states(silence, finding(tags=("complexity",)))
    assert found == ([("ignored", "legacy", "[[ignore]] 2")] * count, 1 - count)


def test_a_finding_of_a_package_is_matched_by_its_folder():
    silence = Silence((IgnoreRule("legacy", ("src/old",)),))
    assert states(silence, finding(path=""), folder="src/old")[1] == 0
    assert states(silence, finding(path=""), folder="src/new")[1] == 1
    assert states(silence, finding(path=""))[1] == 1


ENTRY = Acceptance(
    "0" * 16,
    "known",
    Disposition.FALSE_POSITIVE,
    "ros.calls.max",
    "src/a.cpp",
    "function:src/a.cpp#f()",
    "calls are 12; at most 10",
)


def of(entry, path, files, **more):
    more.setdefault("entity", f"function:{path}#f()")
    return Acceptances((entry,), files).of(finding(path=path, fingerprint="1", **more))


def test_accepted_by_fingerprint():
    accepted = Acceptances((ENTRY,), ("src/a.cpp",))
    assert states(Silence((), accepted), finding(fingerprint="0" * 16)) == ([("false_positive", "known", "0" * 16)], 0)
    assert states(Silence((), accepted), finding(fingerprint="1" * 16))[1] == 1


def test_accepted_in_a_file_that_moved():
    assert of(ENTRY, "lib/a.cpp", ("lib/a.cpp",)) is ENTRY
    assert of(ENTRY, "ws/src/a.cpp", ("ws/src/a.cpp", "lib/a.cpp")) is ENTRY
    assert of(ENTRY, "lib/a.cpp", ("lib/a.cpp",), message="calls are 13; at most 10") is ENTRY


@pytest.mark.parametrize(
    ("path", "files", "more"),
    [
        ("lib/a.cpp", ("lib/a.cpp", "src/a.cpp"), {}),
        ("lib/a.cpp", ("lib/a.cpp", "other/a.cpp"), {}),
        ("lib/b.cpp", ("lib/b.cpp",), {}),
        ("lib/a.cpp", ("lib/a.cpp",), {"entity": "function:lib/a.cpp#g()"}),
        ("lib/a.cpp", ("lib/a.cpp",), {"rule": "ros.cbo.max"}),
        ("lib/a.cpp", ("lib/a.cpp",), {"message": "something else"}),
    ],
)
def test_what_is_not_clearly_the_same_counts(path, files, more):
    assert of(ENTRY, path, files, **more) is None


def test_the_file_is_read_as_it_was_written(tmp_path):
    entries = (ENTRY, Acceptance("2" * 16, 'a "quoted"\x7f \\ line', rule="x"))
    place = tmp_path / "roslens.accepted.toml"
    place.write_text(to_toml(entries))
    assert read_acceptances(place) == (tuple(sorted(entries, key=lambda one: one.path)), ())


@pytest.mark.parametrize(
    ("text", "said", "kept"),
    [
        ("[[accepted]\n", "cannot be read", 0),
        ('[[accepted]]\nfingerprint = "a"\nreason = "x"\n[[accepted]]\nfingerprint = "b"\n', "[[accepted]] 2", 1),
        ('[[accepted]]\nfingerprint = "a"\nreason = " "\n', "no reason", 0),
        ('[[accepted]]\nfingerprint = "a"\nreason = "x"\nstate = "ignored"\n', "neither accepted", 0),
        ("acepted = []\n", 'unknown key "acepted"', 0),
        ("accepted = 3\n", "not a list of tables", 0),
        ("\ufeff", None, 0),
        (None, None, 0),
    ],
)
def test_a_wrong_entry_costs_no_other(tmp_path, text, said, kept):
    place = tmp_path / "roslens.accepted.toml"
    if text is not None:
        place.write_text(text)
    entries, failures = read_acceptances(place)
    assert len(entries) == kept
    assert [said in one.what for one in failures] == ([True] if said else [])


RULES = (
    RuleInfo("ros.calls.max", "t", "d", tags=("complexity",)),
    RuleInfo("cpp.goto", "t", "d", tags=("cpp",)),
    RuleInfo("graph.qos", "t", "d"),
)
NAMEABLE = Nameable(RULES, frozenset({"ros.calls.max"}), frozenset({"cpplint"}))


@pytest.mark.parametrize(
    ("comment", "expected"),
    [
        (b"roslens: ignore[calls.max] why", ["suppression_unused"]),
        (b"roslens: ignore[complexity]", ["suppression_unused", "suppression_without_reason"]),
        (b"roslens: ignore[cals.max] why", ["suppression_unknown"]),
        (b"roslens: ignore[cpp.goto] a rule that did not run", []),
        (b"roslens: ignore[graph.qos] of the graph", []),
        (b"roslens: ignore why", []),
        (b"roslens: ignore[cpplint.runtime/int] of a tool", []),
        (b"NOLINT(calls.max)", []),
        (b"noqa: E501", []),
    ],
)
def test_what_is_wrong_with_a_comment(comment, expected):
    comments = {"a.cpp": suppressions(b"x // " + comment)}
    assert comments["a.cpp"]
    found = list(about_comments(comments, [], NAMEABLE))
    assert [one.rule for one in found] == [f"roslens.{name}" for name in expected]
    assert {(one.path, one.line, one.severity) for one in found} <= {("a.cpp", 1, Severity.NOTE)}


def test_an_unknown_id_is_corrected():
    (one,) = about_comments({"a.cpp": suppressions(b"x // roslens: ignore[ros.cals.max] why")}, [], NAMEABLE)
    assert one.message.endswith('no rule of this run has the id or tag "ros.cals.max"; did you mean ros.calls.max?')


def test_what_is_used_is_not_unused():
    comments = {"src/a.cpp": suppressions(b"x\n\ny // roslens: ignore[calls.max] why\n")}
    assert list(about_comments(comments, [finding()], NAMEABLE)) == []


def test_two_alike_have_two_fingerprints():
    comments = {"a.cpp": suppressions(b"// roslens: ignore[calls.max] a\n// roslens: ignore[calls.max] a\n")}
    first, second = about_comments(comments, [], NAMEABLE)
    assert first.fingerprint != second.fingerprint


def test_what_has_no_effect_is_noted():
    silence = Silence(
        (IgnoreRule("legacy", ("src/old/**",)), IgnoreRule("g", (), ("graph.*",))), Acceptances((ENTRY,), ())
    )
    found = silence.without_effect((), "roslens.toml", "", {"ros.calls.max"})
    assert [(one.rule, one.path) for one in found] == [
        ("roslens.ignore_unused", "roslens.toml"),
        ("roslens.acceptance_unused", ""),
    ]
    assert silence.without_effect(("[[ignore]] 1", "0" * 16), "roslens.toml", "", {"ros.calls.max"}) == ()
    # An entry of a rule that this run does not have may be of use to another one.
    assert len(silence.without_effect((), "", "", ())) == 1
