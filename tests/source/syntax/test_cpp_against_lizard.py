"""Functions of real C++ compared with those that lizard finds, file by file.

Lizard takes some uses of macros for functions; everything else that it finds is found here too.
"""

import os
from collections import Counter
from pathlib import Path

import pytest

from roslens.source.syntax.cpp import parse_cpp
from roslens.source.syntax.macro.macros import load_macros

lizard = pytest.importorskip("lizard")

ROOT = Path(__file__).parents[3]
ENDINGS = (".h", ".hpp", ".hh", ".c", ".cpp", ".cc", ".cxx")
NO_FUNCTIONS = ("Args", "BENCHMARK_REGISTER_F", "for")
"""What lizard names where ``REGISTER(a, b)->Args({1})`` or a loop behind it looks like a function."""
MOST_FAULTY = 0.04
MOST_MISSING = 0.001


def folders():
    found = [ROOT / "examples", ROOT / "build" / "ros_source" / "ros_comm"]
    if corpora := os.environ.get("ROSLENS_CORPORA"):
        found += [path for path in sorted(Path(corpora).iterdir()) if path.is_dir()]
    return [folder for folder in found if folder.is_dir()]


def sources(folder):
    return [path for path in sorted(folder.rglob("*")) if path.suffix in ENDINGS and path.is_file()]


def ends_of_lizard(path):
    """Return the last lines of the functions that lizard finds."""
    found = lizard.analyze_file.analyze_source_code(str(path), path.read_text("utf-8", "replace")).function_list
    return Counter(one.end_line for one in found if one.name.rpartition("::")[2] not in NO_FUNCTIONS)


@pytest.mark.real
@pytest.mark.timeout(600)
@pytest.mark.parametrize("folder", folders(), ids=lambda folder: folder.name)
def test_functions_agree(folder):
    macros = load_macros()
    files = sources(folder)
    faulty, theirs, missing = [], 0, []
    for path in files:
        facts = parse_cpp(path.read_bytes(), macros)
        if facts.faults:
            faulty.append(path)
        ends = ends_of_lizard(path)
        theirs += sum(ends.values())
        missing += [f"{path}:{line}" for line in (ends - Counter(one.end_line for one in facts.functions))]
    assert len(faulty) <= MOST_FAULTY * len(files), faulty
    assert len(missing) <= MOST_MISSING * theirs, missing
