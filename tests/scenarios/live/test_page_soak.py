"""A live page for half an hour, with readers and a browser that shows it: the memory of server and page stays level."""

import contextlib
import os
import subprocess
import sys
import time
from pathlib import Path
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
SETTLE_SHARE = 0.4
"""Until then the past fills up to what is kept of it, and what is seen for the first time is learnt."""
SERVER_SLACK_BYTES = 6_000_000
"""Values are given up every ten minutes, so how many wait for that differs from look to look."""
HEAP_SLACK_BYTES = 1_500_000
NODES_SLACK = 5000
"""Up to three hundred tools that went are shown, and as many more as came since that was last seen to."""


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


def in_page(devtools):
    """Bytes of the heap of a page that are still used, and how many nodes of documents there are."""
    devtools.send("HeapProfiler.collectGarbage")
    found = {one["name"]: one["value"] for one in devtools.send("Performance.getMetrics")["metrics"]}
    return found["JSHeapUsedSize"], found["Nodes"]


def grown(values):
    """Return by how much the greatest value of the second half is more than that of the first."""
    middle = len(values) // 2
    return max(values[middle:]) - max(values[:middle])


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
            looks.append((time.monotonic(), resident(process.pid), *in_page(devtools)))
            sys.stdout.write("{:.0f} s: server {:,} bytes; page {:,} bytes, {} nodes\n".format(*looks[-1]))
            sys.stdout.flush()
        browser.close()
    assert process.poll() is None
    settled = looks[int(LOOKS * SETTLE_SHARE) :]
    _, server, heap, nodes = (list(column) for column in zip(*settled, strict=True))
    assert grown(server) < SERVER_SLACK_BYTES
    assert grown(heap) < HEAP_SLACK_BYTES
    assert grown(nodes) < NODES_SLACK
