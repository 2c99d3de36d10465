"""A live page for half an hour, with readers and a browser that shows it: the memory of server and page stays level."""

import contextlib
import json
import os
import subprocess
import sys
import time
from pathlib import Path
from statistics import median
from threading import Thread
from urllib.request import urlopen

import pytest
from chromium import CHROMIUM
from playwright.sync_api import sync_playwright

pytestmark = [
    pytest.mark.slow,
    pytest.mark.nightly,
    pytest.mark.skipif(not CHROMIUM.exists(), reason=f"{CHROMIUM} is not installed"),
]

SERVER = Path(__file__).parents[3] / "benchmarks" / "live_page.py"
SOAK_S = float(os.environ.get("ROSLENS_SOAK_S", "1800"))
CONNECTIONS = 600
READERS = 3
LOOKS = 60
COUNTED = """() => {
  const within = (root) => {
    const walker = document.createTreeWalker(root);
    let nodes = 1;
    while (walker.nextNode()) nodes += 1;
    return nodes;
  };
  // Each sign is a copy of what it uses, below a root of its own.
  const copies = [...document.querySelectorAll("use")].map((one) => document.querySelector(one.getAttribute("href")));
  const nodes = copies.reduce((sum, one) => sum + 1 + within(one), within(document));
  return [nodes, document.querySelectorAll("#rows tr").length];
}"""
SETTLE_SHARE = 0.4
"""Until then the past fills up to what is kept of it, and what is seen for the first time is learnt."""
SERVER_SLACK_BYTES = 3_000_000
HISTORY_SLACK_BYTES = 2_000_000
"""Of the past, which is bounded by its tiers: what is too old for them is given up once a minute."""
HEAP_SLACK_BYTES = 1_500_000
DETACHED_SLACK = 500
"""Nodes that are in no document any more and wait for the collector."""
ROWS_SLACK = 150
"""Tools that went are shown until some hundred others did, and given up together."""
TOLD = "{:.0f} s: server {:,} bytes besides {:,} of the past; page {:,} bytes, {} nodes in no document, {} rows\n"


def resident(pid):
    """Bytes of memory that are the process's own."""
    lines = Path(f"/proc/{pid}/status").read_text().splitlines()
    return 1024 * next(int(line.split()[1]) for line in lines if line.startswith("RssAnon"))


def read_on(url, name):
    """Read the stream as long as it goes on."""
    with contextlib.suppress(OSError, ValueError), urlopen(f"{url}events?reader={name}") as answer:
        while answer.read1(1 << 16):
            pass


@pytest.fixture
def served():
    """Process and address of the page of a robot on which tools come and go."""
    command = [sys.executable, SERVER, "--served", str(CONNECTIONS), "--soak"]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:
        yield process, process.stdout.readline().strip()
        process.stdin.close()


def kept(process):
    """Bytes that the past takes in the memory of the server."""
    print("used", file=process.stdin, flush=True)
    return json.loads(process.stdout.readline())["history"]


def in_page(page, devtools):
    """Bytes of the heap of a page that are still used, nodes that are in no document, and rows that are shown."""
    devtools.send("HeapProfiler.collectGarbage")
    found = {one["name"]: one["value"] for one in devtools.send("Performance.getMetrics")["metrics"]}
    there, rows = page.evaluate(COUNTED)
    return found["JSHeapUsedSize"], found["Nodes"] - there, rows


def grown(values):
    """Return by how much the second half is more than the first one, both by their median.

    What a look finds on its way out, a picture that was just replaced, is in one of them or the other by chance.
    """
    middle = len(values) // 2
    return median(values[middle:]) - median(values[:middle])


@pytest.mark.timeout(SOAK_S + 300)
def test_memory_of_a_live_page_stays_level(served):
    process, url = served
    for number in range(READERS):
        Thread(target=read_on, args=(url, f"r{number}"), daemon=True).start()
    looks = []
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(
            executable_path=str(CHROMIUM), args=["--headless", "--no-sandbox", "--disable-gpu"]
        )
        page = browser.new_page(viewport={"width": 1440, "height": 900})
        page.goto(url)
        devtools = page.context.new_cdp_session(page)
        devtools.send("Performance.enable")
        for _ in range(LOOKS):
            page.wait_for_timeout(SOAK_S / LOOKS * 1000)
            past = kept(process)
            looks.append((time.monotonic(), resident(process.pid) - past, past, *in_page(page, devtools)))
            sys.stdout.write(TOLD.format(*looks[-1]))
            sys.stdout.flush()
        browser.close()
    assert process.poll() is None
    settled = looks[int(LOOKS * SETTLE_SHARE) :]
    _, server, past, heap, detached, rows = (list(column) for column in zip(*settled, strict=True))
    assert grown(server) < SERVER_SLACK_BYTES
    assert grown(past) < HISTORY_SLACK_BYTES
    assert grown(heap) < HEAP_SLACK_BYTES
    assert grown(detached) < DETACHED_SLACK
    assert grown(rows) < ROWS_SLACK
