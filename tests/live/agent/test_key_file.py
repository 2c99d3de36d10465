import random

import pytest

from roslens.live.agent.key_file import read_key, write_key
from roslens.model.errors import UsageError


def random_text():
    return random.Random(1).randbytes(32).hex().encode() + b"\n"


def test_what_is_written_can_be_read_by_the_user_alone(tmp_path):
    path = tmp_path / "key"
    write_key(path)
    assert path.stat().st_mode & 0o777 == 0o600
    assert len(read_key(path)) == 64


def test_a_key_is_never_written_over(tmp_path):
    path = tmp_path / "key"
    write_key(path)
    with pytest.raises(UsageError, match="there is a file already"):
        write_key(path)


@pytest.mark.parametrize(
    ("content", "mode", "said"),
    [
        (b"short", 0o600, "a key of 5 bytes"),
        (b"", 0o600, "an empty key"),
        (random_text(), 0o644, "others can read the key"),
        (random_text(), 0o640, "others can read the key"),
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
