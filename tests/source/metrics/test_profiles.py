"""The profiles of cyclomatic complexity against what the tools say.

The table of the examples holds what lizard 1.24.3, radon 6.0.1, ruff 0.17.5 and pmccabe 2.8 print; ``null`` is a
function that the tool does not find. The tests marked ``real`` ask the tools themselves, over more files;
``ROSLENS_CORPORA`` may name a folder with whole repositories.
"""

import json
import os
import re
import shutil
import subprocess
import sys
import warnings
from collections import Counter
from pathlib import Path

import pytest

from roslens.source.metrics.complexity.cyclomatic_complexity import DECISIONS
from roslens.source.metrics.complexity.profiles import PROFILES, ROSLENS, cyclomatic
from roslens.source.syntax.cpp import parse_cpp
from roslens.source.syntax.facts import FileFacts, FunctionFacts
from roslens.source.syntax.macro.macros import load_macros
from roslens.source.syntax.python import parse_python

ROOT = Path(__file__).parents[3]
EXAMPLES = ROOT / "tests" / "fixtures" / "metrics" / "profiles"
TABLE = json.loads((EXAMPLES / "disagreements.json").read_text())
NOT_REPRODUCED = set(TABLE.pop("not reproduced"))
MACROS = load_macros()
SYNTAX = ROOT / "tests" / "fixtures" / "syntax"
PYTHON_FOLDERS = [EXAMPLES, SYNTAX / "python", ROOT / "examples", ROOT / "src" / "roslens" / "live"]
CPP_FOLDERS = [SYNTAX / "cpp", ROOT / "examples"]
EXPLAINED = {("hidden_braces", "loops"), ("local_classes", "outer"), ("logical", "mix")}
"""Functions with a macro that loops, a class inside, and the words ``and`` and ``or``, which lizard does not know."""
CPP_ENDINGS = (".h", ".hpp", ".hh", ".c", ".cpp", ".cc", ".cxx")


def facts_of(path: Path) -> FileFacts:
    content = path.read_bytes()
    return parse_python(content) if path.suffix not in CPP_ENDINGS else parse_cpp(content, MACROS)


@pytest.mark.parametrize("file", TABLE)
def test_examples(file):
    facts = facts_of(EXAMPLES / file)
    found = {one.qualified_name: one for one in facts.functions}
    assert list(found) == list(TABLE[file])
    for name, row in TABLE[file].items():
        for profile, value in row.items():
            if (profile, facts.syntax) in PROFILES and value is not None:
                ours = cyclomatic(profile, facts.syntax, found[name], facts.functions)
                assert (ours == value) is (f"{name} {profile}" not in NOT_REPRODUCED), (name, profile, ours)


def test_the_page_tells_the_table():
    page = (ROOT / "docs" / "reference" / "metrics" / "disagreements.md").read_text()
    reported = {}
    for line in page.splitlines():
        if match := re.fullmatch(r"(?:- )?`([\w:.]+)`: (.*)", line):
            values = [one.split(" ") for one in match[2].split(", ")]
            reported[match[1]] = {tool: None if value == "none" else int(value) for tool, value in values}
    assert reported == {name: row for rows in TABLE.values() for name, row in rows.items() if name != "last"}


def test_the_examples_of_the_page_are_the_files():
    page = (ROOT / "docs" / "reference" / "metrics" / "disagreements.md").read_text()
    blocks = re.findall(r"```(?:python|cpp)\n(.*?)```", page, re.DOTALL)
    files = "\n\n".join((EXAMPLES / file).read_text() for file in TABLE)
    squeezed = " ".join(files.split())
    for block in blocks:
        for example in re.split(r"\n\n(?=\S)", block):
            assert " ".join(example.split()) in squeezed


def test_the_default_is_the_metric():
    assert frozenset(DECISIONS) == ROSLENS


