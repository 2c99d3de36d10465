"""Where SARIF comes from: files that the user names, and programs of the user's that write it."""

from __future__ import annotations

import os
from collections.abc import Mapping
from hashlib import blake2b
from pathlib import Path

import msgspec

from roslens.children.sandbox import Sandbox, program_folders
from roslens.children.scratch_folder import ScratchFolder
from roslens.intake.bounded_file import read_bounded
from roslens.intake.is_there import is_file, is_folder
from roslens.model.failure import Failure
from roslens.model.source import SourceFile
from roslens.plugins.hashed_modules import files_of
from roslens.source.keys import analyser_version, key_of
from roslens.source.settings import ToolCommand, ToolSettings
from roslens.source.tools.running.programs import Program, find_program
from roslens.source.tools.running.run_tool import ToolError, ToolRunner, ended_how
from roslens.source.tools.sarif.sarif_input import MOST_BYTES, Imported, SarifError, read_sarif
from roslens.store.cache import Cache

_decode = msgspec.msgpack.Decoder(Imported).decode
_EXPECTED = "SARIF 2.1.0"


class SarifSources:
    """The files and commands of a configuration; their failures are gathered as they happen."""

    def __init__(
        self,
        tools: ToolSettings,
        root: str,
        base: Path,
        files: Mapping[str, tuple[SourceFile, ...]],
        cache: Cache,
        runner: ToolRunner,
    ) -> None:
        """Relative paths start from ``base``."""
        self._tools = tools
        self._root = root
        self._base = base
        self._cache = cache
        self._runner = runner
        self.failures: list[Failure] = [
            *map(_not_trusted, tools.untrusted),
            *map(_not_used, tools.not_used),
        ]
        self.has_failed = False
        self._paths = tuple(base / name for name in tools.imports)
        whole = [(file.path, file.content_hash) for held in files.values() for file in held] if tools.commands else []
        self._checked = [path for path, _ in whole]
        self._state = key_of(analyser_version(), sorted(whole))
        self._programs = {name: self._program(command) for name, command in tools.commands.items()}

    @property
    def key(self) -> str:
        """A key of everything that affects the results of files and commands."""
        if not (self._paths or self._tools.commands):
            return ""
        contents = [_digest(path) for path in self._paths]
        return key_of(contents, [self._key(name) for name in sorted(self._tools.commands)])

    def read(self) -> tuple[Imported, ...]:
        """Return the results of all of them; commands run now, unless their results are cached."""
        read = [self._file(path) for path in self._paths]
        read += [self._command(name, command) for name, command in sorted(self._tools.commands.items())]
        return tuple(one for one in read if one is not None)

    def _file(self, path: Path) -> Imported | None:
        try:
            imported = read_sarif(read_bounded(path, MOST_BYTES), self._root)
        except (OSError, SarifError) as error:
            why = str(error) if isinstance(error, SarifError) else error.strerror or str(error)
            advice = "Write it anew, or leave it out of --import and [tools] imports"
            self.failures.append(Failure("import", f"{str(path)!r} was not imported: {why}", _EXPECTED, advice))
            return None
        return self._with_trouble(imported, path.name)

    def _command(self, name: str, command: ToolCommand) -> Imported | None:
        program = self._programs[name]
        if program is None:
            self.failures.append(
                Failure(
                    name,
                    f"{name} was not run, because {command.command[0]!r} is not installed",
                    "a program on the search path, or its path",
                    f"Install it, or fix [tools.{name}] command",
                )
            )
            return None
        key = f"sarif:{name}:{self._key(name)}"
        if known := self._cache.get([key]):
            return self._with_trouble(_decode(known[key]), name)
        try:
            imported = self._run(command, program)
        except (ToolError, SarifError) as error:
            verb = "wrote " if isinstance(error, SarifError) else ""
            advice = f"Run it by hand; [tools.{name}] names it. Other tools are not affected"
            self.failures.append(Failure(name, f"{name} {verb}{error}", _EXPECTED, advice))
            self.has_failed = True
            return None
        self._cache.put({key: msgspec.msgpack.encode(imported)})
        return self._with_trouble(imported, name)

    def _run(self, command: ToolCommand, program: Program) -> Imported:
        with ScratchFolder("sarif") as scratch:
            out = Path(scratch, "result.sarif")
            places = {"{output}": str(out), "{root}": self._root}
            words = [program.path, *(_filled(word, places) for word in command.command[1:])]
            ended = self._runner.run(
                words,
                folder=self._root,
                time_limit_s=self._tools.time_limit_s,
                safe_path=False,
                sandbox=self._sandbox(command, program, scratch),
            )
            content = ended.stdout
            if any("{output}" in word for word in command.command):
                try:
                    content = read_bounded(out, MOST_BYTES)
                except OSError as error:
                    raise ToolError(f"{ended_how(ended.code)} and left no result: {error.strerror}") from None
            if ended.code < 0 or not content.strip():
                raise ToolError(f"{ended_how(ended.code)}: {ended.complaint()}")
            return read_sarif(content, self._root)

    def _sandbox(self, command: ToolCommand, program: Program, scratch: str) -> Sandbox:
        """Return what a command may touch: what was hashed when it was trusted, and the source that is checked."""
        words = (self._base / word for word in command.command)
        named = [str(path) for path in words if is_file(path)]
        reads = [self._base / word for word in command.reads]
        named += [str(file) for path in reads if _is_there(path) for file in files_of(path)]
        return Sandbox(
            read=tuple(f"{self._root}/{path}" for path in self._checked),
            run=(*program_folders(program.path), *named),
            write=(scratch,),
            listed=(self._root,),
            guarded=self._root,
            imported=tuple(str(path) for path in reads if is_folder(path)),
        )

    def _with_trouble(self, imported: Imported, name: str) -> Imported:
        for line in imported.trouble:
            self.failures.append(
                Failure("import", f"{name}: {line}", "results in files of the workspace", partial=True)
            )
        return imported

    def _program(self, command: ToolCommand) -> Program | None:
        first = command.command[0]
        if os.sep not in first:
            return find_program(first, self._root)
        path = self._base / first
        if not (path.is_file() and os.access(path, os.X_OK)):
            return None
        return Program(str(path.absolute()), _digest(path))

    def _key(self, name: str) -> str:
        program = self._programs[name]
        return key_of(self._state, self._tools.commands[name].command, program.identity if program else "")


def _is_there(path: Path) -> bool:
    return is_file(path) or is_folder(path)


def _filled(word: str, places: Mapping[str, str]) -> str:
    for mark, text in places.items():
        word = word.replace(mark, text)
    return word


def _digest(path: Path) -> str:
    """Return a hash of a file, or why it has none."""
    digest = blake2b(digest_size=16)
    try:
        digest.update(read_bounded(path, MOST_BYTES))
    except OSError as error:
        return f"{path}: {error.strerror}"
    return f"{path}: {digest.hexdigest()}"


def _not_trusted(name: str) -> Failure:
    return Failure(
        name,
        f"{name} was not run, because it is not trusted: [tools.{name}] of roslens.toml names a program",
        "a command whose folder and content you trust",
        "Review it, then run `roslens trust`; use --trust for a single run, for example in CI",
    )


def _not_used(name: str) -> Failure:
    return Failure(
        name,
        f"{name} was not run, because roslens.toml, which switches it on, is not trusted",
        "a workspace whose settings you trust",
        "Review them, then run `roslens trust`; or name the tool, or the model that needs it, on the command line",
    )
