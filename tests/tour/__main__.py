"""Takes the pictures of docs/tour.md of a server that is running: ``python -m tour URL FOLDER [--every] [--screens]``.

One of each station, light and 1,440 pixels wide; with ``--every`` also dark and 420 pixels wide. With ``--screens``
any workspace may be served, and there is a picture of every kind of page that can be reached.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

from chromium import CHROMIUM
from playwright.sync_api import Browser, Page, sync_playwright

from tour.screens import screens
from tour.stations import STATIONS, Station

READ = "#cost:has-text('to the end'), #cost:has-text('costs')"


def pictures(
    browser: Browser, base: str, stations: Sequence[Station], *, width: int, scheme: str
) -> Iterator[tuple[Station, Page]]:
    """Yield each station with a page that shows it."""
    context = browser.new_context(
        viewport={"width": width, "height": 900 if width > 600 else 800},
        color_scheme="dark" if scheme == "dark" else "light",
        reduced_motion="reduce",
    )
    for station in stations:
        page = context.new_page()
        page.goto(base + station.path)
        if station.path.rstrip("/") == "/live":
            page.wait_for_selector(READ, timeout=120_000, state="attached")
        for selector in station.clicks:
            page.locator(selector).first.click()
        page.wait_for_load_state("load")
        # Graphs are drawn once their size is known.
        page.evaluate("() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
        yield station, page
        page.close()
    context.close()


def main(arguments: list[str]) -> int:
    """Take them."""
    base, folder = arguments[0].rstrip("/"), Path(arguments[1])
    folder.mkdir(parents=True, exist_ok=True)
    stations = screens(base) if "--screens" in arguments else STATIONS
    looks = [(1440, "light")]
    if "--every" in arguments:
        looks += [(1440, "dark"), (420, "light"), (420, "dark")]
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=str(CHROMIUM), args=["--no-sandbox", "--disable-gpu"])
        for width, scheme in looks:
            for station, page in pictures(browser, base, stations, width=width, scheme=scheme):
                suffix = "" if (width, scheme) == looks[0] else f"_{width}_{scheme}"
                page.screenshot(path=folder / f"{station.name}{suffix}.png")
        browser.close()
    sys.stdout.write(f"{folder}: {len(looks) * len(stations)} pictures\n")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
