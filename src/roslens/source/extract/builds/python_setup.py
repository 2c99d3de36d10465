"""What a Python package installs, read from setup.py, setup.cfg and pyproject.toml; nothing is run.

``setup.py`` is followed as a program (``setup_program.py``), the other two are read line by line.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from posixpath import normpath

import msgspec

from roslens.source.extract.builds.setup_program import SetupProgram, items_of
from roslens.source.extract.domain.abstract_value import Key, Unknown, Value
from roslens.source.extract.domain.guarded import unguarded
from roslens.source.extract.domain.kinds import known_text, reason_of
from roslens.source.extract.facts.launched import Unresolved
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.lowering.python.located_program import Written
from roslens.source.extract.symbolic.text import Text

_MOST_SHOWN = 200
"""So many characters of what could not be read are reported."""


class EntryPoint(msgspec.Struct, frozen=True):
    """A program: its name and ``module:function``."""

    name: str
    entry: str
    evidence: Evidence


class Setup(msgspec.Struct, frozen=True):
    """What a package installs.

    Attributes:
        programs: entry points of console programs.
        scripts: files that are installed as programs, relative to the package.
        data: folders that are installed to, and the files there, relative to the package.
        folders: in which packages lie, by name; of all others at the empty one.
        script_folder: where programs are installed, as written; empty where nothing is said.
        unresolved: what could not be read.
        parameters: modules that declare parameters, each with the file it is made of, relative to the package.
    """

    programs: tuple[EntryPoint, ...] = ()
    scripts: tuple[tuple[str, Evidence], ...] = ()
    data: tuple[tuple[str, tuple[str, ...]], ...] = ()
    folders: tuple[tuple[str, str], ...] = ()
    script_folder: str = ""
    unresolved: tuple[Unresolved, ...] = ()
    parameters: tuple[tuple[str, str], ...] = ()


def read_setup_script(content: bytes, path: str, listing: Iterable[str]) -> Setup:
    """Return what a setup.py installs.

    Args:
        content: of the file.
        path: of the file relative to the root of the workspace.
        listing: files of the package, relative likewise.
    """
    return _Script(SetupProgram(content, path, listing), path).read()


class _Script:
    """What a script gave to ``setup()``, as what is installed."""

    def __init__(self, program: SetupProgram, path: str) -> None:
        self._program = program
        self._path = path
        self._at = Written(1, 1, "setup()")
        self._unresolved: list[Unresolved] = []

    def read(self) -> Setup:
        program = self._program
        if program.gave_up is not None:
            line, why = program.gave_up
            self._unresolved.append(Unresolved("setup.py", Evidence(self._path, line), why))
        parameters = [
            (module, normpath(file))
            for name, one in program.modules
            if (module := known_text(name)) is not None and (file := known_text(one)) is not None
        ]
        if not program.setups:
            return Setup(unresolved=tuple(self._unresolved), parameters=tuple(parameters))
        given = program.setups[-1]
        keywords, self._at = given.keywords, given.place
        if "**" in keywords:
            self._fail(keywords["**"], "its arguments of setup() are unknown")
        programs = [
            one
            for group, value in self._pairs(keywords.get("entry_points"))
            if group in ("console_scripts", "gui_scripts")
            for one in self._programs(value)
        ]
        scripts = [(text, self._evidence(one)) for one in items_of(keywords.get("scripts")) for text in self._text(one)]
        data = [pair for one in items_of(keywords.get("data_files")) for pair in self._data(one)]
        folders = [(key, text) for key, one in self._pairs(keywords.get("package_dir")) for text in self._text(one)]
        return Setup(
            tuple(programs), tuple(scripts), tuple(data), tuple(folders), "", tuple(self._unresolved),
            tuple(parameters),
        )  # fmt: skip

    def _evidence(self, value: Value | Key) -> Evidence:
        place = self._program.place_of(value, self._at)
        return Evidence(self._path, place.line, place.column)

    def _fail(self, value: Value | Key, why: str) -> None:
        place = self._program.place_of(value, self._at)
        text = " ".join(place.text.split())[:_MOST_SHOWN]
        self._unresolved.append(Unresolved(text, Evidence(self._path, place.line, place.column), why))

    def _text(self, value: Value | Key) -> list[str]:
        """Return a text, or nothing where it is not known."""
        match value:
            case Text() if value.known is not None:
                return [value.known]
            case Text():
                self._fail(value, f"it depends on {value.holes[0].reason}")
            case Unknown():
                self._fail(value, str(value.reason))
            case _:
                self._fail(value, "it is not a string")
        return []

    def _pairs(self, value: Value) -> Iterator[tuple[str, Value]]:
        if value is None:
            return
        match value:
            case dict(items):
                for key, one in items.items():
                    for text in self._text(key):
                        yield text, unguarded(one)
            case _:
                self._fail(value, str(reason_of(value, "it is not a dictionary")))

    def _programs(self, value: Value) -> Iterator[EntryPoint]:
        for one in items_of(value):
            for text in self._text(one):
                for line in text.splitlines():
                    if program := _program(line, self._evidence(one)):
                        yield program

    def _data(self, value: Value) -> Iterator[tuple[str, tuple[str, ...]]]:
        match value:
            case list([written, given]):
                for folder in self._text(written):
                    files = [text for one in items_of(given) for text in self._text(one)]
                    yield normpath(folder), tuple(normpath(one) for one in files)
            case _:
                self._fail(value, "it is not a pair of a folder and files")


def _program(line: str, evidence: Evidence) -> EntryPoint | None:
    name, equals, entry = line.partition("=")
    if not equals or not name.strip() or line.lstrip().startswith("#"):
        return None
    return EntryPoint(name.strip(), entry.partition("[")[0].replace(" ", ""), evidence)


_SECTION = re.compile(r"\[([^\]]+)\]")


def read_setup_config(content: bytes, path: str) -> Setup:
    """Return what a setup.cfg installs; ``path`` is that of the file."""
    programs: list[EntryPoint] = []
    scripts: list[tuple[str, Evidence]] = []
    folder = ""
    for number, section, key, value in _options(content):
        match section, key:
            case "install", "install_scripts":
                folder = value or folder
            case "options.entry_points", "console_scripts":
                if program := _program(value, Evidence(path, number)):
                    programs.append(program)
            case "options", "scripts":
                scripts.extend((one, Evidence(path, number)) for one in value.replace(",", " ").split())
    return Setup(tuple(programs), tuple(scripts), script_folder=folder)


def _options(content: bytes) -> Iterator[tuple[int, str, str, str]]:
    """Yield each line of a setup.cfg that is part of a value: its number, section and key, and what it has of it."""
    section = key = ""
    for number, line in enumerate(content.decode("utf-8-sig", "replace").splitlines(), 1):
        if heading := _SECTION.match(line.strip()):
            section, key = heading[1].strip(), ""
            continue
        if not line.strip() or line.lstrip()[0] in "#;":
            continue
        value = line.strip()
        if not line[0].isspace():
            name, _, value = line.partition("=")
            key, value = name.strip().replace("-", "_"), value.strip()
        yield number, section, key, value


def read_pyproject(content: bytes, path: str) -> Setup:
    """Return the programs of a pyproject.toml; ``path`` is that of the file."""
    if b"scripts" not in content:
        return Setup()
    import tomli

    text = content.decode("utf-8", "replace")
    try:
        project = tomli.loads(text).get("project", {})
    except (ValueError, RecursionError) as error:
        return Setup(unresolved=(Unresolved("pyproject.toml", Evidence(path, 1), f"it is not valid TOML: {error}"),))
    programs: list[EntryPoint] = []
    for name, entry in _scripts(project):
        where = re.search(rf"(?m)^\s*[\"']?{re.escape(name)}[\"']?\s*=", text)
        line = text.count("\n", 0, where.end()) + 1 if where else 1
        programs.append(EntryPoint(name, entry.partition("[")[0].replace(" ", ""), Evidence(path, line)))
    return Setup(tuple(programs))


def _scripts(project: object) -> Iterator[tuple[str, str]]:
    """Yield the programs of ``[project]`` with what they start; what is of another form is passed over."""
    match project:
        case {"scripts": {**table}}:
            yield from _texts(table)
    match project:
        case {"entry-points": {"console_scripts": {**table}}}:
            yield from _texts(table)


def _texts(table: Mapping[object, object]) -> Iterator[tuple[str, str]]:
    for name, entry in table.items():
        match name, entry:
            case str(), str():
                yield name, entry
