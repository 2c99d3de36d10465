"""What the live page costs: the server with several readers, and a browser that shows it.

Usage: live_page.py [connections] [readers] [seconds] [--all]. Each reader says what it sees as the page does: 45 rows
of opened nodes, others than those of the next reader, and forty lines of the picture. With --all none says so, and
each gets everything. A made-up robot has so many connections, each of which tells once
a second; its page is served by a process of its own. Reported are CPU seconds by seconds of the clock, so that a busy
machine changes little but the first paint. The browser is Chromium where it is installed, its processes counted by
itself.
"""

from __future__ import annotations

import json
import os
import shutil
import socket
import statistics
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from random import Random
from threading import Thread
from urllib.parse import urlencode, urlsplit
from urllib.request import urlopen

from roslens.cli.page.watch_page import PageSource
from roslens.cli.watch.full_collection import FullCollection
from roslens.dashboard.live.serving import LivePage
from roslens.dashboard.live.sight import LASTING_S
from roslens.judge.reading.read_reference import GivenText, load_reference
from roslens.live.join.session import Session
from roslens.live.past.keeper import Keeper, in_memory
from roslens.live.rate.glance import ROUND_S
from roslens.live.window.signals import BY_KEY
from roslens.model.graph import Endpoint, Graph, Node, Role
from roslens.model.traffic.tally import Moments, Observer, Tally
from roslens.model.wire import VERSION, Frame
from roslens.store.live.history import History
from roslens.store.live.series import Tier

CHROMIUM = Path(shutil.which("chromium") or shutil.which("chromium-headless-shell") or "/usr/bin/chromium")
TURN_S = 0.25
TURNS = 4
"""Each connection tells in one of so many turns."""
TOOL_TURNS = 4
"""So many turns a tool lasts."""
BRIEF = (Tier(1, 60), Tier(10, 120), Tier(60, 360))
"""What is kept for a soak: as much after ten minutes as later."""
HOSTS = 3
FIRST_PAINTS = 5
ROWS, LINES = 45, 40
"""What a reader sees on a screen of 1440 by 900: rows, with five beside them, and lines of the picture."""
REFERENCE = b"""
kind: reference
name: large
defaults: {grace: 0 s}
constraints:
  - {topic: "/**", rate: ">= 5 Hz"}
"""


