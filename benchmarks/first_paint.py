"""How soon pages with a graph show something in headless Chromium, and what the browser does until they are ready.

Usage: PYTHONPATH=tests first_paint.py [--profile]. A made-up run of 4,000 packages with 50,000 findings, and a graph of
500 nodes and 3,000 connections, are served by this process. Reported are medians of some loads: the first paint by the
clock, which holds only on a calm machine, and seconds of a processor, of this process and of the page's main thread.
With --profile the functions that took most of the latter are reported.
"""

from __future__ import annotations

import importlib
import shutil
import socket
import statistics
import sys
import threading
import time
from collections import Counter
from collections.abc import Sequence
from typing import Any

import uvicorn
from playwright.sync_api import Browser, Page, sync_playwright

from roslens.dashboard.computation.system import systems_of
from roslens.dashboard.server import create_app
from roslens.model.configuration import Configuration, ConfiguredEndpoint, ConfiguredNode, Proof
from roslens.model.graph import Endpoint, Role

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-headless-shell") or "/usr/bin/chromium"
ARGUMENTS = ["--headless", "--no-sandbox", "--disable-gpu"]
HEADS = ("paint ms", "server s", "page s", "script", "layout", "style", "elements")
DIGITS = (0, 3, 3, 3, 3, 3, 0)
LOADS = 5
PAGES = ("/", "/graph", "/packages", "/findings", "/computation/robot")
NODES = 500
TOPICS = 1000
"""Each joins one node to two others: three connections with nodes."""
PAINT = """() => Object.fromEntries(performance.getEntriesByType("paint").map((one) => [one.name, one.startTime]))"""


def robot() -> Configuration:
    """Return a configuration of many nodes, each in one of ten namespaces."""
    names = [f"/part{number % 10}/node{number}" for number in range(NODES)]
    ends: dict[str, list[ConfiguredEndpoint]] = {name: [] for name in names}
    for number in range(TOPICS):
        topic = f"/part{number % 10}/topic{number}"
        users = (names[number % NODES], names[(number * 3 + 7) % NODES], names[(number * 7 + 3) % NODES])
        for place, node in enumerate(users):
            role = Role.SUBSCRIPTION if place else Role.PUBLISHER
            ends[node].append(ConfiguredEndpoint(Endpoint(node, role, topic, "x/msg/X"), Proof("a.py", number + 1)))
    nodes = tuple(ConfiguredNode(name, Proof("a.launch", 1), endpoints=tuple(ends[name])) for name in names)
    return Configuration("robot", "ros2", nodes=nodes)


class Served:
    """The pages of a large run, in a thread of this process."""

    def __init__(self) -> None:
        self.socket = socket.socket()
        self.socket.bind(("127.0.0.1", 0))
        self.socket.listen()
        self.url = f"http://127.0.0.1:{self.socket.getsockname()[1]}"
        made: Any = importlib.import_module("dashboard.fake_run")
        site = made.FakeRun(packages=4000, findings=50_000, sources=False).site()
        site.book.systems.clear()
        site.book.systems.update(systems_of({"robot": robot()}))
        server = uvicorn.Server(uvicorn.Config(create_app(site), log_level="error", lifespan="off", ws="none"))
        threading.Thread(target=server.run, kwargs={"sockets": [self.socket]}, daemon=True).start()


def measure(browser: Browser, url: str, *, profile: bool) -> None:
    """Print a row for a page, and what its scripts took where that is asked for."""
    rows: list[tuple[float, ...]] = []
    functions: Counter[str] = Counter()
    for _ in range(LOADS):
        page = browser.new_page(viewport={"width": 1440, "height": 900})
        devtools = page.context.new_cdp_session(page)
        devtools.send("Performance.enable", {"timeDomain": "threadTicks"})
        if profile:
            devtools.send("Profiler.enable")
            devtools.send("Profiler.start")
        began = time.process_time()
        page.goto(url, wait_until="load")
        page.wait_for_function("performance.getEntriesByType('paint').length > 1")
        reported = {one["name"]: one["value"] for one in devtools.send("Performance.getMetrics")["metrics"]}
        paint = page.evaluate(PAINT)["first-contentful-paint"]
        rows.append((paint, time.process_time() - began, *_spent(reported), _elements(page)))
        if profile:
            functions.update(_by_function(devtools.send("Profiler.stop")["profile"]))
        page.close()
    middle = [statistics.median(column) for column in zip(*rows, strict=True)]
    name = url.partition("//")[2].partition("/")[2] or "(overview)"
    print(f"{name:20}" + " ".join(f"{value:9.{DIGITS[place]}f}" for place, value in enumerate(middle)), flush=True)
    for name, microseconds in functions.most_common(8 if profile else 0):
        print(f"    {microseconds / 1000 / LOADS:7.1f} ms  {name}")


def _spent(reported: dict[str, float]) -> Sequence[float]:
    return [reported[f"{what}Duration"] for what in ("Task", "Script", "Layout", "RecalcStyle")]


def _elements(page: Page) -> float:
    return float(page.evaluate("document.querySelectorAll('*').length"))


def _by_function(profile: dict[str, Any]) -> Counter[str]:
    frames = {node["id"]: node["callFrame"] for node in profile["nodes"]}
    found: Counter[str] = Counter()
    for sample, microseconds in zip(profile["samples"], profile["timeDeltas"], strict=False):
        frame = frames[sample]
        file = frame["url"].rpartition("/")[2]
        found[f"{frame['functionName'] or '(anonymous)'} {file}:{frame['lineNumber'] + 1}"] += microseconds
    return found


def main() -> None:
    """Measure each page."""
    served = Served()
    print(f"{'page':20}" + " ".join(f"{head:>9}" for head in HEADS))
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=ARGUMENTS)
        for page in PAGES:
            measure(browser, served.url + page, profile="--profile" in sys.argv)
        browser.close()


if __name__ == "__main__":
    main()
