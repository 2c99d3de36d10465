"""Files of tokens, and what becomes of wrong ones."""

from __future__ import annotations

from pathlib import Path

import pytest

from roslens.dashboard.access.person import Person, Role
from roslens.dashboard.access.tokens import Tokens, made_token, read_tokens
from roslens.model.errors import UsageError

ONE, OTHER = "hV3kqP0aZr7-XcTbYw5uNmLgEo1dSf2JiK8yQvHx4As", "B9_wMeR6tYxUzLpOqI2sDfGhJkZcVbN1aKjSoQyT3uE"


def written(folder: Path, text: str, mode: int = 0o600) -> Path:
    path = folder / "tokens"
    path.write_text(text)
    path.chmod(mode)
    return path


def test_a_line_for_each(tmp_path: Path) -> None:
    path = written(tmp_path, f"# who may\nview vera {ONE}\n\noperate  otto {OTHER}   # since May\n")
    assert read_tokens(path) == {ONE: Person("vera", Role.VIEW), OTHER: Person("otto", Role.OPERATE)}


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "no token"),
        ("# nothing\n", "no token"),
        ("view vera\n", ":1: 2 words that are not a token"),
        (f"\nadmin vera {ONE}\n", ":2: 3 words that are not a token"),
        ("view vera short\n", "a token of 5 characters for 'vera'"),
        (f"view vera {'ü' * 30}\n", "a token of 30 characters for 'vera'"),
        (f"view vera {'a' * 43}\n", "a token of 43 characters for 'vera' that is not a generated one"),
        ("operate otto correcthorsebatterystaple\n", "a token of 25 characters for 'otto'"),
        ("operate otto correct-horse-battery-staple-and-some-more-words\n", "that is not a generated one"),
        (f"view vera {ONE}\nview otto {ONE}\n", "'otto' has the token of 'vera'"),
    ],
)
def test_a_wrong_file_is_named_with_its_line_and_its_secrets_are_not(tmp_path: Path, text: str, said: str) -> None:
    with pytest.raises(UsageError) as refused:
        read_tokens(written(tmp_path, text))
    assert said in str(refused.value)
    assert ONE not in str(refused.value)


def test_a_file_that_others_read_is_refused(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="mode 640"):
        read_tokens(written(tmp_path, f"view vera {ONE}\n", 0o640))


def test_a_file_that_is_not_there_is_named(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="nowhere: tokens cannot be read: No such file"):
        read_tokens(tmp_path / "nowhere")


def test_sessions_are_of_one_server() -> None:
    holders = {ONE: Person("vera", Role.VIEW)}
    first, second = Tokens(holders), Tokens(holders)
    assert first.in_session(first.session_of(ONE)) == holders[ONE]
    assert second.in_session(first.session_of(ONE)) is None
    assert first.in_session(ONE) is None
    assert first.session_of("") == ""
    assert first.in_session("") is None
    assert not Tokens({})


def test_made_tokens_differ_and_are_long_enough() -> None:
    assert len({made_token() for _ in range(9)}) == 9
    assert len(made_token()) >= 43


def test_every_token_that_is_made_is_taken(tmp_path: Path) -> None:
    # One in a thousand has no digit, capital or small letter among 43 characters, and is made anew.
    made = [made_token() for _ in range(300)]
    taken = read_tokens(written(tmp_path, "".join(f"view v{number} {one}\n" for number, one in enumerate(made))))
    assert set(taken) == set(made)
