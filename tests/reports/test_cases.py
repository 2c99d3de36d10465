"""The rebuilt reports are what they say they are: places exist, forms differ, no report stands twice."""

import re
from collections import Counter

import pytest

from reports.report_case import CASES, ROUNDS, rebuilt

ALL = {name: rebuilt(name) for name in ROUNDS}
EVERY = [pytest.param(one, id=f"{name}-{one.name}") for name, cases in ALL.items() for one in cases]


def files(folder):
    return {path.relative_to(folder): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


@pytest.mark.parametrize("one", EVERY)
def test_a_case_is_whole(one):
    present = {path.name for path in one.folder.iterdir()}
    assert present == {"expect.json", *one.forms}
    assert re.fullmatch(r"[\w.-]+/[\w.-]+#\d+", one.case.source)
    assert bool(one.case.bad) == bool(one.case.consequence) == bool(one.case.wrong) != bool(one.case.why_correct)
    for form in one.forms:
        assert any((one.folder / form).rglob("package.xml"))


@pytest.mark.parametrize("one", EVERY)
def test_places_lie_in_the_files_of_the_mistake(one):
    for place in one.case.bad:
        text = (one.folder / "bad" / place.path).read_text()
        assert place.any
        if place.lines:
            first, last = place.lines
            assert 1 <= first <= last <= first + 4
            assert first <= len(text.splitlines())


@pytest.mark.parametrize("one", [param for param in EVERY if param.values[0].case.bad])
def test_the_correction_touches_little(one):
    bad, good = files(one.folder / "bad"), files(one.folder / "good")
    changed = [path for path in bad.keys() | good.keys() if bad.get(path) != good.get(path)]
    assert 1 <= len(changed) <= 3


def test_rounds_have_what_they_are_meant_to_have():
    assert {name: len(cases) for name, cases in ALL.items()} == {"first": 40, "second": 20, "third": 20, "fourth": 20}
    for cases in ALL.values():
        assert sum(not one.case.bad for one in cases) >= len(cases) / 5
        assert sum(one.case.area == "launch" for one in cases) >= len(cases) / 3
    assert sum(one.case.ros == 1 for one in ALL["first"]) >= 6


def test_no_report_stands_twice():
    sources = Counter(one.case.source for cases in ALL.values() for one in cases)
    assert not [source for source, count in sources.items() if count > 1]


def test_a_case_that_cannot_be_read_is_named(monkeypatch, tmp_path):
    folder = tmp_path / "first" / "01-odd"
    folder.mkdir(parents=True)
    (folder / "expect.json").write_text('{"title": "odd"}')
    monkeypatch.setattr("reports.report_case.CASES", tmp_path)
    with pytest.raises(ValueError, match="01-odd"):
        rebuilt("first")


def test_an_unknown_round_is_refused():
    with pytest.raises(ValueError, match=r"fifth.*first, second, third, fourth"):
        rebuilt("fifth")


def test_cases_lie_in_rounds():
    assert {path.name for path in CASES.iterdir()} == set(ROUNDS)
