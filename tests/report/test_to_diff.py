import subprocess

import pytest

from roslens.report.run.to_diff import to_diff

CASES = [
    (b"a\nb\nc\n", b"a\nx\nc\n"),
    (b"a\nb", b"a\nb\n"),
    (b"a\nb", b"a\nx"),
    (b"a\r\nb\r\n", b"a\r\nx\r\ny\r\n"),
    (b"\xff\x0c\n\x85\n", b"\xff\x0c\nz\n"),
    (b"", b"a\n"),
    (b"a\rb\nc\n", b"a\rx\nc\n"),
]


@pytest.mark.parametrize(("before", "after"), CASES)
@pytest.mark.parametrize("name", ["a.cpp", "with blank.cpp"])
def test_git_makes_one_of_the_other(tmp_path, before, after, name):
    (tmp_path / name).write_bytes(before)
    diff = b"".join(to_diff(name, before, after))
    subprocess.run(["git", "apply", "--whitespace=nowarn", "-"], input=diff, cwd=tmp_path, check=True)
    assert (tmp_path / name).read_bytes() == after


def test_what_did_not_change_has_no_diff():
    assert not list(to_diff("a", b"x\n", b"x\n"))
