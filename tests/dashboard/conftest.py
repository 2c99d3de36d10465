"""Runs that the tests of the pages share."""

from __future__ import annotations

import asyncio
import importlib.util
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from types import ModuleType
from typing import Any

import httpx
import pytest
from starlette.types import ASGIApp

from roslens.dashboard.server import create_app
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
def bare_site() -> Site:
    """Three packages without sources, for what does not depend on what the pages say."""
    return _fake_run().FakeRun(packages=3, sources=False).site()


@pytest.fixture(scope="session")
def large_site() -> Site:
    """A thousand packages and fifty thousand findings, without sources."""
    return _fake_run().FakeRun(packages=1000, findings=50_000, sources=False).site()


@pytest.fixture(scope="session")
def made_up() -> ModuleType:
    """Configurations made up for the computation graph: ``robot()``, its findings, and ``large()``."""
    return _fake_run()._made_up_configurations()


class Client:
    """Asks an application without a network."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    def get(self, path: str, **given: Any) -> httpx.Response:
        """Return the answer; redirects are not followed."""
        # In a thread of its own: a browser test of the same session keeps an event loop running in this one.
        with ThreadPoolExecutor(1) as thread:
            return thread.submit(lambda: asyncio.run(self._get(path, **given))).result()

    async def _get(self, path: str, **given: Any) -> httpx.Response:
        async with httpx.AsyncClient(transport=httpx.ASGITransport(self._app), base_url="http://localhost") as client:
            return await client.get(path, **given)


@pytest.fixture(scope="session")
def client(site: Site) -> Client:
    """The small workspace as served; the server is also called robot."""
    return Client(create_app(site, frozenset({"robot"})))


@pytest.fixture(scope="session")
def large_client(large_site: Site) -> Client:
    """The large workspace as served."""
    return Client(create_app(large_site))
