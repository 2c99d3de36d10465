"""What is new since a baseline: fingerprints first, then what a finding says where its code or its file moved."""

import pytest

from roslens.compare.known_findings import since_baseline
from roslens.model.finding import Finding, Severity, fingerprint
from roslens.model.same_finding import key_of_finding


def of(path, function="f()", message="calls are 12; at most 10", rule="ros.calls.max", line=3, context=""):
    entity = f"function:{path}#{function}" if function else f"file:{path}"
    return Finding(
        rule, Severity.WARNING, message, path, line, entity=entity, fingerprint=fingerprint(rule, entity, context)
    )


def new(before, after, files=(), renamed=None):
    found = since_baseline(before, after, files, renamed)
    return [one for one in after if key_of_finding(one) in found.new], found.gone


OLD = of("src/a.cpp")


@pytest.mark.parametrize(
    ("now", "files", "renamed"),
    [
        (of("src/a.cpp", line=90), ("src/a.cpp",), {}),
        (of("src/a.cpp", message="calls are 15; at most 10"), ("src/a.cpp",), {}),
        (of("lib/a.cpp"), ("lib/a.cpp",), {}),
        (of("src/b.cpp"), ("src/b.cpp",), {"src/a.cpp": "src/b.cpp"}),
        (of("src/other.cpp", message="calls are 13; at most 10"), ("src/a.cpp", "src/other.cpp"), {}),
    ],
)
def test_the_same_finding(now, files, renamed):
    assert new([OLD], [now], files, renamed) == ([], 0)


@pytest.mark.parametrize(
    "now",
    [
        of("src/a.cpp", function="g()"),
        of("src/a.cpp", rule="ros.cbo.max"),
        of("src/b.cpp", message="another message"),
    ],
)
def test_another_finding(now):
    assert new([OLD], [now], ("src/a.cpp", "src/b.cpp")) == ([now], 1)


def test_a_copy_is_new():
    copy = of("src/copy.cpp")
    assert new([OLD], [OLD, copy], ("src/a.cpp", "src/copy.cpp")) == ([copy], 0)


def test_one_of_the_baseline_is_one_now():
    first, second = of("lib/a.cpp"), of("more/a.cpp")
    assert new([OLD], [first, second], ("lib/a.cpp", "more/a.cpp")) == ([second], 0)


def test_a_finding_about_a_file_moves_with_it_alone():
    old, moved = of("src/a.cpp", ""), of("lib/a.cpp", "")
    assert new([old], [moved], ("lib/a.cpp",)) == ([], 0)
    assert new([old], [moved], ("lib/a.cpp", "src/a.cpp")) == ([moved], 1)
    other = of("lib/b.cpp", "")
    assert new([old], [other], ("lib/b.cpp",)) == ([other], 1)
    assert new([old], [other], ("lib/b.cpp",), {"src/a.cpp": "lib/b.cpp"}) == ([], 0)


def test_what_is_gone_is_counted():
    assert new([OLD, of("src/a.cpp", "h()")], [OLD], ("src/a.cpp",)) == ([], 1)
    assert new([], [OLD], ()) == ([OLD], 0)
