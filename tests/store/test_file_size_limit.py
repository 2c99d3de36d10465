"""A limit on the size of files (`ulimit -f`) is named, and not taken for a disk that failed."""

import resource
import subprocess
import sys

import pytest

from roslens.store.file_size_limit import file_size_limit, process_limit

MANIFEST = """<package format="3"><name>arm</name><version>1.0.0</version><description>An arm.</description>
<maintainer email="a@b.cc">A</maintainer><license>MIT</license></package>
"""


@pytest.fixture
def workspace(tmp_path):
    (tmp_path / "ws/arm").mkdir(parents=True)
    (tmp_path / "ws/arm/package.xml").write_text(MANIFEST)
    for number in range(3):
        lines = (f"int f{number}_{one}(int a) {{ if (a) return 1; return 0; }}\n" for one in range(50))
        (tmp_path / "ws/arm" / f"a{number}.cpp").write_text("".join(lines))
    return tmp_path / "ws"


def limited(words, kilobytes):
    def limit():
        resource.setrlimit(resource.RLIMIT_FSIZE, (kilobytes * 1024, kilobytes * 1024))

    code = "import sys; from roslens.cli.entry import main; sys.exit(main())"
    return subprocess.run(
        [sys.executable, "-c", code, *words], preexec_fn=limit, capture_output=True, text=True, check=False
    )


@pytest.mark.parametrize("kilobytes", [20, 60, 150])
def test_a_store_that_reached_it(workspace, kilobytes):
    done = limited(["check", str(workspace), "-q", "--jobs", "1"], kilobytes)
    assert done.returncode == 2
    assert f"a file may have at most {kilobytes * 1024:,} bytes here ('disk I/O error')" in done.stderr
    assert "(`ulimit -f`)" in done.stderr
    assert "Check the disk" not in done.stderr


def test_any_other_file(workspace, tmp_path):
    words = ["check", str(workspace), "-q", "--jobs", "1", "--no-store", "--no-cache", "--format", "json"]
    done = limited([*words, "-o", str(tmp_path / "run.json")], 4)
    assert done.returncode == 2
    assert "a file may have at most 4,096 bytes here. Raise the limit (`ulimit -f`)" in done.stderr


def test_files_far_below_it_did_not_reach_it(tmp_path, monkeypatch):
    store = tmp_path / "store.sqlite"
    store.write_bytes(bytes(4096))
    monkeypatch.setattr(resource, "getrlimit", lambda _: (1 << 30, 1 << 30))
    assert process_limit() == 1 << 30
    assert file_size_limit(store) == 0
    (tmp_path / "store.sqlite-wal").touch()
    with (tmp_path / "store.sqlite-wal").open("r+b") as log:
        log.truncate((1 << 30) - 4096)
    assert file_size_limit(store) == 1 << 30
    monkeypatch.setattr(resource, "getrlimit", lambda _: (resource.RLIM_INFINITY, resource.RLIM_INFINITY))
    assert file_size_limit(store) == 0
