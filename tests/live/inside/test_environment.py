import pytest

from roslens.live.inside import preload
from roslens.live.inside.environment import PATH, environment, undone


@pytest.fixture(autouse=True)
def no_library(monkeypatch):
    monkeypatch.setattr(preload, "library", lambda: None)


def test_it_goes_before_what_is_there_and_comes_off_again():
    base = {"PYTHONPATH": "/a:/b", "HOME": "/root"}
    made = environment(base)
    assert made["PYTHONPATH"] == f"{PATH}:/a:/b"
    assert made["ROSLENS_COUNTERS"].startswith("/dev/shm/roslens-")
    assert undone(base | made) == {"PYTHONPATH": "/a:/b", "ROSLENS_COUNTERS": None}


def test_twice_is_once():
    made = environment({})
    assert environment(made) == made
    assert undone(made) == {"PYTHONPATH": None, "ROSLENS_COUNTERS": None}


def test_a_library_is_preloaded_too(monkeypatch, tmp_path):
    monkeypatch.setattr(preload, "library", lambda: tmp_path / preload.LIBRARY)
    base = {"LD_PRELOAD": "libother.so"}
    made = environment(base)
    assert made["LD_PRELOAD"] == f"{tmp_path / preload.LIBRARY}:libother.so"
    assert made["PYTHONPATH"] == PATH
    assert environment(base | made) == made
    assert undone(base | made) == {"PYTHONPATH": None, "LD_PRELOAD": "libother.so", "ROSLENS_COUNTERS": None}
