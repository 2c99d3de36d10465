from roslens.live.inside.environment import PATH, environment, undone


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