def test_a_profile_without_that_language():
    function = FunctionFacts(name="f", qualified_name="f", signature="", line=1, column=1, end_line=1)
    with pytest.raises(ValueError, match=r"no profile 'radon' for 'cpp': expected one of roslens for cpp, roslens for"):
        cyclomatic("radon", "cpp", function)


def test_lambdas_and_arms_can_be_left_out():
    function = FunctionFacts(
        name="f",
        qualified_name="f",
        signature="",
        line=1,
        column=1,
        end_line=9,
        counts={"if": 4, "and": 2, "lambda": 1},
        lambda_counts={"and": 2},
        alternative_counts={"if": 1},
    )
    assert cyclomatic("roslens", "cpp", function) == 7
    assert cyclomatic("roslens", "cpp", function, lambdas=False) == 5
    assert cyclomatic("roslens", "cpp", function, alternatives=False) == 6
    assert cyclomatic("roslens", "cpp", function, lambdas=False, alternatives=False) == 4


def by_radon(path: Path) -> dict[tuple[int, str], int]:
    """Return line and name of the functions that radon sees with their complexity."""
    visitors = pytest.importorskip("radon.visitors")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            top = visitors.ComplexityVisitor.from_code(path.read_bytes())
        except SyntaxError:
            return {}
    found = {}
    classes, functions = list(top.classes), list(top.functions)
    for one in classes:
        functions += one.methods
        classes += one.inner_classes
    for one in functions:
        found[one.lineno, one.name] = one.complexity
        functions += one.closures
    return found


def by_ruff(paths: list[Path]) -> dict[Path, dict[tuple[int, str], int]]:
    ruff = Path(sys.executable).with_name("ruff")
    if not ruff.exists():
        pytest.skip("ruff is not installed")
    command = [ruff, "check", "--isolated", "--no-cache", "--select", "C901", "--output-format", "json"]
    command += ["--target-version", "py313", "--config", "lint.mccabe.max-complexity=0", *paths]
    findings = json.loads(subprocess.run(command, capture_output=True, check=False).stdout)
    broken = {Path(one["filename"]) for one in findings if one["code"] != "C901"}
    found: dict[Path, dict[tuple[int, str], int]] = {path: {} for path in paths}
    for one in findings:
        path = Path(one["filename"])
        match = re.match(r"`(.*)` is too complex \((\d+) > 0\)", one["message"])
        if match and path not in broken:
            found[path][one["location"]["row"], match[1]] = int(match[2])
    return found


def by_lizard(path: Path) -> dict[tuple[int, str], int]:
    lizard = pytest.importorskip("lizard")
    name = str(path) if path.suffix in {*CPP_ENDINGS, ".py"} else f"{path}.py"
    found = lizard.analyze_file.analyze_source_code(name, path.read_text("utf-8", "replace")).function_list
    if path.suffix in CPP_ENDINGS:
        return {(one.end_line, one.name.rpartition("::")[2]): one.cyclomatic_complexity for one in found}
    return {(one.start_line, one.name.rpartition(".")[2]): one.cyclomatic_complexity for one in found}


def by_pmccabe(path: Path) -> dict[tuple[int, str], int]:
    """Return the traditional complexity; functions by their last line and name."""
    output = subprocess.run(["pmccabe", path], capture_output=True, text=True, check=False).stdout
    found = {}
    for line in output.splitlines():
        _, traditional, _, first, lines, place = line.split("\t")
        name = place.rpartition("): ")[2].rpartition("::")[2].strip()
        found[int(first) + int(lines) - 1, name] = int(traditional)
    return found


def compared(profile: str, facts: FileFacts, theirs: dict[tuple[int, str], int]) -> tuple[int, list[tuple]]:
    """Return how many whole functions both have, and those that differ: line, name, their value, ours."""
    names = Counter((one.end_line if facts.syntax == "cpp" else one.line, one.name) for one in facts.functions)
    both, differ = 0, []
    for one in facts.functions:
        key = (one.end_line if facts.syntax == "cpp" else one.line, one.name)
        if key in theirs and names[key] == 1 and not one.approximate:
            both += 1
            ours = cyclomatic(profile, facts.syntax, one, facts.functions)
            if ours != theirs[key]:
                differ.append((*key, theirs[key], ours))
    return both, differ


