"""What plug-ins report arrives; what they break stays theirs."""

import os
import subprocess
import sys
import tempfile
import threading
import time
import tracemalloc
from pathlib import Path

import msgspec
import pytest

from roslens.model.finding import Severity
from roslens.model.quantity import Measurement
from roslens.plugins.isolation import run_package, run_plugins
from roslens.plugins.points import WorkspaceInput
from roslens.plugins.pool import ProcessWorkers

pytestmark = pytest.mark.timed

BEHAVE = "# behave\ncode\n"


def messages(outcome, path=""):
    return [finding.message for finding in outcome.findings if not path or finding.path == path]


def test_findings_and_values_get_all_their_parts(member, make_package):
    package = make_package({"a.py": "x\n  goto end\n", "b.xml": "goto"})
    outcome = run_package(member("orderly.py"), package)
    assert not outcome.failures
    (finding,) = outcome.findings
    assert (finding.rule, finding.severity, finding.tags, finding.tool) == (
        "orderly.word",
        Severity.ERROR,
        ("words",),
        "orderly",
    )
    assert (finding.path, finding.line, finding.column) == ("pack/a.py", 2, 3)
    assert finding.entity == "function:pack/a.py#f()", "the innermost entity around the line"
    assert len(finding.fingerprint) == 16
    assert [(m.entity, m.quantity, m.value) for m in outcome.measurements] == [("file:pack/a.py", "orderly.words", 1.0)]


def test_fingerprints_survive_line_moves_and_tell_twins_apart(member, make_package):
    prints = []
    for text in ("goto x\ngoto y\ngoto x\n", "\n\n\n\n\n  goto x\ngoto y\ngoto   x\n"):
        package = make_package({"a.cpp": text})
        package = msgspec.structs.replace(package, entities=package.entities[:2])
        outcome = run_package(member("orderly.py"), package, options={"orderly": {"most": 9}}, jobs=0)
        prints.append([finding.fingerprint for finding in outcome.findings])
    assert len(set(prints[0])) == 3
    assert prints[0] == prints[1]


def test_package_hooks_see_what_file_hooks_measured(member, make_package):
    package = make_package({"a.py": "goto\ngoto\n", "b.py": "goto\n"})
    assert "3 words" in messages(run_package(member("orderly.py"), package))
    loose = run_package(member("orderly.py"), package, options={"orderly": {"most": 3}})
    assert "3 words" not in messages(loose)


def test_options_reach_the_plugin_and_wrong_ones_leave_it_out(member, make_package):
    package = make_package({"a.py": "jump\n"})
    found = run_package(member("orderly.py"), package, options={"orderly": {"word": "jump"}}, jobs=0)
    assert messages(found) == ["the word 'jump'"]
    wrong = run_package(member("orderly.py"), package, options={"orderly": {"wrod": "jump"}}, jobs=0)
    assert not wrong.findings
    assert str(wrong.failures[0]) == (
        "plug-in 'orderly' is left out: [options.orderly] wrod: unknown option 'wrod'; "
        "expected one of most, word. Did you mean 'word'?"
    )


CRASHES = {
    "raise": "ValueError: boom in two lines",
    "exit": "it called sys.exit(3)",
    "hard exit": "its process ended with exit code 4",
    "segfault": "its process was ended by SIGSEGV",
    "hang": "it took longer than 1 s",
    "hang with child": "it took longer than 1 s",
    "close pipes": "it closed the connection to roslens",
    "recurse": "RecursionError: maximum recursion depth exceeded",
}


def test_a_crash_loses_one_file_of_one_plugin(member, make_package, tmp_path):
    log = tmp_path / "log"
    files = {f"{act}.py": f"# {act}\ngoto\n" for act in CRASHES} | {"a.py": BEHAVE, "z.py": BEHAVE}
    outcome = run_package(
        member("misbehaving.py", "orderly.py"), make_package(files), time_limit_s=1.0, log=log, jobs=2
    )
    assert {m.entity for m in outcome.measurements} == {f"file:pack/{name}" for name in files}, "the other plug-in"
    for path in ("pack/a.py", "pack/z.py"):
        assert messages(outcome, path) == ["seen after", "seen before"]
    failures = {failure.entity: failure for failure in outcome.failures}
    assert len(failures) == len(outcome.failures) == len(CRASHES)
    for act, why in CRASHES.items():
        failure = failures[f"file:pack/{act}.py"]
        assert failure.what.startswith(f"plug-in 'misbehaving' failed while running analyse_file: {why}")
        assert str(failure).startswith(f"pack/{act}.py: plug-in 'misbehaving' failed")
        assert (failure.tool, failure.package) == ("misbehaving", "pack")
        assert "the word 'goto'" in messages(outcome, f"pack/{act}.py")
    for act in ("raise", "exit", "recurse"):
        assert "Traceback" in failures[f"file:pack/{act}.py"].detail
        assert "seen before" in messages(outcome, f"pack/{act}.py"), "what was reported before stays"
    assert "Segmentation fault" in failures["file:pack/segfault.py"].detail
    assert "ValueError: boom" in log.read_text()


