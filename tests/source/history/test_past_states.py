"""How repositories stood together: at releases, at ends of periods; whatever their clocks said."""

from process_metrics.small_repository import BEGIN_S, DAY_S, MANIFEST, SmallRepository, small_repository

from roslens.model.process import Release
from roslens.source.history.chosen_revisions import Every
from roslens.source.history.commit_log import Commit, CommitLog
from roslens.source.history.past_states import PastStates, RepositoryPast
from roslens.source.history.past_trees import PastTrees
from roslens.source.history.read_log import read_log


def commit(name: str, day: float, *parents: str) -> Commit:
    return Commit(name, parents, int(BEGIN_S + day * DAY_S), ())


def past(place: str, *commits: Commit, released: tuple[Release, ...] = ()) -> RepositoryPast:
    return RepositoryPast(place, f"/{place}", "", CommitLog(commits), released)


def reported(states: PastStates, every: str, since_day: float | None = None) -> list[str]:
    since = None if since_day is None else BEGIN_S + since_day * DAY_S
    return [
        " ".join(name or "-" for _, name in one.commits) for one in states.chosen(Every.parse(every), since_s=since)
    ]


ONE = past("one", commit("c", 40, "b"), commit("b", 20, "a"), commit("a", 0))
TWO = past("two", commit("z", 30, "y"), commit("y", 10), released=(Release("1.0", "y", BEGIN_S + 10 * DAY_S),))


def test_each_commit_of_any_is_a_state_of_all():
    assert reported(PastStates([ONE, TWO]), "1") == ["a -", "a y", "b y", "b z", "c z"]
    assert reported(PastStates([ONE, TWO]), "2") == ["a -", "b y", "c z"]
    assert reported(PastStates([ONE, TWO]), "99") == ["c z"]
    assert reported(PastStates([ONE, TWO]), "1", since_day=30) == ["b z", "c z"]


def test_a_release_of_one_and_the_heads():
    states = PastStates([ONE, TWO])
    assert reported(states, "release") == ["a y", "c z"]
    name, state = states.newest_release()
    assert (name, [one for _, one in state.commits]) == ("two 1.0", ["a", "y"])
    assert PastStates([ONE]).newest_release() is None


def test_the_end_of_a_month():
    # 2020-09-13, 10-03, 10-23; 2020-09-23, 10-13
    assert reported(PastStates([ONE, TWO]), "month") == ["a y", "c z"]


def test_a_repository_alone_is_its_commits():
    alone = PastStates([past(".", commit("b", 3, "a"), commit("a", 0))])
    assert alone.is_one
    assert [(one.id, one.time_s - BEGIN_S) for one in alone.chosen(Every.parse("1"))] == [("a", 0), ("b", 3 * DAY_S)]
    assert alone.of_commit("a").commits == ((".", "a"),)
    assert alone.of_commit("x") is None
    assert alone.at(BEGIN_S + DAY_S).id == "a"
    assert PastStates([ONE]).of_commit("a") is None


def test_a_commit_that_is_dated_before_its_parent_loses_nothing():
    # The head says day 5, its parent day 50: at day 50 the repository stood at its head.
    skewed = past("one", commit("c", 5, "b"), commit("b", 50, "a"), commit("a", 0))
    assert reported(PastStates([skewed, TWO]), "1") == ["a -", "c -", "c y", "c z"]
    assert reported(PastStates([skewed, TWO]), "release")[-1] == "c z"
    alone = PastStates([past(".", *skewed.log.commits)])
    assert reported(alone, "1") == ["a", "b", "c"]
    assert reported(alone, "month")[-1] == "c"


def test_states_of_other_repositories_are_others():
    assert PastStates([ONE, TWO]).at(BEGIN_S).id != PastStates([ONE, past("three", commit("x", 9))]).at(BEGIN_S).id


def test_an_octopus_is_one_revision_with_the_files_of_all(tmp_path):
    made = small_repository(tmp_path / "r")
    log = read_log(str(made.root), made.git("rev-parse", "HEAD"))
    (octopus,) = [one for one in log.commits if len(one.parents) > 2]
    assert len(octopus.parents) in (3, 4)
    one = RepositoryPast("r", str(made.root), "", log, ())
    states = PastStates([one])
    assert [state.commits[0][1] for state in states.chosen(Every.parse("1"))].count(octopus.id) == 1
    (tmp_path / "then").mkdir()
    with PastTrees([one], tmp_path / "then") as trees:
        written = trees.show(states.at(octopus.time_s))
        assert {f"r/outer/src/{name}.cpp" for name in ("one", "two", "three")} <= set(written)
        assert not trees.lacking


def test_what_was_not_there_yet_leaves_the_folder_again(tmp_path):
    made = SmallRepository(tmp_path / "r")
    made.commit("first", day=1, p__package_DOT_xml=MANIFEST.format("p"))
    one = RepositoryPast("in/r", str(made.root), "", read_log(str(made.root), made.git("rev-parse", "HEAD")), ())
    (tmp_path / "then").mkdir()
    states = PastStates([one])
    with PastTrees([one], tmp_path / "then") as trees:
        assert trees.show(states.at(BEGIN_S)) == []
        assert trees.show(states.at(BEGIN_S + DAY_S)) == ["in/r/p/package.xml"]
        assert trees.show(states.at(BEGIN_S + DAY_S)) == []
        assert trees.show(states.at(BEGIN_S)) == ["in/r/p/package.xml"]
        assert not (tmp_path / "then/in/r/p").exists()
