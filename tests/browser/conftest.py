"""Headless Chromium on pages that are served here; any request elsewhere, error or broken policy fails the test."""

from __future__ import annotations

import importlib.util
import json
import math
import re
import shutil
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from types import ModuleType
from typing import Any
from urllib.parse import urlsplit
from urllib.request import ProxyHandler, build_opener

import pytest
import uvicorn
from chromium import CHROMIUM
from playwright.sync_api import Browser, ConsoleMessage, Page, Request, Response, expect, sync_playwright

from roslens.dashboard.server import create_app

ROOT = Path(__file__).parents[2]
HERE = f"{Path(__file__).parent}/"
ARGUMENTS = [
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
]
REPORT_VIOLATIONS = """
addEventListener("securitypolicyviolation", (event) =>
  console.error(`policy: ${event.violatedDirective} ${event.blockedURI}`));
"""

WAIT_MS = 60_000
expect.set_options(timeout=WAIT_MS)  # how long pages take is measured elsewhere, by what they take of a processor


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark everything here; without Chromium there is nothing to drive."""
    for item in items:
        if str(item.path).startswith(HERE):
            item.add_marker(pytest.mark.browser)
            if not CHROMIUM.exists():
                item.add_marker(
                    pytest.mark.skip(reason=f"{CHROMIUM} is not installed (apt-get install chromium-headless-shell)")
                )


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    """Return one browser for all tests; each test has its own context in it."""
    with sync_playwright() as playwright:
        started = playwright.chromium.launch(executable_path=str(CHROMIUM), args=ARGUMENTS)
        yield started
        started.close()


def _fake_run() -> Any:
    spec = importlib.util.spec_from_file_location("fake_run", ROOT / "tests/dashboard/fake_run.py")
    assert spec
    assert spec.loader
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.FakeRun()


@pytest.fixture(scope="session")
def base() -> Iterator[str]:
    """Return the address of a server over a made-up run of 38 packages."""
    started = threading.Event()
    found: dict[str, Any] = {}

    def run() -> None:
        # The store's connection belongs to the thread that opens it.
        server = uvicorn.Server(
            uvicorn.Config(create_app(_fake_run().site()), port=0, log_level="error", lifespan="off", ws="none")
        )
        found["server"] = server
        startup = server.startup

        async def tell(sockets: Any = None) -> None:
            await startup(sockets)
            found["port"] = server.servers[0].sockets[0].getsockname()[1]
            started.set()

        server.startup = tell
        server.run()

    thread = threading.Thread(target=run, daemon=True)
    thread.start()
    assert started.wait(60), "the server did not start within 60 s"
    yield f"http://127.0.0.1:{found['port']}"
    found["server"].should_exit = True
    thread.join(10)


@pytest.fixture(scope="session")
def example_base(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """Return the address of ``roslens serve`` over a real check of the example workspace."""
    workspace = tmp_path_factory.mktemp("example") / "workspace"
    shutil.copytree(ROOT / "examples/workspace", workspace, ignore=shutil.ignore_patterns(".roslens"))
    command = [str(Path(sys.executable).with_name("roslens"))]
    checked = subprocess.run(
        [*command, "check", str(workspace), "--quiet"], capture_output=True, text=True, check=False, timeout=120
    )
    assert checked.returncode in {0, 1, 3}, checked.stderr
    with subprocess.Popen(
        [*command, "serve", str(workspace), "--port", "0"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
    ) as served:
        assert served.stdout
        match = next((hit for line in served.stdout if (hit := re.search(r"http://\S+", line))), None)
        assert match, "no address was printed"
        yield match[0].rstrip("/")
        served.terminate()


class Visitor:
    """Opens pages and remembers everything that must not happen on them."""

    def __init__(self, browser: Browser, base: str) -> None:
        self.base = base
        self.problems: list[str] = []
        self._browser = browser
        self._contexts: list[Any] = []

    def open(self, path: str = "/", **options: Any) -> Page:
        """Open a path in a context of its own; ``options`` are those of the context."""
        options.setdefault("viewport", {"width": 1280, "height": 800})
        context = self._browser.new_context(**options)
        self._contexts.append(context)
        context.set_default_timeout(WAIT_MS)
        context.add_init_script(REPORT_VIOLATIONS)
        page = context.new_page()
        page.on("request", self._requested)
        page.on("response", self._answered)
        page.on("console", self._said)
        page.on("pageerror", lambda error: self.problems.append(f"error: {error}"))
        page.goto(self.base + path)
        return page

    def close(self) -> None:
        """Close every context."""
        for context in self._contexts:
            context.close()

    def _requested(self, request: Request) -> None:
        parts = urlsplit(request.url)
        if parts.scheme != "data" and parts.hostname != "127.0.0.1":
            self.problems.append(f"request off this machine: {request.url}")

    def _answered(self, response: Response) -> None:
        if response.status >= 400:
            self.problems.append(f"{response.status}: {response.url}")

    def _said(self, message: ConsoleMessage) -> None:
        if message.type in {"error", "warning"}:
            self.problems.append(f"console {message.type}: {message.text}")


@pytest.fixture
def visit(browser: Browser, base: str) -> Iterator[Callable[..., Page]]:
    """Open pages of the made-up run; fails the test on any problem that they show."""
    visitor = Visitor(browser, base)
    yield visitor.open
    visitor.close()
    assert not visitor.problems


@pytest.fixture
def visit_example(browser: Browser, example_base: str) -> Iterator[Callable[..., Page]]:
    """Open pages of the example workspace; fails the test on any problem that they show."""
    visitor = Visitor(browser, example_base)
    yield visitor.open
    visitor.close()
    assert not visitor.problems


@pytest.fixture(scope="session")
def fetch(base: str) -> Callable[[str], str]:
    """Return the text at a path, without a browser and without a proxy."""
    opener = build_opener(ProxyHandler({}))

    def read(path: str) -> str:
        with opener.open(base + path, timeout=30) as answer:
            return str(answer.read().decode())

    return read


class GraphFacts:
    """The graph's twin, from which tests work out by themselves what the picture must show."""

    def __init__(self, document: dict[str, Any]) -> None:
        graph = document["graph"]
        self.nodes = graph["nodes"]
        self.names = [node["id"] for node in self.nodes]
        self.metrics = {metric["key"]: metric for metric in graph["metrics"]}
        self._tags = [{graph["tags"][tag] for tag in rule["tags"]} for rule in graph["rules"]]

    def findings(self, include: str = "", exclude: str = "", *, own: bool = True) -> list[int]:
        """Return findings per package under a filter of at most one tag each way."""
        return [
            sum(
                gated if own else count
                for rule, count, gated in node["counts"]
                if (not include or include in self._tags[rule]) and exclude not in self._tags[rule]
            )
            for node in self.nodes
        ]

    def around(self, name: str, hops: int) -> set[str]:
        """Return the packages at most ``hops`` dependencies away."""
        found = {self.names.index(name)}
        for _ in range(hops):
            found |= {need for place in found for need in self.nodes[place]["needs"]} | {
                place for place, node in enumerate(self.nodes) if found & set(node["needs"])
            }
        return {self.names[place] for place in found}

    def neighbours(self, name: str) -> set[str]:
        """Return what a package needs and what needs it."""
        return self.around(name, 1) - {name}


