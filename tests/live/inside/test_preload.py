import pytest

from roslens.live.inside import preload
from roslens.live.inside.preload import LIBRARY, library, preload_environment, preload_undone, why_no_library


@pytest.fixture
def place(tmp_path, monkeypatch):
    """Where a package and its repository are looked for: a folder of the test's own."""
    monkeypatch.setattr(preload, "_HERE", tmp_path / "inside")
    monkeypatch.setattr(preload, "_REPOSITORY", tmp_path)
    monkeypatch.setattr("sys.platform", "linux")
    return tmp_path


def put(folder):
    folder.mkdir(parents=True)
    (folder / LIBRARY).touch()
    return folder / LIBRARY


def test_beside_the_module_first_then_where_a_repository_builds_it(place):
    built = put(place / "build" / "native")
    assert library() == built
    beside = put(place / "inside")
    assert library() == beside
    assert why_no_library() == ""


def test_without_library_nothing_is_set_and_it_says_why(place):
    assert library() is None
    assert preload_environment({"LD_PRELOAD": "libother.so"}) == {}
    assert f"{LIBRARY} is not in {place / 'inside'}" in why_no_library()
    assert "Install a C compiler" in why_no_library()


def test_elsewhere_than_on_linux(place, monkeypatch):
    monkeypatch.setattr("sys.platform", "darwin")
    assert "cannot be counted from inside on darwin" in why_no_library()


@pytest.mark.parametrize("separator", [" ", ":"])
def test_a_path_that_would_be_taken_apart(place, monkeypatch, separator):
    monkeypatch.setattr(preload, "_HERE", place / f"my{separator}robot")
    path = put(place / f"my{separator}robot")
    assert library() is None
    assert preload_environment({}) == {}
    assert f'"{path}" cannot be preloaded' in why_no_library()


@pytest.mark.parametrize(
    "there", ["libone.so:/x/libtwo.so", "libone.so /x/libtwo.so", f"libone.so:/old/{LIBRARY}: /x/libtwo.so"]
)
def test_what_was_preloaded_stays(place, there):
    path = put(place / "inside")
    made = preload_environment({"LD_PRELOAD": there, "ROSLENS_COUNTERS": "/c"})
    assert made == {"LD_PRELOAD": f"{path}:libone.so:/x/libtwo.so", "ROSLENS_COUNTERS": "/c"}
    assert preload_undone(made) == {"LD_PRELOAD": "libone.so:/x/libtwo.so", "ROSLENS_COUNTERS": None}


def test_undone_names_nothing_without_need(place):
    put(place / "inside")
    assert preload_undone({"LD_PRELOAD": "libone.so"}) == {}
    assert preload_undone(preload_environment({})) == {"LD_PRELOAD": None, "ROSLENS_COUNTERS": None}
