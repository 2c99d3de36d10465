"""Files are shared out to few calls, and what fails is found without losing the rest."""

from threading import Event

import pytest

from roslens.model.source import Language, SourceFile
from roslens.source.tools.running.batches import MOST_RETRIES, Batches, batches
from roslens.source.tools.running.run_tool import Ended, ToolError, ToolHangError
from roslens.source.tools.tool import Reading, Request, Tool, ToolFinding


class Played(Tool):
    name = "played"
    program = "played"
    languages = ("cpp",)
    at_once = 50

    def words(self, request):
        return ["played", *request.files]

    def read(self, ended, request):
        return Reading(tuple(ToolFinding(file[2:], 1, 0, "check", "m") for file in request.files))


class Runner:
    def __init__(self, bad=(), hangs=""):
        self.calls = []
        self.hangs = hangs
        self.limits = []
        self.bad = set(bad)

    def run(self, words, *, folder, time_limit_s, safe_path=True, sandbox=None, variables=None):
        self.calls.append(words[1:])
        if self.bad & set(words[1:]):
            raise ToolError("was ended by SIGSEGV")
        if self.hangs in words[1:]:
            self.limits.append(time_limit_s)
            raise ToolHangError(f"did not end within {time_limit_s:g} s")
        return Ended(0, b"", b"")

    def end_all(self):
        pass


def files(count, size=100):
    return [SourceFile(f"f{number:03}.cpp", Language.CPP, size=size + number) for number in range(count)]


def looked(given, runner, jobs=2):
    tool = Played()
    request = Request("played", "/robot", (), {}, "")
    return Batches(tool, request, runner, jobs=jobs, time_limit_s=5).look_at(given)


@pytest.mark.parametrize(("count", "jobs", "calls"), [(0, 2, 0), (5, 4, 1), (40, 2, 2), (170, 2, 4)])
def test_few_calls(count, jobs, calls):
    shares = batches(Played(), files(count), jobs)
    assert len(shares) == calls
    assert sorted(path for share in shares for path in share) == [file.path for file in files(count)]
    assert all(len(share) <= 50 for share in shares)


def test_large_files_are_shared_out():
    given = [*files(10), SourceFile("large.cpp", Language.CPP, size=10_000)]
    assert ("large.cpp",) in batches(Played(), given, 2)


def test_all_is_told():
    runner = Runner()
    result = looked(files(20), runner)
    assert len(runner.calls) == 2
    assert len(result.findings) == 20
    assert result.failed == ()


def test_one_file_that_crashes_it_is_found_and_the_others_stand():
    runner = Runner(bad=["./f007.cpp"])
    result = looked(files(20), runner)
    assert result.failed == (("was ended by SIGSEGV", ("f007.cpp",)),)
    assert len(result.findings) == 19


def test_one_file_that_it_hangs_on_is_found_in_twice_the_time():
    runner = Runner(hangs="./f007.cpp")
    request = Request("played", "/robot", (), {}, "")
    result = Batches(Played(), request, runner, jobs=1, time_limit_s=600).look_at(files(40))
    assert [paths for _, paths in result.failed] == [("f007.cpp",)]
    assert len(result.findings) == 39
    assert runner.limits == [600, 300, 150, 75, 37.5, 20]


def test_a_tool_that_always_fails_is_not_tried_for_ever():
    given = files(300)
    runner = Runner(bad=[f"./{file.path}" for file in given])
    result = looked(given, runner)
    assert len(runner.calls) <= 6 + MOST_RETRIES
    assert [(why, len(paths)) for why, paths in result.failed] == [("was ended by SIGSEGV", 300)]
    assert result.findings == {}


def test_a_finding_in_a_header_is_kept_with_each_file_of_the_call():
    class Header(Played):
        def read(self, ended, request):
            return Reading((ToolFinding("h.hpp", 1, 0, "check", "m"), ToolFinding("", 1, 0, "check", "elsewhere")))

    request = Request("played", "/robot", (), {}, "")
    result = Batches(Header(), request, Runner(), jobs=1, time_limit_s=5).look_at(files(2))
    assert {path: [one.path for one in found] for path, found in result.findings.items()} == {
        "f000.cpp": ["h.hpp"],
        "f001.cpp": ["h.hpp"],
    }


def test_a_reader_that_breaks_is_a_failure_of_the_tool():
    class Broken(Played):
        def read(self, ended, request):
            raise KeyError("column")

    request = Request("played", "/robot", (), {}, "")
    result = Batches(Broken(), request, Runner(), jobs=1, time_limit_s=5).look_at(files(1))
    assert result.failed == (("printed what cannot be read: KeyError: 'column'", ("f000.cpp",)),)


def test_what_calls_found_is_heard_of_while_others_are_still_to_come():
    heard, one_came = [], Event()

    class Ending(Runner):
        def run(self, words, **more):
            if len(self.calls) == 1:
                assert one_came.wait(30.0), "nothing was heard of the first call"
                raise KeyboardInterrupt
            return super().run(words, **more)

    def keep(found):
        heard.append(found)
        one_came.set()

    request = Request("played", "/robot", (), {}, "")
    looking = Batches(Played(), request, Ending(), jobs=1, time_limit_s=5, keep=keep)
    with pytest.raises(KeyboardInterrupt):
        looking.look_at(files(100))
    assert [len(found) for found in heard] == [50]
