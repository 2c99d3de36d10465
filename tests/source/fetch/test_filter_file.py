"""Filter files of the first paper, and what is chosen by them."""

import pytest

from roslens.intake.safe_yaml import load_yaml
from roslens.model.errors import UsageError
from roslens.source.fetch.choose import choose
from roslens.source.fetch.distribution import Distribution
from roslens.source.fetch.filter_file import Filter, filter_of
from roslens.source.fetch.wanted import Wanted

TEXT = """\
packages:
  husky: [husky_control, husky_control]
  kobuki:
meta:
  husky: {commits: 342, contributors: 7, levels: {husky_control: 1}}
"""
ALL = Distribution(
    "x",
    (
        Wanted("husky", "https://h/husky", "i", "git", ("husky_base", "husky_control")),
        Wanted("kobuki", "https://h/kobuki", "i", "git", ("kobuki_node",)),
        Wanted("rel/one", "https://h/rel", "t1", "git", ("one",)),
        Wanted("rel/two", "https://h/rel", "t2", "git", ("two",)),
    ),
)


def test_what_it_says():
    assert filter_of(load_yaml(TEXT), "f") == Filter(
        {"husky": ("husky_control",), "kobuki": ()}, {"husky": 342}, {"husky_control": 1}
    )


@pytest.mark.parametrize(
    "text",
    ["a: 1", "packages: [a]", "packages: {a: b}", "packages: {a: [b]}\nmeta: 7", "packages: {a: [b]}\nmeta: {a: 7}",
     "packages: {a: [b]}\nmeta: {a: {commits: many}}", "packages: {a: [b]}\nmeta: {a: {levels: {b: driver}}}"],
)  # fmt: skip
def test_what_is_none(text):
    with pytest.raises(UsageError, match="is not a filter file"):
        filter_of(load_yaml(text), "f")


def test_all_without_a_choice():
    wanted, failures = choose(ALL, None, (), ())
    assert [(one.name, one.packages) for one in wanted] == [
        ("husky", ()),
        ("kobuki", ()),
        ("rel/one", ()),
        ("rel/two", ()),
    ]
    assert not failures


def test_by_filter_by_package_and_by_repository():
    chosen = filter_of(load_yaml(TEXT), "f")
    wanted, failures = choose(ALL, chosen, ("two", "husky_base"), ())
    assert [(one.name, one.packages, one.commits) for one in wanted] == [
        ("husky", ("husky_control", "husky_base"), 342),
        ("kobuki", (), 0),
        ("rel/two", ("two",), 0),
    ]
    wanted, failures = choose(ALL, None, ("husky_base",), ("husky", "rel"))
    assert [(one.name, one.packages) for one in wanted] == [("husky", ()), ("rel/one", ()), ("rel/two", ())]
    assert not failures


def test_names_that_nothing_has():
    wanted, failures = choose(ALL, None, ("husky_contrl",), ("huskey",))
    assert not wanted
    texts = [str(one) for one in failures]
    assert texts[0].startswith(
        "repository:huskey: the distribution has no repository 'huskey'; expected one of its rep"
    )
    assert texts[0].endswith("Did you mean husky?")
    assert texts[1].startswith("package:husky_contrl: the distribution has no package 'husky_contrl'; expected one of")
    assert texts[1].endswith("Did you mean husky_control?")
