"""Asks a monitor for what it serves: without roslens and without ROS, so that it works in the Python of either."""

import json
import threading
import time
from collections import deque
from urllib.error import HTTPError
from urllib.parse import parse_qs, quote, urlsplit, urlunsplit
from urllib.request import Request, urlopen

VERSION = 2
"""Of snapshots that are understood."""
KEPT = 120
"""Values of a signal that are kept; one comes each second."""
PACE_S, PATIENCE_S = 1.0, 5.0
_PAGES = ("", "live/")


class MonitorError(Exception):
    """There is no answer, or one that is not understood; the text states what to do."""


def fetch(address, what):
    """Return a document of a monitor as a value; None if it has no content.

    Raises:
        MonitorError: there is no answer, a token is missing, or the server is not a monitor.
    """
    base, token = _parts(address)
    tried = "nothing"
    for page in _PAGES:
        # Only http, see `_parts`.
        request = Request(f"{base}/{page}{what}")  # noqa: S310
        if token:
            request.add_header("Authorization", "Bearer " + token)
        try:
            with urlopen(request, timeout=PATIENCE_S) as answer:  # noqa: S310
                if answer.status == 204:
                    return None
                if "json" in answer.headers.get("content-type", ""):
                    return json.loads(answer.read().decode())
                tried = "a page that is no live page"
        except HTTPError as error:
            if error.code in (401, 403):
                raise MonitorError("a token is asked for: give the address as the monitor printed it") from None
            tried = f"{error.code} {error.reason}"
        except (OSError, ValueError) as error:
            raise MonitorError("no answer: {}".format(getattr(error, "reason", error))) from None
    raise MonitorError(f"answers with {tried}, expected a `roslens watch --serve`")


def _parts(address):
    parts = urlsplit(address if "://" in address else "http://" + address)
    if parts.scheme not in ("http", "https") or not parts.hostname:
        raise MonitorError(f"{address!r} is no address, expected HOST:PORT")
    token = (parse_qs(parts.query).get("token") or [""])[0]
    return urlunsplit((parts.scheme, parts.netloc, parts.path.rstrip("/"), "", "")), token


class Past:
    """The last values of each row: a snapshot holds only the newest."""

    def __init__(self):
        self._series = {}
        self._time = None

    def take(self, snapshot):
        """Keep what a snapshot has; the same one twice counts once, and what is gone is forgotten."""
        if snapshot["time"] == self._time:
            return
        self._time = snapshot["time"]
        there = {
            (row["entity"], key): value for row in snapshot["rows"] for key, value in row.get("values", {}).items()
        }
        self._series = {pair: series for pair, series in self._series.items() if pair in there}
        for pair, value in there.items():
            self._series.setdefault(pair, deque(maxlen=KEPT)).append(value)

    def series(self, entity, key):
        """Return the values of a signal, the newest last."""
        return list(self._series.get((entity, key), ()))


class Watcher:
    """Polls a monitor each second in a thread of its own, and passes its reports on."""

    def __init__(self, receive, fetch=fetch):
        """Pass snapshot, detail and problem to ``receive``, which is called from the thread."""
        self._receive = receive
        self._fetch = fetch
        self._address = ""
        self._entity = ""
        self._asked = threading.Event()
        self._ended = False
        self._thread = threading.Thread(target=self._run, name="roslens", daemon=True)

    def start(self):
        """Begin to ask."""
        self._thread.start()

    def watch(self, address):
        """Ask another monitor from now on."""
        self._address = address
        self._asked.set()

    def choose(self, entity):
        """Ask for the details of this entity too."""
        self._entity = entity
        self._asked.set()

    def close(self):
        """End, and wait for it."""
        self._ended = True
        self._asked.set()
        self._thread.join(PATIENCE_S + PACE_S)

    def _run(self):
        while not self._ended:
            begun = time.monotonic()
            if self._address:
                self._receive(*self._look(self._address, self._entity))
            self._asked.wait(max(0.0, PACE_S - (time.monotonic() - begun)))
            self._asked.clear()

    def _look(self, address, entity):
        try:
            snapshot = _understood(self._fetch(address, "snapshot.json"))
            detail = self._fetch(address, "detail.json?select=" + quote(entity, safe="")) if entity else None
        except MonitorError as error:
            return None, None, str(error)
        return snapshot, detail, ""


def _understood(snapshot):
    if snapshot is not None and snapshot.get("version") != VERSION:
        raise MonitorError("sends snapshots of version {}, expected {}".format(snapshot.get("version"), VERSION))
    return snapshot