def test_children_of_a_plugin_that_hangs_are_gone(member, make_package):
    before = _sleepers()
    run_package(member("misbehaving.py"), make_package({"a.py": "# hang with child\n"}), time_limit_s=0.5)
    # Other tests may have theirs, which come and go.
    assert _sleepers() <= before


def test_a_hook_that_forks_reports_once(member, make_package):
    outcome = run_package(member("misbehaving.py"), make_package({"a.py": "# fork\n", "b.py": BEHAVE}), jobs=1)
    assert not outcome.failures
    assert messages(outcome, "pack/a.py") == messages(outcome, "pack/b.py") == ["seen after", "seen before"]


def test_what_a_hook_leaves_running_is_gone_at_the_end(member, make_package):
    before = _sleepers()
    outcome = run_package(member("misbehaving.py"), make_package({"a.py": "# fork and stay\n"}))
    assert not outcome.failures
    assert _comes_true(lambda: _sleepers() <= before)


def test_a_hook_that_takes_too_much_of_the_machine_loses_its_file(member, make_package):
    """Memory, files, and what is said at once, which does not make this process grow."""
    acts = {
        "say much": "at most 32,000,000 are taken",
        "take memory": "MemoryError",
        "write a large file": "OSError: [Errno 27] File too large",
    }
    files = {f"{act}.py": f"# {act}\n" for act in acts} | {"z.py": BEHAVE}
    tracemalloc.start()
    try:
        outcome = run_package(member("misbehaving.py"), make_package(files), jobs=1)
        _, most = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert most < 20_000_000
    why = {failure.entity: failure.what for failure in outcome.failures}
    assert len(why) == len(acts)
    for act, reason in acts.items():
        assert reason in why[f"file:pack/{act}.py"]
    assert messages(outcome, "pack/z.py") == ["seen after", "seen before"]


def _sleepers():
    found = set()
    for entry in os.scandir("/proc"):
        if entry.name.isdigit():
            try:
                if Path(entry.path, "cmdline").read_bytes() == b"sleep\x001000\x00":
                    found.add(entry.name)
            except OSError:
                continue
    return found


BREACHES = {
    "unknown rule": ("rule 'misbehaving.sean' is not declared", "Did you mean 'misbehaving.seen'?"),
    "unknown quantity": ("quantity 'misbehaving.shore' is not declared", "Did you mean 'misbehaving.share'?"),
    "nan": ("misbehaving.share is nan; expected a number from 0 to 1", ""),
    "too much": ("misbehaving.share is 2; expected a number from 0 to 1", ""),
    "no number": ("misbehaving.share is 'much'; expected a number", ""),
    "wrong entity": ("entity 'file:elsewhere.py' is not here", ""),
    "wrong kind": ("a value of 'misbehaving.share' for a function; expected a file", ""),
    "wrong path": ("path '/etc/passwd' is not one of the files it was given", ""),
    "wrong line": ("line 99 is behind the end of pack/wrong line.py", ""),
    "no line": ("line is 'one'; expected a whole number from 1", ""),
    "twice": ("0.25 and 0.5 for 'misbehaving.share' of one entity; expected one value", ""),
}


@pytest.mark.parametrize("jobs", [0, 1])
def test_a_breach_loses_one_report(jobs, member, make_package):
    package = make_package({f"{act}.py": f"# {act}\n" for act in BREACHES})
    outcome = run_package(member("misbehaving.py"), package, jobs=jobs)
    failures = {failure.entity: failure for failure in outcome.failures}
    for act, (what, advice) in BREACHES.items():
        path = f"pack/{act}.py"
        assert messages(outcome, path) == ["seen after", "seen before"]
        named = f"function:{path}#f()" if act == "wrong kind" else f"file:{path}"
        failure = failures[named]
        assert f"plug-in 'misbehaving' breaks the contract: {what}" in str(failure)
        assert advice in str(failure)
        assert failure.partial
        if act != "twice":
            assert str(failure).startswith(f"{path}")
            assert "misbehaving.py" in failure.detail, "the author is told where"
    assert len(outcome.failures) == len(BREACHES)


