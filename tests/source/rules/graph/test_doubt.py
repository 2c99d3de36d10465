import pytest

from roslens.model.configuration import Proof
from roslens.model.weight.consequence import Certainty
from roslens.source.rules.graph.doubt import doubt_of, exclude_each_other, weighed, weighed_apart
from testbed.configured import clauses

CERTAIN, LIKELY, POSSIBLE = (Proof("a.cpp", 3, sure=sure) for sure in ("certain", "likely", "possible"))


@pytest.mark.parametrize(
    ("proofs", "conditions", "expected"),
    [
        ((CERTAIN, None), (), Certainty.PROVEN),
        ((CERTAIN, LIKELY), (), Certainty.LIKELY),
        ((LIKELY,), ("x",), Certainty.LIKELY),
        ((POSSIBLE,), (), Certainty.HEURISTIC),
        ((CERTAIN,), ("x",), Certainty.LIKELY),
    ],
)
def test_doubt_lowers_by_steps(proofs, conditions, expected):
    certainty, words = weighed(Certainty.PROVEN, proofs, conditions)
    assert certainty is expected
    assert bool(words) is (expected is not Certainty.PROVEN)


def test_the_words_say_each_doubt_once():
    doubt = weighed(Certainty.HEURISTIC, (LIKELY, LIKELY), ("x", "x"), more="who knows")[1]
    assert str(doubt) == " In doubt: likely only (a.cpp:3); only if `x`; who knows."
    assert str(weighed(Certainty.HEURISTIC, (CERTAIN,))[1]) == ""


def test_nodes_that_may_never_run_together_are_a_note():
    certainty, doubt = weighed_apart(weighed(Certainty.PROVEN, (CERTAIN,), ("x",))[1])
    assert certainty is Certainty.HEURISTIC
    assert str(doubt) == (
        " In doubt: no launch file states that these nodes run together under these names; only if `x`."
    )


def test_what_is_clearer_comes_first():
    assert doubt_of([CERTAIN]) < doubt_of([CERTAIN], ["x"]) < doubt_of([LIKELY]) < doubt_of([POSSIBLE])


@pytest.mark.parametrize(
    ("one", "other", "expected"),
    [
        (("a",), ("not a",), True),
        (("not a", "b"), ("a",), True),
        (("a == 1",), ("not a == 1",), True),
        (("a",), ("a",), False),
        (("a",), ("not b",), False),
        ((), ("not b",), False),
        (("mode == 'a'",), ("mode == 'b'",), True),
        (("mode == 'a'",), ('mode == "a"',), False),
        (("mode == 'a'",), ("other == 'b'",), False),
        (("mode == a",), ("mode == b",), False),
        (("count == 1",), ("count == 2",), True),
        (("{parameter mode} == a",), ("{parameter mode} == b",), True),
        (("x and mode == 'a'",), ("mode == 'b' and y",), True),
        (("x or mode == 'a'",), ("mode == 'b'",), False),
        (("mode == 'a'", "x"), ("x", "not mode == 'b'"), False),
        (("not mode == 'a'",), ("not mode == 'b'",), False),
        (("python(', mode, ' == 'a')",), ("python(', mode, ' == 'b')",), True),
        (("python(', mode, ' == 'a')",), ("python(', rate, ' == 'b')",), False),
        (("equals(mode, a)",), ("equals(mode, b)",), True),
        (("$(equals $(var mode) a)",), ("$(equals $(var mode) b)",), True),
        (("$(equals $(var mode) $(var a))",), ("$(equals $(var mode) $(var b))",), False),
        (("$(eval \"'$(var mode)' == 'a'\")",), ("$(eval \"'$(var mode)' == 'b'\")",), True),
    ],
)
def test_opposites_exclude_each_other(one, other, expected):
    assert exclude_each_other(clauses(one), clauses(other)) is expected