@pytest.fixture(scope="session")
def facts(fetch: Callable[[str], str]) -> GraphFacts:
    """Return the twin of the package graph."""
    return GraphFacts(json.loads(fetch("/graph.json")))


@pytest.fixture(scope="session")
def steps() -> Callable[[list[float]], list[str]]:
    """Return the ramp's rule: five steps on the root of the share of the greatest value, zero apart."""

    def of(values: list[float]) -> list[str]:
        most = max(values)
        return [f"s{min(5, max(1, math.ceil(5 * math.sqrt(value / most) - 1e-9))) if value else 0}" for value in values]

    return of


@pytest.fixture(scope="session")
def flagged_file(fetch: Callable[[str], str]) -> str:
    """Return the address of a file with findings."""
    found = json.loads(fetch("/findings.json?severity=error"))["findings"]
    return f"/files/{found[0]['path']}"


@pytest.fixture(scope="session")
def visitor_class() -> type[Visitor]:
    """Return what opens pages, for tests that serve their own."""
    return Visitor


@pytest.fixture(scope="session")
def made_up() -> ModuleType:
    """Return the configurations made up for the computation graph."""
    path = ROOT / "tests/dashboard/made_up_configurations.py"
    spec = importlib.util.spec_from_file_location("made_up_configurations", path)
    assert spec
    assert spec.loader
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module
