import pytest

from roslens.live.agent.key_file import read_key, write_key
from roslens.model.errors import UsageError

MADE = b"rlk_TgdAhWK-24tgzgXB3s_jrRa3IjCWfeAfZAt-Rym0n8464a6a418\n"


def test_what_is_written_can_be_read_by_the_user_alone(tmp_path):
    path = tmp_path / "key"
    write_key(path)
    assert path.stat().st_mode & 0o777 == 0o600
    assert read_key(path) == path.read_bytes().strip()


def test_a_key_is_never_written_over(tmp_path):
    path = tmp_path / "key"
    write_key(path)
    with pytest.raises(UsageError, match="there is a file already"):
        write_key(path)


@pytest.mark.parametrize(
    ("content", "mode", "said"),
    [
        (b"short", 0o600, "a key of 5 characters that roslens did not generate"),
        (b"", 0o600, "an empty key"),
        (b"\xff" * 32, 0o600, "a key of 32 characters that roslens did not generate"),
        (MADE, 0o644, "others can read the key"),
        (MADE, 0o640, "others can read the key"),
        (None, 0, "No such file"),
    ],
)
def test_files_that_are_no_keys(tmp_path, content, mode, said):
    path = tmp_path / "key"
    if content is not None:
        path.write_bytes(content)
        path.chmod(mode)
    with pytest.raises(UsageError, match=said):
        read_key(path)


@pytest.mark.parametrize(
    "text",
    [
        "CorrectHorseBatteryStapleIsAFineOldPasswordForRobots42",
        "correct-Horse-battery-Staple-for-7-robots-and-some-more",
        "5e884898da28047151d0e56f8dc6292773603d0d6aabbdd62a11ef721d1542d8",
    ],
)
def test_a_passphrase_is_refused_with_the_command_to_make_a_key(tmp_path, text):
    path = tmp_path / "key"
    path.write_text(text)
    path.chmod(0o600)
    with pytest.raises(UsageError, match="did not generate") as refused:
        read_key(path)
    assert f"roslens agent --new-key {path}" in str(refused.value.advice)
    assert text not in str(refused.value)
