import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.live.reported.parameter_text import HIDDEN, LONGEST, is_secret, value_text


@pytest.mark.parametrize(
    "name",
    [
        "password",
        "db.password",
        "/robot/wifi_password",
        "apiKey",
        "api_key",
        "API_KEY",
        "AuthToken",
        "aws-secret",
        "KEY",
    ],
)
def test_passwords_tokens_and_keys_are_secrets(name):
    assert is_secret(name)
    assert value_text(name, "hunter2") == HIDDEN


@pytest.mark.parametrize(
    "name", ["keyframe_rate", "monkey", "tokenizer", "public_key", "rate", "keyboard", "", "use_sim_time"]
)
def test_other_names_are_none(name):
    assert not is_secret(name)


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (True, "true"),
        (1.5, "1.5"),
        (7, "7"),
        ("a\nb", "a b"),
        (None, "not set"),
        (b"\0\1", "<2 bytes>"),
        ([1, 2.0, "x"], "[1, 2.0, x]"),
        ({"p": 1, "token": "t"}, "{p: 1, token: ***}"),
        ("postgres://me:hunter2@host/db", "postgres://me:***@host/db"),
    ],
)
def test_values_read_as_people_write_them(value, text):
    assert value_text("rate", value) == text


def test_what_is_nested_endlessly_ends():
    value = []
    value.append(value)
    assert len(value_text("x", value)) <= LONGEST


@given(st.text(), st.recursive(st.none() | st.booleans() | st.floats() | st.text() | st.binary(), st.lists))
def test_a_text_is_short_and_can_be_shown(name, value):
    text = value_text(name, value)
    assert len(text) <= LONGEST
    assert text.isprintable()


@given(st.text("0123456789abcdef", min_size=8))
def test_a_secret_is_nowhere_in_the_text(secret):
    for name in ("password", "a/token/b", "x.api_key"):
        assert secret not in value_text(name, [secret, {"a": secret}])
    assert secret not in value_text("settings", {"list": [{"password": secret}]})
