"""Files of tokens, and what becomes of wrong ones."""

from __future__ import annotations

from pathlib import Path

import pytest

from roslens.dashboard.access.person import Person, Role
from roslens.dashboard.access.tokens import Tokens, add_token, read_tokens
from roslens.model.errors import UsageError

ONE = "rlt_a4ayc_80_OGda4BO_1o_V0etpOqiLx1JwB5S3beHW0s148bd4dd"
OTHER = "rlt_1HNeOiZeFu7gP1lxi5tdAwGcB9i2xR-Q2jpmbuwTqzU39a5731d"
EARLIER = "hV3kqP0aZr7-XcTbYw5uNmLgEo1dSf2JiK8yQvHx4As"


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
        ("view vera short\n", "a token of 5 characters that roslens did not generate, for 'vera'"),
        (f"view vera {'ü' * 30}\n", "a token of 30 characters that roslens did not generate, for 'vera'"),
        (f"view vera {EARLIER}\n", "did not generate, as earlier versions wrote"),
        ("operate otto correcthorsebatterystaple\n", "roslens serve --new-token operate otto --tokens"),
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


def test_every_token_that_is_added_is_taken(tmp_path: Path) -> None:
    path = tmp_path / "people"
    first = add_token("view", "vera", path)
    path.write_text(path.read_text().rstrip())
    second = add_token("operate", "otto", path)
    assert path.stat().st_mode & 0o777 == 0o600
    assert read_tokens(path) == {first: Person("vera", Role.VIEW), second: Person("otto", Role.OPERATE)}


@pytest.mark.parametrize(
    ("role", "name"), [("admin", "v"), ("view", ""), ("view", "a b"), ("view", "a#"), ("view", "a\n")]
)
def test_a_line_that_could_not_be_read_is_not_added(tmp_path: Path, role: str, name: str) -> None:
    with pytest.raises(UsageError, match=r"the role|the name"):
        add_token(role, name, tmp_path / "people")
    assert not (tmp_path / "people").exists()
