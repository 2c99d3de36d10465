"""Tag expressions and tag lists."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.model.errors import UsageError
from roslens.model.tags import TagFilter, parse_tags, tag_filter


@pytest.mark.parametrize(
    ("text", "tags", "expected"),
    [
        ("", [], True),
        ("  ", ["ros"], True),
        ("ros", ["ros", "style"], True),
        ("ros", ["style"], False),
        ("ROS", ["ros"], True),
        ("complexity and not his", ["complexity"], True),
        ("complexity and not his", ["complexity", "his"], False),
        ("complexity & !his", ["complexity", "his"], False),
        ("not not ros", ["ros"], True),
        ("a or b and c", ["a"], True),
        ("a or b and c", ["b"], False),
        ("(a or b) and c", ["a"], False),
        ("(a | b) and c", ["b", "c"], True),
        ("not a and b", ["b"], True),
        ("not (a and b)", ["a"], True),
        ("misra-c++:2008/5.0", ["misra-c++:2008/5.0"], True),
        ("a NOT", ["a"], None),
        ("+ros,-metrics", ["ros"], True),
        ("+ros,-metrics", ["ros", "metrics"], False),
        ("+ros,-metrics", ["style"], False),
        ("-metrics", ["style"], True),
        ("-metrics", ["metrics"], False),
        ("-a, -b", ["b"], False),
        ("a,b", ["b"], True),
        ("a,b", ["c"], False),
        ("+and", ["and"], True),
    ],
)
def test_matches(text, tags, expected):
    if expected is None:
        with pytest.raises(UsageError):
            parse_tags(text)
    else:
        assert parse_tags(text).matches(tags) is expected


@pytest.mark.parametrize(
    ("text", "column", "what"),
    [
        ("a b", 3, "unexpected 'b'"),
        ("a and", 6, "a tag is missing"),
        ("and a", 1, "unexpected 'and'"),
        ("(a or b", 1, "'(' without its ')'"),
        ("a)", 2, "unexpected ')'"),
        ("()", 2, "unexpected ')'"),
        ("a,,b", 3, "no tag between the commas"),
        ("a,", 3, "no tag between the commas"),
        ("+ros, -", 7, "'-' without a tag"),
        ("+ros, a b", 7, "'a b' in a list"),
        ("a, not b", 4, "'not b' in a list"),
        ("(" * 60 + "a" + ")" * 60, 51, "more than 50 levels"),
        ("!" * 100_000 + "a", 51, "more than 50 levels"),
    ],
)
def test_errors_name_the_column_and_the_text(text, column, what):
    with pytest.raises(UsageError) as caught:
        parse_tags(text)
    assert caught.value.where == f"column {column}"
    assert what in caught.value.what
    assert repr(text) in caught.value.what
    assert "complexity and not his" in caught.value.expected


def test_names_are_listed_once_in_order():
    assert parse_tags("b and (a or not B)").names == ("b", "a")
    assert parse_tags("+ros,-metrics").names == ("ros", "metrics")


def test_an_empty_filter_is_false_and_matches_all():
    assert not TagFilter()
    assert not tag_filter()
    assert tag_filter(["a"])
    assert TagFilter().both(tag_filter(["a"])) == tag_filter(["a"]) == tag_filter(["a"]).both(TagFilter())


TAGS = st.sampled_from(["a", "b", "c", "d"])
EXPRESSIONS = st.recursive(
    TAGS,
    lambda inner: st.one_of(
        st.tuples(st.just("not"), inner),
        st.tuples(inner, st.sampled_from(["and", "or"]), inner),
    ),
    max_leaves=12,
)


def written(tree):
    if isinstance(tree, str):
        return tree
    return f"not ({written(tree[1])})" if len(tree) == 2 else f"({written(tree[0])}) {tree[1]} ({written(tree[2])})"


def meaning(tree, tags):
    if isinstance(tree, str):
        return tree in tags
    if len(tree) == 2:
        return not meaning(tree[1], tags)
    left, right = meaning(tree[0], tags), meaning(tree[2], tags)
    return (left and right) if tree[1] == "and" else (left or right)


@given(EXPRESSIONS, st.frozensets(TAGS))
def test_an_expression_means_what_it_says(tree, tags):
    assert parse_tags(written(tree)).matches(tags) is meaning(tree, tags)


@given(st.lists(TAGS), st.lists(TAGS), st.frozensets(TAGS))
def test_a_list_takes_any_included_and_no_excluded(include, exclude, tags):
    expected = (not include or bool(tags & set(include))) and not tags & set(exclude)
    assert tag_filter(include, exclude).matches(tags) is expected
    text = ",".join(["+" + tag for tag in include] + ["-" + tag for tag in exclude])
    assert parse_tags(text).matches(tags) is expected


@given(st.text(alphabet="ab(),+-!&| notdr", max_size=40), st.frozensets(TAGS))
def test_any_text_is_a_filter_or_a_usage_error(text, tags):
    try:
        found = parse_tags(text)
    except UsageError:
        return
    assert found.matches(tags) in {True, False}


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("", ""),
        ("A", "a"),
        ("!a", "not a"),
        ("not not a", "not not a"),
        ("(a or b) and not (c or d)", "(a or b) and not (c or d)"),
        ("a or b and c", "a or b and c"),
        ("((a and b)) and c", "a and b and c"),
        ("+ros,-metrics,style", "(ros or style) and not metrics"),
        ("-a,-b", "not (a or b)"),
    ],
)
def test_written_as_an_expression(text, expected):
    assert str(parse_tags(text)) == expected


@given(EXPRESSIONS, st.frozensets(TAGS))
def test_what_is_written_means_the_same(tree, tags):
    found = parse_tags(written(tree))
    assert parse_tags(str(found)).matches(tags) is found.matches(tags)