class Robot:
    """Topics from one node to two others each; rates and latencies waver.

    With ``tools`` there is a further node besides, which gives way to another one every few seconds.
    """

    def __init__(self, connections: int, *, tools: bool = False) -> None:
        self._tools = tools
        topics = connections // 2
        nodes = [f"/part{number // 10}/node{number}" for number in range(max(topics // 8, 3))]
        self._nodes = tuple(
            sorted(
                (Node(name, f"host{at % HOSTS}", 100 + at) for at, name in enumerate(nodes)), key=lambda one: one.name
            )
        )
        self._wires = [
            (nodes[at % len(nodes)], f"/part{at % 10}/topic{at}", nodes[(at * place + place) % len(nodes)], 10 + at % 5)
            for at in range(topics)
            for place in (3, 7)
        ]
        ends = {Endpoint(one, Role.PUBLISHER, topic, "x/msg/X") for one, topic, _, _ in self._wires}
        ends |= {Endpoint(other, Role.SUBSCRIPTION, topic, "x/msg/X") for _, topic, other, _ in self._wires}
        self._ends = tuple(sorted(ends, key=lambda one: (one.name, one.role.value, one.node)))
        self._draw = Random(1).random

    def frame(self, turn: int, now: float) -> Frame:
        """Return what is reported in a turn."""
        tallies = [self._tally(wire, now) for wire in self._wires[turn % TURNS :: TURNS]]
        graph = None
        if not turn % TOOL_TURNS if self._tools else not turn:
            number = turn // TOOL_TURNS
            tool = (Node(f"/tool{number}", "host0", 10_000 + number),) if self._tools else ()
            ends = tuple(Endpoint(one.name, Role.PUBLISHER, f"{one.name}/topic", "x/msg/X") for one in tool)
            graph = Graph("ros2", (*self._nodes, *tool), (*self._ends, *ends))
        return Frame(VERSION, "ros2", 0, now, tallies, [], [], graph, [])

    def _tally(self, wire: tuple[str, str, str, int], now: float) -> Tally:
        publisher, topic, subscriber, usual = wire
        rate = usual + round(2 * self._draw())
        gap, delay = 1 / rate, 0.002 * (1 + self._draw())
        period = Moments(rate, 1.0, rate * gap * gap, gap, gap)
        latency = Moments(rate, rate * delay, rate * delay * delay, delay, delay)
        first, last = now - 1 + gap / 2, now - gap / 2
        return Tally(
            topic, publisher, subscriber, now - 1, now, rate, rate * 1000, first, last, period, latency=latency,
            observer=Observer.SCRIPTED,
        )  # fmt: skip


def robot_served(connections: int, *, soak: bool) -> None:
    """Serve until the input ends; each line of it is answered with what was used so far.

    In a ``soak`` there are tools, and little is kept of the past, of which the bytes are reported too.
    """
    session = Session(load_reference([GivenText("large.yaml", REFERENCE)], BY_KEY), start=time.time() - 1)
    page = PageSource("large", clock=time.ctime, live=True, steady=time.monotonic, spent=time.thread_time)
    history = History.open(None, BRIEF) if soak else None
    keeper = Keeper(session, history, most_values=50, flush_s=1.0) if history else in_memory(session)
    page.remember(keeper.recall())
    collection = FullCollection(time.monotonic)
    robot, made, spent = Robot(connections, tools=soak), 0, 0.0
    ended: list[bool] = []

    def turns() -> Iterator[int]:
        turn = 0
        while not ended:
            yield turn
            turn += 1

    def watch() -> None:
        nonlocal made, spent
        due = time.monotonic()
        for turn in turns():
            now = time.time()
            session.take([robot.frame(turn, now)])
            step = session.look(now)
            keeper.take(step)
            page.take(step)
            if turn < TURNS or page.due():
                begun = time.thread_time()
                page.make(session, now, "")
                spent += time.thread_time() - begun
                made += 1
            collection.now_and_then()
            due = max(due + TURN_S, time.monotonic() - 1)
            time.sleep(max(0.0, due - time.monotonic()))

    watching = Thread(target=watch)
    watching.start()
    while made < TURNS:
        time.sleep(0.05)
    with LivePage(page.newest, detail=page.detail, past=page.past, state=page.state, sight=page.sight) as live:
        print(live.url, flush=True)
        for _ in sys.stdin:
            found = {
                "wall": time.monotonic(), "made": made, "make": spent, "all": time.process_time(),
                "watch": time.clock_gettime(time.pthread_getcpuclockid(watching.ident or 0)),
                "history": history.size if history else 0,
            }  # fmt: skip
            print(json.dumps(found), flush=True)
    ended.append(True)
    watching.join()


class Served:
    """The process that serves the page."""

    def __init__(self, connections: int) -> None:
        command = [sys.executable, __file__, "--served", str(connections)]
        self._process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.url = self._line()

    def _line(self) -> str:
        assert self._process.stdout is not None
        return self._process.stdout.readline().strip()

    def used(self) -> dict[str, float]:
        """Return what was used so far."""
        assert self._process.stdin is not None
        print("used", file=self._process.stdin, flush=True)
        found: dict[str, float] = json.loads(self._line())
        return found

    def close(self) -> None:
        """End it."""
        assert self._process.stdin is not None
        self._process.stdin.close()
        self._process.wait()


class Reader(Thread):
    """Reads the stream and counts its bytes."""

    def __init__(self, url: str, name: str = "") -> None:
        super().__init__(daemon=True)
        parts = urlsplit(url)
        self._socket = socket.create_connection((parts.hostname or "", parts.port or 80))
        self._socket.sendall(f"GET /events?reader={name} HTTP/1.1\r\nHost: {parts.netloc}\r\n\r\n".encode())
        self.bytes = 0
        self.start()

    def run(self) -> None:
        """Read until closed."""
        while part := self._socket.recv(1 << 20):
            self.bytes += len(part)

    def close(self) -> None:
        """Read no more."""
        self._socket.shutdown(socket.SHUT_RDWR)
        self.join()
        self._socket.close()


def say_seen(url: str, readers: int) -> None:
    """Say of each reader what it sees: rows that follow each other, and lines of the picture."""
    with urlopen(f"{url}snapshot.json") as answer:
        found = json.load(answer)
    rows, version = [row["key"] for row in found["rows"]], found["picture"].get("version", 0)
    count = len(found["picture"]["links"])
    for reader in range(readers):
        begin = reader * len(rows) // readers
        places = [(reader * count // readers + place) % count for place in range(LINES)]
        reported = {
            "reader": f"r{reader}", "rows": ".".join(rows[begin : begin + ROWS]), "picture": "1",
            "links": f"{version}:{'.'.join(map(str, places))}",
        }  # fmt: skip
        urlopen(f"{url}sees?{urlencode(reported)}").close()


def with_readers(served: Served, readers: int, seconds: float, *, everything: bool) -> None:
    """Tell what the server uses while so many read."""
    reading = [Reader(served.url, "" if everything else f"r{place}") for place in range(readers)]
    time.sleep(2)
    if not everything:
        say_seen(served.url, readers)
        # What was asked for as a whole is made as a whole for a while, and every topic has its first turn in a round;
        # meanwhile the past keeps for the first time how everything stands.
        time.sleep(LASTING_S + ROUND_S)
    before, reported = served.used(), sum(one.bytes for one in reading)
    time.sleep(seconds)
    after, reported = served.used(), sum(one.bytes for one in reading) - reported
    wall = after["wall"] - before["wall"]
    spent = {key: after[key] - before[key] for key in before}
    page = spent["all"] - spent["watch"] + spent["make"]
    rate = reported / wall / max(readers, 1) / 1000
    print(
        f"{readers} readers: {spent['made'] / wall:.2f} snapshots a second, {page / wall:.1%} of a core for the page "
        f"({spent['make'] / max(spent['made'], 1) * 1000:.0f} ms to make one, {spent['make'] / wall:.1%}; "
        f"serving {(spent['all'] - spent['watch']) / wall:.1%}), {rate:.0f} kB/s a reader"
    )
    for one in reading:
        one.close()


def with_browser(url: str, seconds: float) -> None:
    """Tell what a browser uses, and when it first paints."""
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(
            executable_path=str(CHROMIUM), args=["--headless", "--no-sandbox", "--disable-gpu"]
        )
        paints = []
        for _ in range(FIRST_PAINTS):
            page = browser.new_page(viewport={"width": 1440, "height": 900})
            page.goto(url)
            page.wait_for_function("performance.getEntriesByName('first-contentful-paint').length")
            paints.append(page.evaluate("performance.getEntriesByName('first-contentful-paint')[0].startTime"))
            page.close()
        print(f"first paint: median {statistics.median(paints):.0f} ms of {[round(one) for one in paints]}")
        page = browser.new_page(viewport={"width": 1440, "height": 900})
        page.goto(url)
        time.sleep(3)
        of_page, of_browser = page.context.new_cdp_session(page), browser.new_browser_cdp_session()
        of_page.send("Performance.enable", {"timeDomain": "threadTicks"})

        def used() -> tuple[float, float, float]:
            metrics = {one["name"]: one["value"] for one in of_page.send("Performance.getMetrics")["metrics"]}
            processes = of_browser.send("SystemInfo.getProcessInfo")["processInfo"]
            return time.monotonic(), metrics["TaskDuration"], sum(one["cpuTime"] for one in processes)

        begun, main, total = used()
        time.sleep(seconds)
        ended, main_after, total_after = used()
        wall = ended - begun
        print(
            f"browser: main thread {(main_after - main) / wall:.1%} of a core, all its processes "
            f"{(total_after - total) / wall:.1%}"
        )
        browser.close()


def main() -> None:
    """Measure and tell."""
    if sys.argv[1:2] == ["--served"]:
        robot_served(int(sys.argv[2]), soak="--soak" in sys.argv)
        return
    everything = "--all" in sys.argv
    if everything:
        sys.argv.remove("--all")
    connections, readers, seconds = (
        int(sys.argv[place]) if len(sys.argv) > place else usual for place, usual in ((1, 3000), (2, 10), (3, 20))
    )
    served = Served(connections)
    try:
        print(f"{connections} connections; load of the machine {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores")
        with_readers(served, readers, seconds, everything=everything)
        if CHROMIUM.exists():
            with_browser(served.url, seconds)
    finally:
        served.close()


if __name__ == "__main__":
    main()