def test_a_breach_in_every_file_is_told_once(member, make_package):
    files = {f"f{number}.py": "# unknown rule\n" for number in range(5)}
    outcome = run_package(member("misbehaving.py"), make_package(files), jobs=0)
    (failure,) = outcome.failures
    assert "(and 4 more times)" in failure.what
    assert failure.location is not None
    assert failure.location.path == "pack/f0.py"


def test_odd_text_and_folders_do_no_harm(member, make_package):
    files = {"a.py": "# surrogate\n", "b.py": "# change folder\n", "c.py": "# where\n", "d.py": "# own failure\n"}
    outcome = run_package(member("misbehaving.py"), make_package(files))
    assert "odd \\udcff text" in messages(outcome)
    assert "in /" not in messages(outcome)
    (failure,) = outcome.failures
    assert str(failure) == "pack/d.py:1: half of it is strange; expected all plain"
    assert failure.tool == "misbehaving"


def test_what_plugins_print_goes_to_the_log(member, make_package, tmp_path, capfd):
    log = tmp_path / "log"
    files = {"a.py": "# print\n", "b.py": "# read stdin\n"}
    outcome = run_package(member("misbehaving.py"), make_package(files), log=log)
    assert capfd.readouterr() == ("", "")
    text = log.read_text()
    for line in ("printed by python", "written to descriptor one", "printed by a child", "to standard error"):
        assert line in text
    assert "[misbehaving: pack/a.py]" in text
    assert "read ''" in messages(outcome)


def test_a_step_that_is_heard_late_keeps_what_it_printed(member, make_package, tmp_path, monkeypatch):
    read = os.read

    def late(descriptor, size):
        for _ in range(60):
            if any(b"to standard error" in one.read_bytes() for one in tmp_path.glob("roslens-*/output-*")):
                break
            time.sleep(0.01)
        return read(descriptor, size)

    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    monkeypatch.setattr("roslens.plugins.pool.os.read", late)
    log = tmp_path / "log"
    run_package(member("misbehaving.py"), make_package({"a.py": "# print\n"}), log=log)
    assert log.read_text().startswith("[misbehaving: pack/a.py]\n")


def test_a_log_that_cannot_be_written_stops_nothing(member, make_package, tmp_path):
    (tmp_path / "file").touch()
    package = make_package({"a.py": "# print\n", "b.py": "# raise\n"})
    outcome = run_package(member("misbehaving.py"), package, log=tmp_path / "file" / "log")
    assert len(outcome.failures) == 1


def test_a_flood_of_output_is_cut(member, make_package, tmp_path):
    outcome = run_package(member("misbehaving.py"), make_package({"a.py": "# flood\n"}), log=tmp_path / "log")
    assert not outcome.failures
    text = (tmp_path / "log").read_text()
    assert len(text) < 2 << 20
    assert "bytes left out)" in text
    assert "the last line" in text


def test_workers_end_with_their_parent(fixtures, tmp_path):
    """A parent that is killed leaves nothing behind, not even a program that a hook waits for."""
    (tmp_path / "a.py").write_text("# hang with child\n")
    before = _sleepers()
    code = (
        "from roslens.plugins.contract import look_at; from pathlib import Path; "
        f"look_at({str(fixtures / 'misbehaving.py')!r}, Path({str(tmp_path / 'a.py')!r}))"
    )
    with subprocess.Popen([sys.executable, "-c", code]) as parent:
        assert _comes_true(lambda: _sleepers() - before)
        parent.kill()
    assert _comes_true(lambda: not _sleepers() - before)


def _comes_true(what, seconds=30.0):
    """Wait for something that another process does."""
    deadline = time.monotonic() + seconds
    pause = threading.Event()
    while not (true := what()) and time.monotonic() < deadline:
        pause.wait(0.05)
    return bool(true)


def test_a_file_that_cannot_be_read_is_a_failure(member, make_package):
    package = make_package({"a.py": "goto\n", "b.py": "goto\n"})
    Path(package.files[0].absolute).unlink()
    outcome = run_package(member("misbehaving.py", "orderly.py"), package)
    (failure,) = [failure for failure in outcome.failures if failure.tool == "read"]
    assert str(failure).startswith("pack/a.py: FileNotFoundError: No such file or directory; expected a file that can")
    assert "the word 'goto'" in messages(outcome, "pack/b.py")


