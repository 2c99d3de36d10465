"""Whatever is wrong with the input: a clear message, the right exit code, everything else still analysed."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

pytestmark = pytest.mark.timed

CLEAN, FOUND, BAD_INPUT, NOT_ANALYSED = 0, 1, 2, 3


def checked(roslens, robot, *more: str):
    done = roslens("check", robot.root, "--format", "json", "--jobs", "1", *more)
    return done, done.json()


def names(report: dict) -> set[str]:
    return {package["name"] for package in report["packages"]}


def whats(report: dict) -> str:
    return " | ".join(f"{failure['what']} {failure['path']} {failure['advice']}" for failure in report["failures"])


def test_a_clean_workspace_is_clean(roslens, robot):
    robot.package("good")
    done, report = checked(roslens, robot)
    assert (done.code, report["failures"], report["findings"]) == (CLEAN, [], [])


def test_a_path_that_does_not_exist(roslens):
    done = roslens("check", "nowhere")
    assert done.code == BAD_INPUT
    assert "nowhere" in done.err
    assert "does not exist" in done.err


def test_an_empty_workspace(roslens, robot):
    done = roslens("check", robot.root)
    assert done.code == NOT_ANALYSED
    assert "package.xml" in done.out + done.err


def test_broken_xml_loses_only_what_it_says(roslens, robot):
    robot.package("good")
    (robot.package("bad") / "package.xml").write_text("<package><name>bad</name><version>")
    done, report = checked(roslens, robot)
    # No tool builds it: that is an error, besides what could not be analysed.
    assert done.code == FOUND
    assert [(one["rule"], one["path"]) for one in report["findings"] if one["severity"] == "error"] == [
        ("package.broken_manifest", "bad/package.xml")
    ]
    assert "bad/package.xml" in whats(report)
    assert "good" in names(report)
    assert any(entity["path"] == "bad/src/one.cpp" for entity in report["entities"])


def test_a_package_without_a_name(roslens, robot):
    robot.package("good")
    path = robot.package("nameless") / "package.xml"
    path.write_text(path.read_text().replace("<name>nameless</name>", ""))
    done, report = checked(roslens, robot)
    assert done.code == NOT_ANALYSED
    assert "name" in whats(report)
    assert names(report) == {"good", "nameless"}


def test_two_packages_of_one_name(roslens, robot):
    robot.package("twin", folder="a/twin")
    robot.package("twin", folder="b/twin")
    done, report = checked(roslens, robot)
    assert done.code == NOT_ANALYSED
    assert {package["id"] for package in report["packages"]} == {"twin@a/twin", "twin@b/twin"}
    assert "a/twin" in whats(report)
    assert "b/twin" in whats(report)


def test_what_is_no_readable_file_is_told_and_never_waited_for(roslens, robot):
    source = robot.package("good") / "src"
    (source / "gone.cpp").symlink_to("nowhere.cpp")
    os.mkfifo(source / "pipe.cpp")
    done, report = checked(roslens, robot)
    assert done.code == NOT_ANALYSED
    assert "gone.cpp" in whats(report)
    assert any(entity["path"] == "good/src/one.cpp" for entity in report["entities"])


def test_a_file_that_does_not_parse_is_measured_but_for_that_place(roslens, robot):
    robot.package("good", bad__cpp="int f() { return 1; }\nint g() { int = ; }\nint h() { return 2; }\n")
    done, report = checked(roslens, robot)
    assert done.code == NOT_ANALYSED
    (failure, *_) = report["failures"]
    assert failure["line"] == 2
    assert failure["partial"]
    assert any(entity["name"].endswith("f") for entity in report["entities"])
    assert checked(roslens, robot, "--accept-partial")[0].code == CLEAN


def test_odd_bytes_stop_nothing(roslens, robot):
    source = robot.package("odd") / "src"
    (source / "latin1.cpp").write_bytes("// caf\u00e9\nint a() { return 1; }\n".encode("latin-1"))
    (source / "bom.py").write_bytes(b"\xef\xbb\xbfdef a():\n    return 1\n")
    (source / "crlf.cpp").write_bytes(b"int c()\r\n{\r\n  return 1;\r\n}\r\n")
    (source / "zero.cpp").write_bytes(b"int z() { return 1; }\nint y() { return 1; }\n\0\0\0\n")
    (source / "binary.cpp").write_bytes(b"int b() { return 1; }\n\0\0\0\n")
    (source / "empty.cpp").write_bytes(b"")
    (source / "loop").symlink_to(source)
    done, report = checked(roslens, robot)
    measured = {entity["path"] for entity in report["entities"] if entity["kind"] == "file"}
    assert {f"odd/src/{name}" for name in ("latin1.cpp", "bom.py", "crlf.cpp", "zero.cpp", "empty.cpp")} <= measured
    assert "odd/src/binary.cpp" not in measured
    (binary,) = (one for one in report["failures"] if one["path"] == "odd/src/binary.cpp")
    assert binary["what"] == "the file is binary, 3 of 26 bytes are zero"
    assert done.code == NOT_ANALYSED


@pytest.mark.heavy
def test_a_large_table_is_only_slow_and_a_larger_one_is_named(roslens, robot):
    source = robot.package("big") / "src"

    def write(numbers):
        (source / "big.cpp").write_text(
            "// table\nint table[] = {" + "1234567, " * numbers + "};\nint f() { return 1; }\n"
        )

    write(500_000)
    done, report = checked(roslens, robot)
    assert done.code == CLEAN, whats(report)
    write(1_100_000)
    done, report = checked(roslens, robot)
    assert done.code == NOT_ANALYSED
    assert "a file of 9,900,049 bytes; at most 5,000,000 are read" in whats(report)


PLUGIN = """
import os, time
from roslens.plugins.points import Manifest
from roslens.model.finding import RuleInfo
manifest = Manifest(name="{name}", interface="1.0", version="1", text="A plug-in.", languages=("cpp",),
    rules=(RuleInfo(id="{name}.rule", title="t", description="d", rationale="r"),))
