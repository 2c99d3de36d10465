"""Layout is one line a package."""

from roslens.model.finding import Finding, Severity
from roslens.model.source import Location, Package
from roslens.source.tools.running.layout import layout_folded

PACKAGE = Package("arm", "arm", "src/arm", Location("src/arm/package.xml"))


def finding(path="src/arm/a.cpp", rule="cpplint.whitespace/tab", gated=True, tags=("layout",)):
    return Finding(rule, Severity.NOTE, "m", path, 3, tags=tags, gated=gated)


def test_all_of_a_package_are_one():
    other = finding(rule="cpplint.runtime/int", tags=())
    given = [finding(), other, *[finding("src/arm/b.py", "ruff.E501")] * 3]
    kept, one = layout_folded(given, PACKAGE)
    assert kept == other
    assert one.message == "4 layout findings in 2 files: run clang-format and ruff format"
    assert (one.rule, one.path, one.entity) == ("layout.differs", "src/arm/package.xml", "package:arm")
    assert one.others == ("src/arm/b.py: 3 (ruff.E501 x 3)", "src/arm/a.cpp: 1 (cpplint.whitespace/tab x 1)")
    assert one.gated


def test_code_that_does_not_count_is_apart():
    test = [finding("src/arm/test/t.cpp", gated=False)] * 2
    own, apart = layout_folded([finding(), finding(), *test], PACKAGE)
    assert (own.message, own.gated) == ("2 layout findings in src/arm/a.cpp: run clang-format", True)
    assert apart.message.startswith("2 layout findings of code that does not count in src/arm/test/t.cpp")
    assert not apart.gated
    assert own.fingerprint != apart.fingerprint


def test_a_single_one_says_more_by_itself():
    given = [finding(), finding(rule="x.y", tags=())]
    assert layout_folded(given, PACKAGE) == tuple(given)


def test_the_fingerprint_does_not_depend_on_how_many():
    (few,) = layout_folded([finding()] * 2, PACKAGE)
    (many,) = layout_folded([finding("src/arm/c.hpp")] * 9, PACKAGE)
    assert few.fingerprint == many.fingerprint
