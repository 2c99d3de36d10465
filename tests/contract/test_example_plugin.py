"""The example is what a third party would ship: it keeps the contract, its own tests pass, it installs."""

import subprocess
import sys
import sysconfig
from pathlib import Path

import pytest
from fresh_environment import fresh_environment, pip_install

from roslens.plugins.contract import assert_plugin

ROOT = Path(__file__).parents[2]
EXAMPLE = ROOT / "examples" / "plugin"
LIST = """
from pathlib import Path
from roslens.plugins.discovery import discover
found = discover([], base=Path("."))
for failure in found.failures:
    print(failure)
for member in found.members:
    print(member.name, member.origin, [rule.id for rule in member.manifest.rules])
"""


def test_it_keeps_the_contract(monkeypatch):
    monkeypatch.syspath_prepend(str(EXAMPLE / "src"))
    assert_plugin("roslens_plugin_waits.plugin", EXAMPLE / "tests" / "fixtures")


@pytest.mark.heavy
def test_its_own_tests_pass(monkeypatch):
    monkeypatch.setenv("PYTHONPATH", str(EXAMPLE / "src"))
    command = [sys.executable, "-m", "pytest", "-q", "-c", str(EXAMPLE / "pyproject.toml"), str(EXAMPLE / "tests")]
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=EXAMPLE)
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.real
def test_it_installs_and_is_found(tmp_path):
    """A fresh environment that sees the packages of this one, with the example installed as anybody would."""
    environment = tmp_path / "venv"
    python = fresh_environment(environment)
    packages = next((environment / "lib").glob("python*/site-packages"))
    (packages / "shared.pth").write_text(f"import site; site.addsitedir({sysconfig.get_paths()['purelib']!r})\n")
    done = pip_install(python, "--no-deps", str(EXAMPLE))
    if done.returncode and "No matching distribution" in done.stderr + done.stdout:
        pytest.skip(f"the build back end cannot be had: {done.stderr.strip().splitlines()[-1]}")
    assert done.returncode == 0, done.stderr
    done = subprocess.run([str(python), "-c", LIST], capture_output=True, text=True, check=True, cwd=tmp_path)
    assert "waits entry point waits of roslens-plugin-waits 1.0.0 ['waits.fixed_wait']" in done.stdout.splitlines()
