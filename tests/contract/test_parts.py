"""`make parts` on a machine that has nothing: what it installs it says, and nothing that is missing stops the rest."""

import re
import shutil
import subprocess
from pathlib import Path

import pytest

SCRIPTS = Path(__file__).parents[2] / ".ci"
NEEDED = ("sh", "dirname", "find", "grep", "mkdir", "mktemp", "mv", "rm", "sed", "basename", "touch")
NEVER_FOUND = "#!/bin/sh\nexit 1\n"


@pytest.fixture
def machine(tmp_path):
    """A folder with the scripts, and programs of which each does what a test says."""
    programs = tmp_path / "programs"
    programs.mkdir()
    for name in NEEDED:
        (programs / name).symlink_to(shutil.which(name) or f"/bin/{name}")
    (tmp_path / ".ci").mkdir()
    for name in ("parts", "ros-source"):
        shutil.copy(SCRIPTS / name, tmp_path / ".ci" / name)
    for name in ("ros2", "unpacked"):
        (tmp_path / ".ci" / name).write_text("")

    class Machine:
        root = tmp_path
        asked = tmp_path / "asked"

        def has(self, name, text):
            (programs / name).write_text(text)
            (programs / name).chmod(0o755)

        def run(self, script):
            return subprocess.run(
                ["/bin/sh", f".ci/{script}"], cwd=tmp_path, env={"PATH": str(programs), "TMPDIR": str(tmp_path)},
                capture_output=True, text=True, check=False,
            )  # fmt: skip

    return Machine()


def root_of_nothing(machine, installs="exit 0"):
    machine.has("id", "#!/bin/sh\necho 0\n")
    machine.has("dpkg-query", NEVER_FOUND)
    machine.has("apt-get", f'#!/bin/sh\n[ "$1" = install ] || exit 0\necho "$@" >>{machine.asked}\n{installs}\n')
    (machine.root / ".ci" / "ros-source").write_text("")


def named(line):
    return [word for word in line.split() if not word.startswith("-")][1:]


def test_what_is_installed_is_said_in_one_line(machine):
    root_of_nothing(machine)
    done = machine.run("parts")
    assert (done.returncode, done.stderr) == (0, "")
    (said,) = done.stdout.splitlines()
    assert said.startswith("parts: installing with apt-get: ")
    (asked,) = machine.asked.read_text().splitlines()
    assert named(asked) == said.partition("apt-get: ")[2].split()
    assert {"xz-utils", "gcc", "g++", "cmake", "nodejs", "ros-base", "ros-std-msgs", "ros-sensor-msgs"} < {
        *named(asked)
    }
    assert {"python3-sensor-msgs", "python3-diagnostic-msgs", "ros-actionlib-msgs", "chromium-headless-shell"} < {
        *named(asked)
    }


def test_one_that_cannot_be_had_keeps_no_other_away(machine):
    root_of_nothing(machine, 'case " $* " in *" cccc "*) exit 100 ;; esac')
    done = machine.run("parts")
    assert done.returncode == 0
    assert "could not install cccc; the tests that need it are skipped" in done.stderr
    assert done.stderr.count("could not install") == 1
    alone = [named(line) for line in machine.asked.read_text().splitlines()[1:]]
    assert alone == [[name] for name in named(machine.asked.read_text().splitlines()[0])]


def test_who_may_not_install_is_told_what_is_missing(machine):
    root_of_nothing(machine)
    machine.has("id", "#!/bin/sh\necho 1000\n")
    done = machine.run("parts")
    assert done.returncode == 0
    assert not machine.asked.exists()
    assert "xz-utils" in done.stderr
    assert "ros-std-msgs" in done.stderr


def test_a_machine_with_everything_is_left_alone(machine):
    root_of_nothing(machine)
    machine.has("dpkg-query", "#!/bin/sh\necho installed\n")
    for program in re.findall(
        r"([\w+-]+):", (SCRIPTS / "parts").read_text().partition("programs='")[2].partition("'")[0]
    ):
        machine.has(program, NEVER_FOUND)
    done = machine.run("parts")
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    assert not machine.asked.exists()


def test_source_that_cannot_be_unpacked_stops_nothing_and_leaves_no_part(machine):
    # A tar without the program for what is in the archive.
    machine.has("tar", "#!/bin/sh\nmkdir -p build/half; echo 'tar: xz: Cannot exec' >&2\nexit 2\n")
    machine.has("apt-get", "#!/bin/sh\ncase $* in *source*) : >ros-ros-comm_1.orig.tar.xz ;; esac\n")
    done = machine.run("ros-source")
    assert done.returncode == 0
    assert "source of ros-ros-comm cannot be unpacked here: tests that read it are skipped" in done.stderr
    assert not (machine.root / "build" / "ros_source" / "ros_comm").exists()
    assert not [*(machine.root / "build" / "ros_source").iterdir()]


def unpacks(machine, download):
    shutil.copy(SCRIPTS / "unpacked", machine.root / ".ci" / "unpacked")
    for name in ("chmod", "cp"):
        (machine.root / "programs" / name).symlink_to(shutil.which(name))
    machine.has("apt-get", f"#!/bin/sh\n{download}\n")
    machine.has(
        "dpkg-deb",
        '#!/bin/sh\nmkdir -p "$3/usr/bin"\ncd "$3/usr/bin"; : >promtool; : >amtool; chmod +x *\n',
    )
    return machine.run("unpacked")


def test_what_would_start_a_server_is_unpacked_and_not_installed(machine):
    done = unpacks(machine, f'echo "$*" >>{machine.asked}\n: >"$3_1.deb"')
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    there = {one.name for one in (machine.root / "build" / "unpacked" / "usr" / "bin").iterdir()}
    assert there == {"promtool", "amtool"}
    assert machine.asked.read_text().split("\n") == [
        "-qq download promtool",
        "-qq download prometheus-alertmanager",
        "",
    ]
    again = machine.run("unpacked")
    assert (again.returncode, len(machine.asked.read_text().splitlines())) == (0, 2)


def test_what_cannot_be_downloaded_keeps_the_others(machine):
    done = unpacks(machine, 'case $3 in promtool | prometheus) exit 100 ;; esac\n: >"$3_1.deb"')
    assert done.returncode == 0
    assert done.stderr == (
        "parts: no package of this release has promtool (promtool prometheus); the tests that need it are skipped\n"
    )
    assert (machine.root / "build" / "unpacked" / "usr" / "bin" / "amtool").exists()


def test_a_release_whose_package_has_the_tool_inside_is_asked_for_that(machine):
    done = unpacks(machine, '[ "$3" = promtool ] && exit 100\n: >"$3_1.deb"')
    assert (done.returncode, done.stderr) == (0, "")
    there = {one.name for one in (machine.root / "build" / "unpacked" / "usr" / "bin").iterdir()}
    assert there == {"promtool", "amtool"}