def test_a_name_that_is_no_text_is_a_failure(member, make_package):
    package = make_package({"a.py": "goto\n"})
    odd = msgspec.structs.replace(package.files[0], path="pack/\udcff.py", absolute="/nowhere/\udcff.py")
    outcome = run_package(member("orderly.py"), msgspec.structs.replace(package, files=(*package.files, odd)))
    assert messages(outcome) == ["the word 'goto'"]
    assert "udcff.py' is not UTF-8" in str(outcome.failures[0])


def test_a_plugin_that_hangs_again_and_again_is_given_up(member, make_package):
    files = {f"f{number}.py": "# hang\n" for number in range(6)}
    started = time.monotonic()
    outcome = run_package(member("misbehaving.py", "orderly.py"), make_package(files), time_limit_s=0.3)
    assert time.monotonic() - started < 60, "it hangs for ever"
    assert sum("took longer" in failure.what for failure in outcome.failures) == 3
    assert sum("is not called again: it hung 3 times" in failure.what for failure in outcome.failures) == 1
    assert len(outcome.measurements) == 6, "the other plug-in saw all files"


def test_results_are_the_same_however_many_workers(member, make_package):
    files = {f"f{number:02}.py": f"goto {number}\n" * (number % 4) for number in range(40)}
    package = make_package(files)
    members = member("misbehaving.py", "orderly.py")
    outcomes = [run_package(members, package, jobs=jobs) for jobs in (0, 1, 3)]
    assert outcomes[0].findings
    assert outcomes[0].findings == outcomes[1].findings == outcomes[2].findings
    assert outcomes[0].measurements == outcomes[1].measurements == outcomes[2].measurements
    assert [str(f) for f in outcomes[1].failures] == [str(f) for f in outcomes[2].failures]


def test_workers_are_kept_over_packages(member, make_package):
    heard = []
    with ProcessWorkers(1) as workers:
        for name in ("one", "two"):
            package = make_package({"a.py": "goto\n"}, name)
            outcome = run_package(member("orderly.py"), package, workers=workers, progress=heard.append)
            assert messages(outcome) == ["the word 'goto'"]
        assert workers.started == 1
    assert heard == [
        "orderly: one/a.py",
        "orderly: analyse_package",
        "orderly: two/a.py",
        "orderly: analyse_package",
    ]


def wide_workspace(make_package, *names):
    packages = tuple(make_package({"a.py": "goto\n"}, name, repository=f"{name[0]}_repo") for name in names)
    return WorkspaceInput(str(Path(packages[0].folder).parent), packages)


def test_wide_hooks_run_and_results_come_last(member, make_package):
    workspace = wide_workspace(make_package, "good", "plain")
    outcome = run_plugins(member("wide.py", "orderly.py"), workspace)
    assert not outcome.failures
    assert messages(outcome) == sorted(
        [
            "a package",
            "a package",
            "memory: remembered; scratch is a folder: True",
            "repository g_repo: good",
            "repository p_repo: plain",
            "results: 5 notes, ['wide.files'], ['wide.files'], remembered",
        ],
        key=messages(outcome).index,
    )
    assert {finding.entity for finding in outcome.findings} == {
        "package:good",
        "package:plain",
        "repository:g_repo",
        "repository:p_repo",
        "workspace:.",
    }


def test_wide_hooks_see_what_was_measured_before(member, make_package):
    workspace = wide_workspace(make_package, "good")
    known = [Measurement("package:good", "orderly.words", 5.0)]
    outcome = run_plugins(member("wide.py"), workspace, measurements=known)
    assert "results: 3 notes, ['orderly.words', 'wide.files'], ['orderly.words', 'wide.files'], remembered" in messages(
        outcome
    )


def test_a_part_that_fails_loses_itself_alone(member, make_package):
    workspace = wide_workspace(make_package, "a", "dies", "hangs", "raises", "z")
    outcome = run_plugins(member("wide.py"), workspace, time_limit_s=1.0)
    assert [(failure.package, failure.what.partition(": ")[2]) for failure in outcome.failures] == [
        ("dies", "its process ended with exit code 9"),
        ("hangs", "it took longer than 1 s"),
        ("raises", "KeyError: 'no'"),
    ]
    assert {m.entity for m in outcome.measurements} == {"package:a", "package:raises", "package:z"}
    assert any(message.startswith("memory: remembered;") for message in messages(outcome))
    assert any(message.startswith("results:") for message in messages(outcome))
