# Copyright 2025 The roslens authors
#
# Licensed under the Apache License, Version 2.0 (the "License");
# you may not use this file except in compliance with the License.
# You may obtain a copy of the License at
#
#     http://www.apache.org/licenses/LICENSE-2.0
#
# Unless required by applicable law or agreed to in writing, software
# distributed under the License is distributed on an "AS IS" BASIS,
# WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
# See the License for the specific language governing permissions and
# limitations under the License.

"""When which waypoint was reached."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence


class Report:
    """Collects times in seconds; they are whatever clock the caller has."""

    def __init__(self, names: Sequence[str]) -> None:
        self._names = list(names)
        self._times: dict[int, float] = {}
        self._started = 0.0
        self._ended = 0.0
        self._reason = ""

    def start(self, now: float) -> None:
        """Begin to count."""
        self._started = now
        self._times.clear()

    def reached(self, count: int, now: float) -> bool:
        """Note that ``count`` waypoints were reached; return whether that is news."""
        news = False
        for number in range(min(count, len(self._names))):
            if number not in self._times:
                self._times[number] = now - self._started
                news = True
        return news

    def finish(self, now: float, count: int, reason: str) -> None:
        """Note the end, and why it came early (empty if it did not)."""
        self.reached(count, now)
        self._ended = now - self._started
        self._reason = reason

    def as_csv(self) -> str:
        """Return a table with a row for each waypoint and one for the end."""
        text = io.StringIO()
        writer = csv.writer(text, lineterminator="\n")
        writer.writerow(["waypoint", "seconds", "reason"])
        for number, name in enumerate(self._names):
            seconds = self._times.get(number)
            writer.writerow([name, "" if seconds is None else f"{seconds:.1f}", ""])
        writer.writerow(["end", f"{self._ended:.1f}", self._reason])
        return text.getvalue()
