"""What CMake and what roslens say of a project: values that were told, targets, and what is installed."""

from __future__ import annotations

import json
import shutil
import subprocess
from collections import defaultdict
from dataclasses import dataclass, field
from pathlib import Path

from roslens.source.extract.builds.cmake_commands import COMMANDS
from roslens.source.extract.builds.cmake_evaluation import BUILD, SOURCE
from roslens.source.extract.builds.cmake_linking import INSTALL
from roslens.source.extract.builds.cmake_value import is_unknown
from roslens.source.extract.builds.targets import _Reading

TELL = """\
function(tell label)
  set(text "")
  math(EXPR last "${ARGC} - 1")
  if(last GREATER 0)
    foreach(at RANGE 1 ${last})
      string(APPEND text "<${ARGV${at}}>")
    endforeach()
  endif()
  file(APPEND "${TOLD}" "${label}\\x1f${text}\\x1e")
endfunction()
""".replace("\\x1f", "\x1f").replace("\\x1e", "\x1e")


@dataclass
class Maker:
    """A target: its kind, own sources, its file's name, where it is installed, and what it links."""

    kind: str
    sources: list[str]
    output: str
    installed: list[str]
    all_sources: set[str]
    certain: bool = True


@dataclass
class Answers:
    """What one side says."""

    told: dict[str, list[str | None]] = field(default_factory=lambda: defaultdict(list))
    targets: dict[str, Maker] = field(default_factory=dict)
    installed: set[tuple[str, str]] = field(default_factory=set)
    unresolved: list[str] = field(default_factory=list)
    error: str = ""


class Cmake:
    """Configures projects, all in one folder, so that the compiler is looked for but once."""

    def __init__(self, folder: Path) -> None:
        """Use an empty folder."""
        self._root = folder
        self._source, self._build = folder / "ws" / "p", folder / "build" / "p"
        self._told = folder / "told"
        (folder / "prelude.cmake").write_text(TELL)

    def answers(self, files: dict[str, str]) -> Answers:
        """Configure a project; ``error`` is told where CMake refuses it."""
        shutil.rmtree(self._source, ignore_errors=True)
        for path, text in files.items():
            (self._source / path).parent.mkdir(parents=True, exist_ok=True)
            (self._source / path).write_text(text)
        for path in ("CMakeCache.txt", ".cmake/api/v1/reply"):
            shutil.rmtree(self._build / path, ignore_errors=True)
            (self._build / path).unlink(missing_ok=True)
        query = self._build / ".cmake/api/v1/query"
        query.mkdir(parents=True, exist_ok=True)
        (query / "codemodel-v2").touch()
        self._told.write_text("")
        answers = Answers()
        found = subprocess.run(
            ["cmake", "-S", self._source, "-B", self._build, f"-DTOLD={self._told}", "-Wno-dev", "-DCMAKE_BUILD_TYPE=",
             "-DBUILD_SHARED_LIBS=ON",
             f"-DCMAKE_PROJECT_INCLUDE={self._root / 'prelude.cmake'}", "-DCMAKE_INSTALL_PREFIX=/=install"],
            capture_output=True, text=True, timeout=100, check=False,
        )  # fmt: skip
        for one in self._told.read_text().split("\x1e")[:-1]:
            label, _, text = one.partition("\x1f")
            answers.told[label].append(self._plain(text))
        if found.returncode:
            answers.error = found.stderr
        else:
            self._model(answers)
        return answers

    def _plain(self, text: str) -> str:
        return text.replace(str(self._root / "ws"), SOURCE).replace(str(self._root / "build"), BUILD)

    def _model(self, answers: Answers) -> None:
        reply = self._build / ".cmake/api/v1/reply"
        (path,) = reply.glob("codemodel-v2-*.json")
        configuration = json.loads(path.read_text())["configurations"][0]
        listed = {one["id"]: json.loads((reply / one["jsonFile"]).read_text()) for one in configuration["targets"]}
        own = {key: self._sources(one) for key, one in listed.items()}
        for key, one in listed.items():
            linked, waiting = {key}, [key]
            while waiting:
                for each in listed[waiting.pop()].get("dependencies", []):
                    if each["id"] not in linked:
                        linked.add(each["id"])
                        waiting.append(each["id"])
            every = {path for other in linked for path in own[other]}
            places = [each["path"] for each in one.get("install", {}).get("destinations", [])]
            answers.targets[one["name"]] = Maker(one["type"], own[key], one.get("nameOnDisk", ""), places, every)
        for folder in configuration["directories"]:
            for one in json.loads((reply / folder["jsonFile"]).read_text()).get("installers", []):
                if one["type"] in ("file", "directory"):
                    answers.installed.update(_copied(one))

    def _sources(self, target: dict) -> list[str]:
        paths = [one["path"] for one in target.get("sources", []) if not one.get("isGenerated")]
        return [self._plain(path).removeprefix(f"{SOURCE}/p/") for path in paths if not path.endswith(".o")]


def _copied(installer: dict) -> set[tuple[str, str]]:
    found = set()
    to = installer.get("destination", "").removeprefix("/=install").strip("/")
    for one in installer.get("paths", []):
        source, name = (one["from"], one["to"]) if isinstance(one, dict) else (one, one.rpartition("/")[2])
        name = "" if name == "." else name
        if installer["type"] == "directory" and isinstance(one, str):
            name = one.rstrip("/").rpartition("/")[2] if not one.endswith("/") else ""
        found.add((source.strip("/"), "/".join(filter(None, (to, name)))))
    return found


class _Written:
    def __init__(self, files: dict[str, bytes]) -> None:
        self._files = files

    def content(self, path: str) -> bytes | None:
        return self._files.get(path)

    def package(self, _name: str) -> str | None:
        return None


def own_answers(files: dict[str, str]) -> Answers:
    """Return what roslens says of a project; a value that it does not know, or not surely, is None."""
    answers = Answers()

    def tell(run, call) -> None:
        label, *values = call.arguments
        text = "".join(f"<{value}>" for value in values)
        answers.told[label].append(None if run.conditions or is_unknown(text) else text)

    content = {f"p/{path}": text.encode() for path, text in files.items()}
    before = dict(COMMANDS)
    COMMANDS["tell"] = tell
    try:
        reading = _Reading("p", "p", "cmake", _Written(content), frozenset(content))
    finally:
        COMMANDS.clear()
        COMMANDS.update(before)
    build = reading.read()
    linking = reading._linking
    for name, group in reading._collected.made.items():
        for made in group:
            sources, _links, certain = linking._cached(made)
            parts = linking.parts([made])
            kind = "EXECUTABLE" if made.executable else made.form
            places = [one.removeprefix(INSTALL).strip("/") for one in made.installed]
            answers.targets[name] = Maker(
                kind, [path.removeprefix("p/") for path in sources], made.output or made.name, places,
                {path.removeprefix("p/") for path in parts.sources},
                certain and parts.certain and not made.conditions and len(group) == 1,
            )  # fmt: skip
    answers.installed = {(path.removeprefix("p/"), to) for path, to in build.installed}
    answers.unresolved = [
        f"{one.evidence.path}:{one.evidence.line}: {one.text}: {one.reason}" for one in build.unresolved
    ]
    return answers
