"""Mistakes of real robots are told in the buggy revision and not in the fixed one.

``ROSLENS_CORPORA`` may name a folder with clones of the repositories in the table, by their names.
"""

import os
import subprocess
from pathlib import Path

import pytest
from known_mistakes.checkout import check_out
from known_mistakes.golden import KINDS, counts, observed, read, systems
from known_mistakes.page import PAGE, page
from known_mistakes.pairs import missing, pairs, panel_value, told

PAIRS = pairs()


def test_the_page_is_that_of_the_table():
    assert PAGE.read_text() == page()


def test_the_table_is_whole():
    assert len(PAIRS) == len({one.id for one in PAIRS}) == 19
    assert sum(one.peer for one in PAIRS) == 8
    for one in PAIRS:
        assert bool(one.reported) != bool(one.why), one.id
        assert not one.reported or one.launch, one.id


def test_a_revision_is_laid_out_without_pictures(tmp_path):
    clone = tmp_path / "clone"
    clone.mkdir()

    def git(*words):
        return subprocess.run(["git", "-C", str(clone), *words], check=True, capture_output=True, text=True).stdout

    git("init", "-q")
    (clone / "a.cpp").write_text("int a;\n")
    (clone / "a.png").write_text("picture")
    git("add", "-A")
    git("-c", "user.name=a", "-c", "user.email=a@a", "commit", "-qm", "one")
    check_out(clone, git("rev-parse", "HEAD").strip(), tmp_path / "out")
    assert [path.name for path in (tmp_path / "out").rglob("*")] == ["a.cpp"]
    assert (tmp_path / "out" / "a.cpp").read_text() == "int a;\n"


def test_what_a_control_panel_gives_is_read_from_its_file(tmp_path):
    pair = next(one for one in PAIRS if one.panel)
    file = tmp_path / pair.panel[0]
    file.parent.mkdir(parents=True)
    file.write_text(f"params: [{{name: {pair.panel[1]}, vars: [{{name: {pair.panel[2]}, v: /a/b}}]}}]")
    assert panel_value(pair, tmp_path) == "/a/b"
    assert panel_value(PAIRS[0], tmp_path) == ""


@pytest.mark.corpora
@pytest.mark.heavy
@pytest.mark.parametrize("pair", [one for one in PAIRS if one.launch], ids=lambda one: one.id)
def test_a_mistake_is_told_and_its_correction_is_not(pair, tmp_path):
    clones = Path(os.environ.get("ROSLENS_CORPORA", ""))
    absent = missing(pair, clones) if clones.name else ["any repository"]
    if absent:
        pytest.skip(f"ROSLENS_CORPORA names no folder with {', '.join(absent)}")
    buggy, fixed = (told(pair, side, clones, tmp_path / str(side)) for side in (0, 1))
    if pair.reported:
        assert pair.reported in buggy.findings
        assert pair.reported not in fixed.findings
        assert not pair.joined or pair.joined in fixed.joined
        assert pair.joined not in buggy.joined
    else:
        assert set(buggy.findings) == set(fixed.findings), "it is found now: the table can say so"


@pytest.mark.corpora
@pytest.mark.heavy
@pytest.mark.parametrize("system", systems(), ids=lambda one: one.id)
def test_of_a_running_robot_source_says_what_the_table_has(system, tmp_path):
    clones = Path(os.environ.get("ROSLENS_CORPORA", ""))
    absent = [name for name in (*system.trees, "rosdiscover-evaluation") if not (clones / name).is_dir()]
    if not clones.name or absent:
        pytest.skip(f"ROSLENS_CORPORA names no folder with {', '.join(absent)}")
    seen = observed(system, clones)
    every, sure = read(system, clones, tmp_path)
    table = [{kind: told.get(kind, 0) for kind in KINDS} for told in (system.seen, system.found, system.right)]
    assert [counts(seen), counts(seen & every), counts(seen & sure)] == table
