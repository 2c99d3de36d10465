"""The library is part of what is installed where there is a compiler, and left out where there is none."""

import ctypes
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
MEMBER = "roslens/live/inside/libroslens_rmw_hook.so"


@pytest.fixture
def package(build, tmp_path):
    """The parts of the repository that a build takes, and a small source."""
    root = tmp_path / "package"
    shutil.copytree(ROOT / "native", root / "native")
    for name in ("pyproject.toml", "hatch_build.py", "README.md", "LICENSE"):
        shutil.copy(ROOT / name, root / name)
    source = root / "src" / "roslens"
    (source / "live" / "inside").mkdir(parents=True)
    shutil.copy(ROOT / "src" / "roslens" / "__init__.py", source)
    return root


def built(package, kind, **environment):
    out = package / "dist"
    done = subprocess.run(
        [sys.executable, "-c", f"from hatchling.build import build_{kind} as build; build({str(out)!r})"],
        cwd=package, env={"PATH": "/usr/bin:/bin", **environment}, capture_output=True, text=True, check=True,
    )  # fmt: skip
    (wheel,) = out.iterdir()
    return wheel, done.stdout + done.stderr


def test_a_wheel_has_the_library_and_names_its_platform(package, tmp_path):
    wheel, _ = built(package, "wheel")
    assert "-py3-none-linux_" in wheel.name
    with zipfile.ZipFile(wheel) as archive:
        library = archive.extract(MEMBER, tmp_path)
    assert ctypes.CDLL(library).rmw_publish


def test_an_editable_install_has_it_in_the_repository(package):
    wheel, _ = built(package, "editable")
    assert "-py3-none-any" in wheel.name
    with zipfile.ZipFile(wheel) as archive:
        assert MEMBER not in archive.namelist()
    assert (package / "build" / "native" / "libroslens_rmw_hook.so").is_file()


@pytest.mark.parametrize("kind", ["wheel", "editable"])
@pytest.mark.parametrize(
    ("environment", "reason"),
    [
        ({"PATH": "/nowhere"}, "no C compiler found"),
        ({"CC": "/no/such/compiler"}, "no C compiler found"),
        ({"CC": "false"}, "false failed"),
    ],
)
def test_without_a_compiler_it_is_left_out_and_said_so(package, kind, environment, reason):
    stale = package / "build" / "native" / "libroslens_rmw_hook.so"
    stale.parent.mkdir(parents=True)
    stale.touch()
    wheel, said = built(package, kind, **environment)
    assert "-py3-none-any" in wheel.name
    with zipfile.ZipFile(wheel) as archive:
        assert MEMBER not in archive.namelist()
    assert not stale.exists()
    assert f"the library to preload into nodes is left out: {reason}" in said
