import pytest

from roslens.model.edit import Edit
from roslens.model.finding import Finding, Severity
from roslens.source.fix.chosen_fixes import chosen_fixes


def fix(rule, *edits, path="a.cpp"):
    made = tuple(Edit(path, start, end, text) for start, end, text in edits)
    return Finding(rule, Severity.NOTE, rule, path, edits=made)


@pytest.mark.parametrize(
    ("first", "second", "both"),
    [
        ((3, 5, "x"), (5, 7, "y"), True),
        ((3, 5, "x"), (4, 7, "y"), False),
        ((3, 7, "x"), (4, 5, "y"), False),
        ((3, 7, "x"), (3, 7, "y"), False),
        ((3, 3, "x"), (3, 3, "y"), True),
        ((3, 3, "x"), (3, 7, "y"), True),
        ((7, 7, "x"), (3, 7, "y"), True),
        ((5, 5, "x"), (3, 7, "y"), False),
        ((3, 7, "x"), (5, 5, "y"), False),
    ],
)
def test_what_stands_beside_each_other_is_made_at_once(first, second, both):
    chosen = chosen_fixes([fix("a", first), fix("b", second)])
    assert len(chosen.made) == (2 if both else 1)
    assert len(chosen.overlapping) == (0 if both else 1)
    assert chosen == chosen_fixes([fix("b", second), fix("a", first)])


def test_of_two_the_one_that_begins_first_wins():
    chosen = chosen_fixes([fix("a", (4, 8, "x")), fix("b", (3, 5, "y"))])
    assert [one.rule for one in chosen.made] == ["b"]


def test_the_edits_of_one_finding_are_made_together_or_not_at_all():
    chosen = chosen_fixes([fix("a", (0, 2, "x")), fix("b", (1, 3, "y"), (9, 9, "z"))])
    assert [one.rule for one in chosen.made] == ["a"]
    assert chosen.edits("a.cpp") == (Edit("a.cpp", 0, 2, "x"),)


def test_the_same_edit_of_two_findings_mends_both():
    chosen = chosen_fixes([fix("a", (3, 3, " override")), fix("b", (3, 3, " override"))])
    assert [one.rule for one in chosen.made] == ["a", "b"]
    assert len(chosen.edits("a.cpp")) == 1


def test_a_finding_whose_own_edits_overlap_is_none():
    assert not chosen_fixes([fix("a", (0, 4, "x"), (3, 5, "y"))]).made


def test_files_do_not_touch_each_other():
    chosen = chosen_fixes([fix("a", (0, 4, "x")), fix("b", (0, 4, "y"), path="b.cpp")])
    assert chosen.paths == ("a.cpp", "b.cpp")
