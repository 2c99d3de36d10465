"""Programs of files come from the cache or a parse, and are the same either way."""

from __future__ import annotations

from pathlib import Path

import pytest

from roslens.model.source import Language, SourceFile
from roslens.source.extract.workspace import workspace_programs as subject
from roslens.source.extract.workspace.workspace_programs import (
    LowerTask,
    lower_files,
    not_understood,
    workspace_programs,
)
from roslens.source.keys import content_hash
from roslens.source.parsed_file import parse_file
from roslens.source.progress import Silent
from roslens.source.settings import MacroSettings
from roslens.store.cache import Cache

MACROS = MacroSettings()
CONTENTS = {
    "a/a.cpp": b'int main() { n.advertise<S>("a", 1); }\n',
    "a/b.py": b"rospy.Publisher('b', S)\n",
    "a/c.py": b"rospy.Publisher('b', S)\n",
    "a/d.py": b"def (:\n",
}


@pytest.fixture
def files(tmp_path: Path) -> list[SourceFile]:
    (tmp_path / "a").mkdir()
    found = [SourceFile("a/e.yaml", Language.YAML)]
    for path, content in CONTENTS.items():
        (tmp_path / path).write_bytes(content)
        language = Language.CPP if path.endswith("cpp") else Language.PYTHON
        found.append(SourceFile(path, language, size=len(content), content_hash=content_hash(content)))
    return found


def read(root: Path, files: list[SourceFile], cache: Path | None = None, jobs: int = 1) -> subject.WorkspacePrograms:
    with Cache.open(cache) as opened:
        return workspace_programs(str(root), files, MACROS, cache=opened, jobs=jobs, watch=Silent())


def test_each_is_the_program_of_its_file(tmp_path: Path, files: list[SourceFile]):
    found = read(tmp_path, files)
    assert list(found.programs) == sorted(CONTENTS)
    for file in files[1:]:
        assert found.programs[file.path] == parse_file(CONTENTS[file.path], file.language, MACROS).program()
    assert (found.failures, found.lasting) == ((), True)


def test_from_the_cache_it_is_the_same(tmp_path: Path, files: list[SourceFile], monkeypatch: pytest.MonkeyPatch):
    cache = tmp_path / "cache.sqlite"
    first = read(tmp_path, files, cache)
    monkeypatch.setattr(subject, "parse_file", None)
    assert read(tmp_path, files, cache) == first
    assert read(tmp_path, files).failures


def test_the_heaviest_files_come_first(tmp_path: Path, files: list[SourceFile], monkeypatch: pytest.MonkeyPatch):
    seen: list[tuple[str, ...]] = []
    lower = lower_files

    def noting(task: LowerTask) -> subject.LoweredFiles:
        seen.append(tuple(file.path for file in task.files))
        return lower(task)

    monkeypatch.setattr(subject, "_BATCH_BYTES", 50)
    monkeypatch.setattr(subject, "lower_files", noting)
    read(tmp_path, files)
    assert seen == [("a/a.cpp",), ("a/b.py", "a/c.py"), ("a/d.py",)]


def test_what_is_gone_is_told_and_not_for_good(tmp_path: Path, files: list[SourceFile]):
    (tmp_path / "a/b.py").unlink()
    found = read(tmp_path, files)
    assert list(found.programs) == ["a/a.cpp", "a/c.py", "a/d.py"]
    assert [(one.tool, str(one.location)) for one in found.failures] == [("read", "a/b.py")]
    assert not found.lasting


def test_a_fault_of_the_lowering_is_told_and_lasts(
    tmp_path: Path, files: list[SourceFile], monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.setattr("roslens.source.extract.lowering.cpp.cpp_program.lower_cpp", None)
    found = read(tmp_path, files)
    assert [(one.tool, str(one.location)) for one in found.failures] == [("graph", "a/a.cpp")]
    assert len(found.programs) == 3
    assert found.lasting


def test_a_task_that_kills_its_worker_is_told(tmp_path: Path, files: list[SourceFile], monkeypatch: pytest.MonkeyPatch):
    def broken(_: LowerTask) -> None:
        raise RuntimeError("the worker process died twice on this task")

    monkeypatch.setattr(subject, "lower_files", broken)
    found = read(tmp_path, files)
    assert [str(one.location) for one in found.failures] == sorted(CONTENTS)
    assert not found.lasting


def test_what_was_not_understood_has_its_place(tmp_path: Path, files: list[SourceFile]):
    missed = list(not_understood(read(tmp_path, files).programs))
    assert missed
    assert {path for path, _, _ in missed} == {"a/d.py"}
    assert all(line >= 1 and reason for _, line, reason in missed)
