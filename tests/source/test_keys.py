import shutil
import subprocess

import pytest

from roslens.source.keys import analyser_version, content_hash, key_of
from roslens.source.settings import CountingSettings


def test_the_content_hash_is_gits_blob_id():
    assert content_hash(b"") == "e69de29bb2d1d6434b8b29ae775ad8c2e48c5391"


@pytest.mark.real
@pytest.mark.skipif(not shutil.which("git"), reason="git is not installed")
def test_git_agrees():
    content = b"int x;\r\n\0\xff"
    git = subprocess.run(["git", "hash-object", "--stdin"], input=content, capture_output=True, check=True)
    assert git.stdout.decode().strip() == content_hash(content)


def test_keys_differ_by_value_and_by_order():
    assert key_of("a", "b") != key_of("b", "a")
    assert key_of("ab") != key_of("a", "b")
    assert key_of({"x": 1, "y": 2}) == key_of({"y": 2, "x": 1})
    assert key_of(CountingSettings()) != key_of(CountingSettings(lambdas=False))


def test_the_version_has_a_hash_of_the_code():
    version, plus, digest = analyser_version().partition("+")
    assert version.count(".") == 2
    assert plus
    assert len(digest) == 12
