"""Habits that the tree shows: short files with names that say something."""

from pathlib import Path

SOURCE = Path(__file__).parents[2] / "src" / "roslens"
LONGEST = 400
NAMELESS = {"util", "utils", "helper", "helpers", "common", "base", "manager", "handler", "data", "misc"}


def modules() -> list[Path]:
    found = sorted(SOURCE.rglob("*.py"))
    assert len(found) > 50
    return found


def test_no_file_grows_long():
    long = {str(path.relative_to(SOURCE)): n for path in modules() if (n := path.read_text().count("\n")) > LONGEST}
    assert not long, f"split by idea: {long}"


def test_every_name_says_what_it_is():
    nameless = [str(path.relative_to(SOURCE)) for path in modules() if path.stem in NAMELESS]
    assert not nameless, f"find the verb or noun: {nameless}"


def test_no_machine_path_and_no_open_end_is_left():
    for path in modules():
        text = path.read_text()
        for mark in ("TO" + "DO", "FIX" + "ME", "X" * 3, "raise NotImplemented" + "Error"):
            # Rules name what they look for in the code of others.
            found = f"# {mark}" if "rules" in path.parts else mark
            assert found not in text, f"{path}: {mark}"


def test_what_wants_the_machine_for_itself_is_where_it_is_looked_for():
    tests = Path(__file__).parents[1]
    lines = (tests.parent / "Makefile").read_text().splitlines()
    (folders,) = (line.split()[2:] for line in lines if line.startswith("ALONE"))
    for path in tests.rglob("test_*.py"):
        if "mark." + "slow" in path.read_text():
            assert any(path.is_relative_to(tests.parent / folder) for folder in folders), f"{path}: not in {folders}"


def test_what_drives_a_browser_is_where_it_is_looked_for():
    # Whose conftest marks them all, and says what is missing.
    tests = Path(__file__).parents[1]
    found = [path for path in tests.rglob("*.py") if "mark." + "browser" in path.read_text()]
    assert found == [tests / "browser" / "conftest.py"]
