"""Runs that the tests of the pages share."""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path
from types import ModuleType

import pytest

from roslens.dashboard.site import Site


def _fake_run() -> ModuleType:
    name = "dashboard_fake_run"
    if name not in sys.modules:
        spec = importlib.util.spec_from_file_location(name, Path(__file__).with_name("fake_run.py"))
        assert spec is not None
        assert spec.loader is not None
        sys.modules[name] = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(sys.modules[name])
    return sys.modules[name]


@pytest.fixture(scope="session")
def site() -> Site:
    """A small workspace with sources that can be read."""
    return _fake_run().FakeRun(packages=8).site()


@pytest.fixture(scope="session")
def large_site() -> Site:
    """A thousand packages and fifty thousand findings, without sources."""
    return _fake_run().FakeRun(packages=1000, findings=50_000, sources=False).site()