def python_files(folders):
    found = []
    for folder in folders:
        for path in sorted(folder.rglob("*")):
            if path.suffix == ".py" or (not path.suffix and path.is_file() and _is_script(path)):
                found.append(path)
    return found


def _is_script(path: Path) -> bool:
    with path.open("rb") as file:
        return re.match(rb"#!.*python", file.readline(200)) is not None


def cpp_files(folders):
    return [path for folder in folders for path in sorted(folder.rglob("*")) if path.suffix in CPP_ENDINGS]


def corpora() -> list[Path]:
    folder = os.environ.get("ROSLENS_CORPORA")
    if not folder:
        pytest.skip("ROSLENS_CORPORA names no folder")
    return [path for path in sorted(Path(folder).iterdir()) if path.is_dir()]


@pytest.mark.real
@pytest.mark.parametrize(("profile", "tool"), [("radon", by_radon), ("lizard", by_lizard)])
def test_python_equals(profile, tool):
    total = 0
    for path in python_files(PYTHON_FOLDERS):
        both, differ = compared(profile, facts_of(path), tool(path))
        assert differ == [], path
        total += both
    assert total > 500


@pytest.mark.real
def test_python_equals_ruff():
    found = by_ruff(python_files(PYTHON_FOLDERS))
    total = 0
    for path, theirs in found.items():
        both, differ = compared("mccabe", facts_of(path), theirs)
        assert differ == [], path
        total += both
    assert total > 500


@pytest.mark.real
def test_cpp_equals_lizard():
    total, differ = 0, set()
    for path in cpp_files(CPP_FOLDERS):
        both, different = compared("lizard", facts_of(path), by_lizard(path))
        total += both
        differ |= {(path.parent.name, name) for _, name, _, _ in different}
    assert total > 30
    assert differ == EXPLAINED


@pytest.mark.real
@pytest.mark.parametrize("file", TABLE)
def test_the_table_is_what_the_tools_say(file):
    path = EXAMPLES / file
    facts = facts_of(path)
    tools = {"lizard": by_lizard(path)}
    if facts.syntax == "python":
        tools |= {"radon": by_radon(path), "mccabe": by_ruff([path])[path]}
    elif shutil.which("pmccabe"):
        tools["pmccabe"] = by_pmccabe(path)
    for one in facts.functions:
        key = (one.end_line if facts.syntax == "cpp" else one.line, one.name)
        row = TABLE[file][one.qualified_name]
        assert {tool: found.get(key) for tool, found in tools.items()} == {tool: row[tool] for tool in tools}, one.name


@pytest.mark.corpora
@pytest.mark.real
@pytest.mark.timeout(900)
def test_python_of_whole_repositories():
    files = python_files(corpora())
    ruff = by_ruff(files)
    share = {}
    for profile in ("radon", "mccabe", "lizard"):
        total, differ = 0, 0
        for path in files:
            theirs = {"radon": by_radon, "lizard": by_lizard, "mccabe": ruff.get}[profile](path)
            both, different = compared(profile, facts_of(path), theirs)
            total, differ = total + both, differ + len(different)
        share[profile] = 1 - differ / total
    assert share["radon"] == 1
    assert share["mccabe"] == 1
    assert share["lizard"] >= 0.999


@pytest.mark.corpora
@pytest.mark.real
@pytest.mark.timeout(900)
def test_cpp_of_whole_repositories():
    total, differ = 0, 0
    for path in cpp_files(corpora()):
        both, different = compared("lizard", facts_of(path), by_lizard(path))
        total, differ = total + both, differ + len(different)
    assert differ <= 0.004 * total
