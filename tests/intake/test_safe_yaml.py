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
    ],
)
def test_what_is_refused(text, says):
    begun = time.process_time()
    with pytest.raises(UnsafeYamlError, match=says):
        load_yaml(text)
    assert time.process_time() - begun < 5 * slowness()


def test_an_alias_of_what_it_stands_in_is_one_value():
    found = load_yaml("&a [1, *a]")
    assert found[1] is found
