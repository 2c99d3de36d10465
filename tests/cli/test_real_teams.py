"""Real colcon and real pre-commit: the verb, the hook, and what colcon reads of the results."""

import os
import shutil
import subprocess
import sys
import sysconfig
from importlib.metadata import distribution
from pathlib import Path

import pytest
import yaml

ROOT = Path(__file__).parents[2]
MANIFEST = """<package format="3"><name>late</name><version>1.0.0</version><description>Late.</description>
<maintainer email="a@b.org">a</maintainer><license>MIT</license></package>
"""
CAUGHT = """\
// What can be late.
// And what not.
#include <stdexcept>
int f() {
  try { return 1; } catch (std::exception e) { return 2; }
}
"""

pytestmark = [pytest.mark.real, pytest.mark.heavy]


def needs(program: str) -> str:
    found = shutil.which(program)
    if not found:
        pytest.skip(f"{program} is not installed; `.ci/parts` installs it")
    return found


@pytest.fixture
def workspace(tmp_path: Path) -> Path:
    root = tmp_path / "ws"
    package = root / "src/late"
    package.mkdir(parents=True)
    (package / "package.xml").write_text(MANIFEST)
    (package / "CMakeLists.txt").write_text("cmake_minimum_required(VERSION 3.10)\nproject(late)\n")
    (package / "late.cpp").write_text(CAUGHT)
    return root


def without_dependencies(folder: Path) -> Path:
    """Return a folder with what says that roslens is installed, but not what it depends on.

    Colcon of Debian looks for each dependency first, and does not know that `ruamel.yaml` is `ruamel_yaml`.
    """
    own = distribution("roslens")
    made = folder / f"roslens-{own.version}.dist-info"
    made.mkdir(parents=True)
    (made / "METADATA").write_text(f"Metadata-Version: 2.1\nName: roslens\nVersion: {own.version}\n")
    (made / "entry_points.txt").write_text(own.read_text("entry_points.txt") or "")
    return folder


@pytest.fixture
def colcon(workspace: Path):
    """Run colcon in the workspace; it sees this roslens as it would see one that is installed beside it."""
    program = needs("colcon")
    version = "import sys; print(*sys.version_info[:2])"
    own = subprocess.run(["/usr/bin/python3", "-c", version], capture_output=True, text=True, check=True).stdout.split()
    if own != [str(part) for part in sys.version_info[:2]]:
        pytest.skip(f"colcon is of Python {'.'.join(own)}, and modules of this Python cannot be imported there")
    found = [without_dependencies(workspace.parent / "installed"), ROOT / "src", Path(sysconfig.get_path("purelib"))]

    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(map(str, found))}

    def run(*words: str, code: int = 0) -> str:
        ended = subprocess.run(
            [program, *words], cwd=workspace, env=environment, capture_output=True, text=True, timeout=120, check=False
        )
        assert ended.returncode == code, ended.stdout + ended.stderr
        return ended.stdout

    return run


def test_colcon_has_the_verb(colcon):
    said = colcon("roslens", "--jobs", "1", "--fail-on", "warning", "-q", code=1)
    assert said.splitlines()[0].startswith("src · 1 package")
    assert "cpp.catch_by_value" in said
    assert "--new-only" in colcon("roslens", "--help")


def test_colcon_reads_the_results(colcon, workspace):
    results = workspace / "build/late/test_results/late/roslens.xunit.xml"
    results.parent.mkdir(parents=True)
    words = ("roslens", "src", "--jobs", "1", "-q", "--format", f"junit={results}", "--fail-on")
    colcon(*words, "never")
    assert "0 failures" in colcon("test-result", "--all").splitlines()[-1]
    colcon(*words, "warning", code=1)
    said = colcon("test-result", "--all", "--verbose", code=1)
    assert "cpp.catch_by_value" in said
    assert ", 0 errors, 1 failure, " in said.splitlines()[-1]


def test_pre_commit_runs_the_hook(workspace):
    program = needs("pre-commit")
    git = ["git", "-c", "user.name=a", "-c", "user.email=a@b.org", "-C", str(workspace)]
    (hook,) = (
        one for one in yaml.safe_load((ROOT / ".pre-commit-hooks.yaml").read_text("utf-8")) if one["id"] == "roslens"
    )
    # As published, but for where it comes from: a hook of a repository is installed from a package registry.
    hook |= {"language": "system", "entry": f"{sys.executable} -m roslens.cli.main {hook['entry'].partition(' ')[2]}"}
    hook.pop("minimum_pre_commit_version")
    configuration = {"repos": [{"repo": "local", "hooks": [hook]}]}
    (workspace / ".pre-commit-config.yaml").write_text(yaml.safe_dump(configuration))
    subprocess.run([*git, "init", "-q"], check=True)
    subprocess.run([*git, "add", "."], check=True)

    def committed() -> subprocess.CompletedProcess[str]:
        environment = {**os.environ, "PRE_COMMIT_HOME": str(workspace.parent / "cache")}
        return subprocess.run(
            [program, "run"], cwd=workspace, env=environment, capture_output=True, text=True, timeout=120, check=False
        )

    refused = committed()
    assert (refused.returncode, "cpp.catch_by_value" in refused.stdout) == (1, True), refused.stdout + refused.stderr
    source = workspace / "src/late/late.cpp"
    source.write_text(CAUGHT.replace("std::exception e", "const std::exception&"))
    subprocess.run([*git, "add", "."], check=True)
    mended = committed()
    assert mended.returncode == 0, mended.stdout + mended.stderr


def test_pre_commit_takes_the_hooks_that_are_published():
    words = [needs("pre-commit"), "validate-manifest", str(ROOT / ".pre-commit-hooks.yaml")]
    ended = subprocess.run(words, capture_output=True, text=True, check=False)
    assert ended.returncode == 0, ended.stdout
