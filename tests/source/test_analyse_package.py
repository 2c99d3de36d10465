"""A package is measured, and lowered to programs where they are wanted, from one parse of each file."""

from __future__ import annotations

from pathlib import Path

import msgspec
import pytest

from roslens.model.source import Language, Location, Package, SourceFile
from roslens.source import parsed_file
from roslens.source.extract.ir.program_codec import program_keys, unpack
from roslens.source.keys import content_hash
from roslens.source.measure.analyse_package import measure_task
from roslens.source.measure.package_task import PackageTask
from roslens.source.parsed_file import parse_file
from roslens.source.settings import CountingSettings, MacroSettings
from roslens.store.cache import Cache

FILES = {"arm/a.cpp": b'int main() { n.advertise<S>("a", 1); }\n', "arm/b.py": b"rospy.Publisher('b', S)\n"}
LANGUAGES = {"arm/a.cpp": Language.CPP, "arm/b.py": Language.PYTHON}
MACROS = MacroSettings()


@pytest.fixture
def parses(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Languages of the files that are parsed."""
    seen: list[str] = []

    def parsing(content: bytes, language: Language, macros: MacroSettings) -> parsed_file.ParsedFile:
        seen.append(language.value)
        return parse_file(content, language, macros)

    monkeypatch.setattr("roslens.source.measure.analyse_package.parse_file", parsing)
    return seen


def task(root: Path, *, programs: bool, cache: str = "") -> PackageTask:
    files = []
    for path, content in FILES.items():
        (root / path).parent.mkdir(parents=True, exist_ok=True)
        (root / path).write_bytes(content)
        files.append(SourceFile(path, LANGUAGES[path], size=len(content), content_hash=content_hash(content)))
    return PackageTask(
        Package("arm", "arm", "arm", Location("arm/package.xml")),
        str(root),
        tuple(files),
        {file.path: f"{file.content_hash}:facts" for file in files},
        CountingSettings(),
        MACROS,
        cache,
        program_keys(files, MACROS) if programs else {},
    )


def test_without_being_asked_nothing_is_lowered(tmp_path: Path, parses: list[str]):
    measured = measure_task(task(tmp_path, programs=False))
    assert all(key.endswith(":facts") for key in measured.analyses)
    assert parses == ["cpp", "python"]


def test_one_parse_gives_both(tmp_path: Path, parses: list[str]):
    plain, both = (measure_task(task(tmp_path, programs=programs)) for programs in (False, True))
    assert parses == ["cpp", "python"] * 2
    assert both.entities == plain.entities
    assert plain.analyses.items() < both.analyses.items()
    keys = task(tmp_path, programs=True).program_keys
    for path, content in FILES.items():
        assert unpack(both.analyses[keys[path]]) == parse_file(content, LANGUAGES[path], MACROS).program()


def test_only_what_is_missing_is_made(tmp_path: Path, parses: list[str]):
    path = tmp_path / "cache.sqlite"
    with Cache.open(path) as cache:
        first = measure_task(task(tmp_path, programs=False, cache=str(path)))
        cache.put(first.analyses)
        second = measure_task(task(tmp_path, programs=True, cache=str(path)))
        assert all(":program:" in key for key in second.analyses)
        assert second.entities == first.entities
        cache.put(second.analyses)
        assert parses == ["cpp", "python"] * 2
        third = measure_task(task(tmp_path, programs=True, cache=str(path)))
        assert parses == ["cpp", "python"] * 2
        assert third == msgspec.structs.replace(first, analyses={})


def test_what_cannot_be_lowered_is_measured_all_the_same(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    def broken(*_: object) -> None:
        raise RuntimeError("a fault of the lowering")

    plain = measure_task(task(tmp_path, programs=False))
    monkeypatch.setattr("roslens.source.extract.lowering.cpp.cpp_program.lower_cpp", broken)
    both = measure_task(task(tmp_path, programs=True))
    assert both.entities == plain.entities
    assert len(both.analyses) == 3


def test_a_file_is_one_failure_however_many_places_do_not_parse(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    broken = b"int f() { return 1; }\n" + b"int @ g(;\nint h() { return 2; }\n" * 12
    monkeypatch.setitem(FILES, "arm/a.cpp", broken)
    (failure,) = measure_task(task(tmp_path, programs=False)).failures
    assert failure.partial
    assert failure.location is not None
    assert (failure.location.path, failure.location.line) == ("arm/a.cpp", 2)
    assert failure.what.startswith("cannot parse ")
    assert " places: `@` here, then from line " in failure.what
    assert failure.what.endswith(" more places")


UNREADABLE = {
    "utf-16": "int main() { return 0; }\n".encode("utf-16"),
    "utf-16 without a mark": "int main() { return 0; }\n".encode("utf-16-be"),
    "binary": b"\x7fELF" + bytes(200),
}


@pytest.mark.parametrize("content", UNREADABLE.values(), ids=UNREADABLE)
def test_a_file_that_is_no_text_is_reported_once_and_not_measured(tmp_path: Path, monkeypatch, content: bytes):
    monkeypatch.setitem(FILES, "arm/a.cpp", content)
    measured = measure_task(task(tmp_path, programs=False))
    (failure,) = measured.failures
    assert (failure.tool, failure.location.path, failure.partial) == ("workspace", "arm/a.cpp", False)
    assert not [one.id for one in measured.entities if "a.cpp" in one.id]
    assert not [one for one in measured.findings if one.path == "arm/a.cpp"]
    assert [one.id for one in measured.entities if "b.py" in one.id], "the other files stand"


def test_a_zero_byte_is_reported_once_and_the_rest_measured(tmp_path: Path, monkeypatch):
    monkeypatch.setitem(FILES, "arm/a.cpp", b"int first() { return 0; }\n\x00\nint second() { return 1; }\n")
    measured = measure_task(task(tmp_path, programs=False))
    (failure,) = measured.failures
    assert failure.what == "the file contains 1 zero byte"
    assert failure.partial
    assert [one.id for one in measured.entities if "second" in one.id]


def test_what_cannot_be_parsed_beside_a_zero_byte_is_reported(tmp_path: Path, monkeypatch):
    monkeypatch.setitem(FILES, "arm/a.cpp", b"int first() { return 0; }\n\x00\nint second( { ] return 1; }\n")
    assert {one.tool for one in measure_task(task(tmp_path, programs=False)).failures} == {"workspace", "syntax"}
