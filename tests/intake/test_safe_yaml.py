"""YAML that would exhaust the machine is refused before anything is made of it; other YAML is what it always was."""

import time

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st
from pace import slowness

from roslens.intake import safe_yaml
from roslens.intake.safe_yaml import UnsafeYamlError, load_yaml

BOMB = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n" + "".join(
    f"a{number}: &a{number} [{', '.join([f'*a{number - 1}'] * 10)}]\n" for number in range(1, 10)
)
VALUES = st.recursive(
    st.none() | st.booleans() | st.integers(-99, 99) | st.text("ab c", max_size=4),
    lambda inner: (
        st.lists(inner, max_size=3) | st.dictionaries(st.text("ab", min_size=1, max_size=2), inner, max_size=3)
    ),
    max_leaves=12,
)


@given(VALUES)
def test_what_was_written_is_read(value):
    assert load_yaml(yaml.safe_dump(value)) == value


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (BOMB, "values, with those that aliases stand for"),
        ("[" * 100_000, "deep"),
        ("{a: " * 100_000, "deep"),
        ("- " * 100_000, "deep"),
        ("a" * (safe_yaml.MOST_BYTES + 1), "bytes of YAML"),
        ("!!python/object/apply:os.system ['true']", "could not determine a constructor"),
        ("a: [", "expected (?:the )?node content"),
        ("a: *b", "undefined alias"),
        (b"a: \xff", "invalid|decode|codec"),
        # Base 60, which takes the square of its length.
        ("a: 1" + ":59" * 300_000, r"1:59:59:59:59:59:59:… in line 1 has 900,001 characters; at most 1,000 are read"),
        ("a: 1\n? -1" + ":59" * 400, "in line 2 has 1,202 characters"),
    ],
)
def test_what_is_refused(text, says):
    begun = time.process_time()
    with pytest.raises(UnsafeYamlError, match=says):
        load_yaml(text)
    assert time.process_time() - begun < 5 * slowness()


def test_only_a_number_has_a_bound_of_its_own():
    assert load_yaml("a: '" + "1" * 2_000 + "'") == {"a": "1" * 2_000}
    assert load_yaml("a: " + "b1" * 2_000) == {"a": "b1" * 2_000}
    assert load_yaml("a: 1" + ":59" * 3) == {"a": 431999}


def test_an_alias_of_what_it_stands_in_is_one_value():
    found = load_yaml("&a [1, *a]")
    assert found[1] is found


def _limits(monkeypatch, *, most_bytes=1_000, values=1_000, depth=100):
    monkeypatch.setattr(safe_yaml, "MOST_BYTES", most_bytes)
    monkeypatch.setattr(safe_yaml, "MOST_VALUES", values)
    monkeypatch.setattr(safe_yaml, "MOST_DEPTH", depth)


def test_the_limits():
    assert (safe_yaml.MOST_BYTES, safe_yaml.MOST_VALUES, safe_yaml.MOST_DEPTH) == (5_000_000, 200_000, 100)


@pytest.mark.parametrize(
    ("text", "values"),
    [
        ("a", 1),
        ("[]", 1),
        ("[1, 2]", 3),
        ("{a: 1}", 3),
        ("[[1], [2, 3]]", 6),
        # What an alias stands for counts each time, with the list or table itself and what stands in it.
        ("[&a 1, *a]", 3),
        ("[&a [1, 2], *a]", 7),
        ("[&a [1, 2], *a, *a]", 10),
        ("[&a {x: 1}, *a]", 7),
        ("[0, &a [1, &b [2, 3]], *b, *a]", 15),
        ("[&a [1], &b [*a, *a], *b]", 13),
        ("&a [1, *a]", 3),
    ],
)
def test_every_value_counts_and_one_too_many_is_refused(monkeypatch, text, values):
    _limits(monkeypatch, values=values)
    load_yaml(text)
    _limits(monkeypatch, values=values - 1)
    with pytest.raises(UnsafeYamlError, match=f"more than {values - 1} values"):
        load_yaml(text)


@pytest.mark.parametrize("text", ["[[[1]]]", "{a: {b: {c: 1}}}", "[[1], [2], [{a: 1}], [[3]], [[4]]]"])
def test_depth_is_that_of_what_is_open(monkeypatch, text):
    _limits(monkeypatch, depth=3)
    load_yaml(text)
    _limits(monkeypatch, depth=2)
    with pytest.raises(UnsafeYamlError, match="lists and tables more than 2 deep"):
        load_yaml(text)


def test_a_text_of_the_most_bytes_is_read(monkeypatch):
    _limits(monkeypatch, most_bytes=5)
    assert load_yaml("abcde") == "abcde"
    with pytest.raises(UnsafeYamlError, match="6 bytes of YAML; at most 5 are read"):
        load_yaml("abcdef")


def test_what_is_wrong_is_one_line_with_its_cause():
    with pytest.raises(UnsafeYamlError) as refused:
        load_yaml("a: [\n\n")
    assert "\n" not in str(refused.value)
    assert "  " not in str(refused.value)
    assert isinstance(refused.value.__cause__, yaml.YAMLError)


def test_without_libyaml_the_same_is_read(monkeypatch):
    monkeypatch.delattr(yaml, "CSafeLoader", raising=False)
    assert load_yaml("{a: [1, x, null]}") == {"a": [1, "x", None]}
    with pytest.raises(UnsafeYamlError, match="constructor"):
        load_yaml("!!python/object/apply:os.system ['true']")
