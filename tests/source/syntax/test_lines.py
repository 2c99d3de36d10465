"""Lines are distinguished exactly as cloc does: held against what cloc said of the fixtures, and cloc itself."""

import json
import random
import shutil
import subprocess
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.source.syntax.facts import Lines
from roslens.source.syntax.lines import count_lines

ROOT = Path(__file__).parents[3]
FIXTURES = ROOT / "tests" / "fixtures" / "syntax" / "lines"
RECORDED = json.loads((FIXTURES / "cloc.json").read_text())
PIECES = [
    "/*", "*/", "//", '"""', "'''", '"', "'", "\\\n", "\n", "\n", "\n", " ", "#", "#!", "u", "R", "x", "y = 1", "\t",
    "\r\n", "\\\r\n", "\\", "*", "/", "\f\n", "\v", "\x85", "0", "\xef\xbb\xbf",
]  # fmt: skip


def syntax_of(name: str) -> str:
    return "python" if name.endswith(".py") else "cpp"


@pytest.mark.parametrize("name", sorted(RECORDED))
def test_equal_to_what_cloc_said(name):
    lines = count_lines((FIXTURES / name).read_bytes(), syntax_of(name))
    assert {"blank": lines.blank, "comment": lines.comment, "code": lines.code} == RECORDED[name]
    assert lines.physical == lines.blank + lines.comment + lines.code


def test_every_fixture_is_recorded():
    assert sorted(RECORDED) == sorted(path.name for path in FIXTURES.iterdir() if path.suffix != ".json")


@pytest.mark.parametrize("syntax", ["cpp", "python"])
def test_nothing_has_no_lines(syntax):
    assert count_lines(b"", syntax) == Lines()


def test_a_last_line_without_line_end_is_a_line():
    assert count_lines(b"int a;\nint b;", "cpp") == Lines(2, 2, 0, 0)


def test_unknown_syntax_is_an_error():
    with pytest.raises(ValueError, match="'fortran' is not a syntax"):
        count_lines(b"x", "fortran")


@given(st.lists(st.sampled_from(PIECES)).map("".join), st.sampled_from(["cpp", "python"]))
def test_all_lines_are_counted_once(text, syntax):
    content = text.encode("latin-1")
    lines = count_lines(content, syntax)
    assert lines.physical == content.count(b"\n") + (bool(content) and not content.endswith(b"\n"))
    assert lines.physical == lines.blank + lines.comment + lines.code
    assert lines.blank >= 0


@pytest.mark.parametrize("text", [b"/*", b"/*/", b"*a", b"//", b'"', b"/* */", b"\\\n", b"'''", b"#"])
@pytest.mark.parametrize("syntax", ["cpp", "python"])
def test_long_repetitions_take_linear_time(text, syntax):
    assert count_lines(text * 300_000, syntax).physical >= 1
    assert count_lines(b"/*" + text * 300_000 + b"*/", syntax).physical >= 1


def cloc(folder: Path) -> dict[str, dict[str, int]]:
    command = ["cloc", "--by-file", "--json", "--quiet", "--skip-uniqueness"]
    command += ["--include-lang=C,C++,C/C++ Header,Python", "."]
    output = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=True).stdout
    counted = json.loads(output)
    return {name.removeprefix("./"): row for name, row in counted.items() if name not in {"header", "SUM"}}


def differences(folder: Path) -> list[str]:
    found = []
    for name, row in cloc(folder).items():
        syntax = "python" if row["language"] == "Python" else "cpp"
        lines = count_lines((folder / name).read_bytes(), syntax)
        if (lines.blank, lines.comment, lines.code) != (row["blank"], row["comment"], row["code"]):
            found.append(f"{name}: {lines} but cloc says {row}")
    return found


needs_cloc = pytest.mark.skipif(not shutil.which("cloc"), reason="cloc is not installed")
LAST_EQUAL = (2, 4)
"""The last version of cloc that counts as 1.96 does; 2.08 takes other lines for text of documentation."""


def version_of_cloc() -> tuple[int, ...]:
    said = subprocess.run(["cloc", "--version"], capture_output=True, text=True, check=True).stdout
    return tuple(int(part) for part in said.strip().split("."))


@pytest.mark.real
@needs_cloc
def test_equal_to_cloc_on_the_fixtures_and_examples():
    assert differences(ROOT / "tests" / "fixtures") == []
    assert not (ROOT / "examples").is_dir() or differences(ROOT / "examples") == []


@pytest.mark.real
@needs_cloc
def test_equal_to_cloc_on_random_pieces(tmp_path):
    if version_of_cloc() > LAST_EQUAL:
        pytest.skip(
            "this cloc is newer than 2.04, and counts documentation of Python that is torn into pieces otherwise"
        )
    choose = random.Random(20)
    for number in range(1_000):
        text = "".join(choose.choice(PIECES) for _ in range(choose.randint(1, 40)))
        name = f"f{number}{choose.choice(['.cpp', '.py', '.c', '.hpp'])}"
        (tmp_path / name).write_bytes(text.encode("latin-1"))
    assert differences(tmp_path) == []
