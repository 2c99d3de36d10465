"""A package that was moved to another folder keeps its commits; one that looks like another does not get them."""

import pytest
from process_metrics.against_git import differences, process_of
from process_metrics.small_repository import MANIFEST, SmallRepository, function


@pytest.fixture
def made(tmp_path) -> SmallRepository:
    one = SmallRepository(tmp_path / "r")
    one.write("arm/package.xml", MANIFEST.format("arm"))
    one.commit("first", day=0, arm__src__a_DOT_cpp=function("a", 1))
    one.commit("second", day=1, arm__src__a_DOT_cpp=function("a", 2))
    return one


def move(made: SmallRepository, old: str, new: str, day: float) -> None:
    (made.root / new).parent.mkdir(parents=True, exist_ok=True)
    made.git("mv", old, new)
    made.commit(f"{old} to {new}", day=day)


def test_commits_count_under_all_folders(made):
    move(made, "arm", "stack/arm", 2)
    made.commit("third", day=3, stack__arm__src__a_DOT_cpp=function("a", 5))
    move(made, "stack/arm", "stack/arm_driver", 4)
    made.commit("elsewhere", day=5, README="x\n")
    found = process_of(made.root)
    assert found.packages["arm"]["revisions"] == 5
    assert (found.packages["arm"]["age"], found.packages["arm"]["time_since_last_commit"]) == (5, 1)
    assert differences(made.root)[1] == []


def test_who_has_the_folder_now_got_it_later(made):
    move(made, "arm", "arm_old", 2)
    made.write("arm/package.xml", MANIFEST.format("arm").replace("<name>arm<", "<name>new_arm<"))
    made.commit("anew", day=3, arm__b_DOT_py="x = 1\ny = 2\n")
    found = process_of(made.root)
    assert {name: values["revisions"] for name, values in found.packages.items()} == {"arm": 3, "new_arm": 1}
    assert differences(made.root)[1] == []


def test_from_the_top_into_a_folder(tmp_path):
    made = SmallRepository(tmp_path / "r")
    made.write("package.xml", MANIFEST.format("arm"))
    made.commit("first", day=0, src__a_DOT_cpp=function("a", 1))
    made.commit("second", day=1, README="x\n")
    (made.root / "arm").mkdir()
    made.git("mv", "package.xml", "src", "arm")
    made.write("base/package.xml", MANIFEST.format("base"))
    made.commit("into folders", day=2)
    made.commit("of all", day=3, README="x\ny\n")
    found = process_of(made.root)
    assert {name: values["revisions"] for name, values in found.packages.items()} == {"arm": 3, "base": 1}
    assert differences(made.root)[1] == []


def test_a_manifest_alone_that_is_much_alike_is_no_move(made):
    made.git("rm", "-rq", "arm")
    made.write("leg/package.xml", MANIFEST.format("leg"))
    made.commit("another one", day=2, leg__walk_DOT_py="def walk():\n    return 1\n" * 9)
    assert process_of(made.root).packages["leg"]["revisions"] == 1
    assert differences(made.root)[1] == []


def test_a_package_without_other_files_is_followed_where_its_folder_keeps_its_name(tmp_path):
    made = SmallRepository(tmp_path / "r")
    made.write("robot/package.xml", MANIFEST.format("robot"))
    made.commit("first", day=0)
    move(made, "robot", "meta/robot", 1)
    assert process_of(made.root).packages["robot"]["revisions"] == 2
    assert differences(made.root)[1] == []


def test_packages_that_were_moved_change_together_with_others(made):
    made.write("base/package.xml", MANIFEST.format("base"))
    for number in range(6):
        made.commit(
            f"both {number}", day=2 + number,
            arm__src__a_DOT_cpp=function("a", 4 + number), base__b_DOT_cpp=function("b", number),
        )  # fmt: skip
    move(made, "arm", "stack/arm", 9)
    (pair,) = process_of(made.root).coupled_packages
    assert (pair.first, pair.second, pair.shared) == ("arm", "base", 6)
    assert differences(made.root)[1] == []


def test_commits_of_a_branch_count_where_the_package_lies_in_it(made):
    """Whether the branch stands above or below the move in git's order."""
    made.git("checkout", "-q", "-b", "side")
    made.commit("beside the move", day=5, arm__src__a_DOT_cpp=function("a", 7))
    made.git("checkout", "-q", "main")
    move(made, "arm", "stack/arm", 2)
    made.commit("after the move", day=3, stack__arm__b_DOT_cpp=function("b", 1))
    for branch, into in (("main", "side"), ("side", "main")):
        made.git("checkout", "-q", into)
        made.git("checkout", "-q", "-b", f"{branch}-into-{into}")
        made.git("merge", "-q", "--no-edit", branch, day=9)
        assert process_of(made.root).packages["arm"]["revisions"] == 5
        assert differences(made.root)[1] == []


def test_who_has_the_folder_now_gets_no_commits_of_a_branch_beside_the_move(made):
    made.git("checkout", "-q", "-b", "side")
    made.commit("beside the move", day=5, arm__src__a_DOT_cpp=function("a", 7))
    made.git("checkout", "-q", "main")
    move(made, "arm", "arm_old", 2)
    made.git("merge", "-q", "--no-edit", "side", day=6)
    made.write("arm/package.xml", MANIFEST.format("arm").replace("<name>arm<", "<name>new_arm<"))
    made.commit("anew", day=7, arm__b_DOT_py="x = 1\ny = 2\n")
    found = process_of(made.root)
    assert {name: values["revisions"] for name, values in found.packages.items()} == {"arm": 4, "new_arm": 1}
    assert differences(made.root)[1] == []


def test_a_move_that_two_branches_made_is_undone_where_neither_was_made(made):
    made.git("checkout", "-q", "-b", "side")
    move(made, "arm", "stack/arm", 3)
    made.commit("in the branch", day=4, stack__arm__c_DOT_cpp=function("c", 1))
    made.git("checkout", "-q", "main")
    move(made, "arm", "stack/arm", 5)
    made.commit("here", day=6, stack__arm__d_DOT_cpp=function("d", 1))
    made.git("merge", "-q", "--no-edit", "side", day=7)
    assert process_of(made.root).packages["arm"]["revisions"] == 6
    assert differences(made.root)[1] == []