def analyse_file(file, report):
    report.finding("{name}.rule", "seen", line=1)
    {body}
"""


@pytest.mark.parametrize(
    ("name", "body", "says"),
    [
        ("raiser", "raise KeyError('boom')", "boom"),
        ("hanger", "time.sleep(600)", "s"),
        ("quitter", "os._exit(7)", ""),
        ("nonsense", "report.finding('nonsense.other', 'x')", "nonsense.other"),
    ],
)
def test_a_bad_plugin_is_a_failure_and_the_rest_stands(roslens, robot, name: str, body: str, says: str):
    robot.package("good")
    (robot.root / "bad.py").write_text(PLUGIN.format(name=name, body=body))
    (robot.root / "fine.py").write_text(PLUGIN.format(name="fine", body="pass"))
    (robot.root / "roslens.toml").write_text('plugins = ["bad.py", "fine.py"]\ntime_limit_s = 2\n')
    roslens("trust", robot.root)
    done, report = checked(roslens, robot)
    assert done.code == NOT_ANALYSED
    failures = [failure for failure in report["failures"] if failure["tool"] == name]
    assert failures, report["failures"]
    assert says in whats(report)
    assert any(finding["rule"] == "fine.rule" for finding in report["findings"])
    assert any(entity["kind"] == "function" for entity in report["entities"])


def test_a_plugin_that_is_not_there(roslens, robot):
    robot.package("good")
    (robot.root / "roslens.toml").write_text('plugins = ["nowhere.py"]\n')
    roslens("trust", robot.root)
    done, report = checked(roslens, robot)
    assert done.code == NOT_ANALYSED
    assert "nowhere.py" in str(report["failures"])


def test_a_model_with_a_typo(roslens, robot):
    robot.package("good")
    (robot.root / "mine.yaml").write_text("model: mine\nconstrains: []\n")
    (robot.root / "roslens.toml").write_text('models = ["mine.yaml"]\n')
    done = roslens("check", robot.root)
    assert done.code == BAD_INPUT
    assert "mine.yaml:" in done.err


def test_a_model_that_is_not_there_names_the_nearest(roslens, robot):
    robot.package("good")
    done = roslens("check", robot.root, "--model", "hiss")
    assert done.code == BAD_INPUT
    assert "his" in done.err


def test_a_configuration_with_a_typo(roslens, robot):
    robot.package("good")
    (robot.root / "roslens.toml").write_text('modles = ["ros"]\n')
    done = roslens("check", robot.root)
    assert done.code == BAD_INPUT
    assert "roslens.toml:1:1" in done.err
    assert "models" in done.err


def test_a_full_disk_says_so_and_leaves_no_half_report(roslens, robot, tmp_path: Path):
    if not Path("/dev/full").exists():
        pytest.skip("this platform has no /dev/full")
    robot.package("good")
    done = roslens("check", robot.root, "--format", "json", "-o", "/dev/full/report.json")
    assert done.code == BAD_INPUT
    assert "/dev/full" in done.err


def test_a_wrong_tag_expression_points_at_the_place(roslens, robot):
    robot.package("good")
    done = roslens("check", robot.root, "--tag", "ros and (metrics")
    assert done.code == BAD_INPUT
    assert "ros and (metrics" in done.err


def test_nothing_was_checked_yet(roslens, robot):
    for verb in ("report", "serve", "clean"):
        done = roslens(verb, robot.root)
        assert done.code == BAD_INPUT
        assert "roslens check" in done.err
