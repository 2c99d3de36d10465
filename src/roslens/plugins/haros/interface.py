"""The object ``iface`` through which a HAROS plug-in asks and reports."""

from __future__ import annotations

import shutil
import sys
from collections import Counter
from pathlib import Path

from roslens.plugins.haros.declared import Declared
from roslens.plugins.haros.notes import Note
from roslens.plugins.haros.places import Places
from roslens.plugins.haros.scopes import Package, Project, SourceFile
from roslens.plugins.points import Report


class Interface:
    """What HAROS calls its plug-in interface; reports go to roslens' report and to the notes.

    Ranges of metrics are checked by roslens: a value outside of them is a failure beside the results
    and not, as in HAROS, an exception that ends the plug-in.
    """

    def __init__(self, declared: Declared, folder: Path, project: Project, places: Places, report: Report) -> None:
        """Take the plug-in, the workspace and where reports go."""
        self.state: object = None
        self.scope: SourceFile | Package | None = None
        self.notes: list[Note] = []
        self.unplaced: Counter[str] = Counter()
        self.exports: list[Path] = []
        self._declared = declared
        self._folder = folder
        self._project = project
        self._places = places
        self._report = report
        self._values: dict[tuple[str, str], float] = {}
        self._flushed: set[tuple[str, str]] = set()

    def get_file(self, relative_path: str) -> str:
        """Return the path of a file that comes with the plug-in."""
        return str(self._folder / relative_path)

    def export_file(self, relative_path: str) -> None:
        """Keep a file from the plug-in's temporary folder for the user."""
        target = Path.cwd() / relative_path
        if target.is_file():
            self.exports.append(target)

    def find_package(self, scope_id: str) -> Package | None:
        """Return a package by its name or id."""
        for package in self._project.packages:
            if scope_id in (package.id, package.name):
                return package
        return None

    def find_configuration(self, _scope_id: str) -> None:
        """Return None: there are no configurations."""

    def log_debug(self, msg: object) -> None:
        """Say something to whoever debugs the plug-in."""
        self._log("debug", msg)

    def log_warning(self, msg: object) -> None:
        """Say something to the user."""
        self._log("warning", msg)

    def log_error(self, msg: object) -> None:
        """Say that something went wrong."""
        self._log("error", msg)

    def report_violation(
        self,
        rule_id: str,
        msg: object,
        scope: SourceFile | Package | None = None,
        line: int | None = None,
        function: str | None = None,
        class_: str | None = None,
    ) -> None:
        """Report an occurrence of a rule; ``scope`` defaults to the file or package at hand."""
        place = self._place(scope)
        number = int(line or 0)
        entity = self._places.find(place, number, function, class_) or ""
        if not entity and isinstance(place, Package):
            entity = f"package:{place.given.package.id}"
        self._report.finding(
            f"{self._declared.name}.{self._plain(rule_id)}",
            str(msg),
            path=place.given.path if isinstance(place, SourceFile) else "",
            line=number,
            entity="" if entity.startswith("file:") else entity,
        )
        if self._plain(rule_id) in self._declared.rules:
            self.notes.append(Note(place.id, self._plain(rule_id), line, function, class_, details=_plain_text(msg)))

    def report_metric(
        self,
        metric_id: str,
        value: float,
        scope: SourceFile | Package | None = None,
        line: int | None = None,
        function: str | None = None,
        class_: str | None = None,
    ) -> None:
        """Report a value; of several for one entity the largest stands."""
        place = self._place(scope)
        key = f"{self._declared.name}.{self._plain(metric_id)}"
        if self._plain(metric_id) in self._declared.metrics:
            self.notes.append(Note(place.id, self._plain(metric_id), line, function, class_, value=float(value)))
        entity = self._places.find(place, int(line or 0), function, class_)
        if entity is None:
            self.unplaced[key] += 1
            return
        known = self._values.get((entity, key))
        self._values[entity, key] = value if known is None else max(known, value)

    def report_runtime_violation(self, rule_id: str, msg: object, resources: object = None) -> None:
        """Refuse: only a configuration has resources.

        Raises:
            ValueError: always, as in HAROS outside of a configuration.
        """
        raise ValueError(f"{rule_id!r} needs a configuration: {msg} ({resources})")

    def flush(self) -> None:
        """Hand over the values of a step, and forget them."""
        for (entity, key), value in sorted(self._values.items()):
            if (entity, key) not in self._flushed:
                self._report.measurement(key, value, entity=entity)
        self._flushed.update(self._values)
        self._values.clear()

    def keep_exports(self, artifacts: str) -> None:
        """Move exported files to where the user finds them."""
        for path in self.exports:
            if not artifacts:
                self.log_warning(f"{path.name} is exported, and this run keeps no files")
                continue
            target = Path(artifacts, self._declared.name, path.name)
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.move(str(path), target)
        self.exports.clear()

    def _place(self, scope: SourceFile | Package | None) -> SourceFile | Package:
        place = scope or self.scope
        if place is None:
            raise ValueError("must provide a scope")
        return place

    def _plain(self, identity: str) -> str:
        """Return an id without the prefix ``plugin:`` that HAROS allows."""
        return str(identity).removeprefix(f"{self._declared.name}:")

    def _log(self, level: str, msg: object) -> None:
        print(f"{self._declared.name}: {level}: {msg}", file=sys.stderr)  # noqa: T201 - the framework keeps it in the log


def _plain_text(msg: object) -> str:
    return str(msg).encode("utf-8", "backslashreplace").decode()
