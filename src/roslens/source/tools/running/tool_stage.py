"""The foreign tools of one run: which are installed, what they have to check, and their results for each package.

What a tool says of a file is kept in the cache under a hash of all that it depends on: the file, the tool's version,
its options, settings files above the file and, for some tools, other files. So a tool is started for what is new, once
for many files.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import msgspec

from roslens.model.failure import Failure
from roslens.model.finding import RuleInfo
from roslens.model.source import Location, SourceFile
from roslens.model.words.plural import plural
from roslens.plugins.options import resolve_options
from roslens.plugins.outcome import Outcome
from roslens.source.keys import analyser_version, key_of
from roslens.source.tools.checks.tool_rules import seen_rules
from roslens.source.tools.running.batches import Batches, Looked
from roslens.source.tools.running.programs import Program, check_age, find_program, version_of
from roslens.source.tools.running.run_tool import ToolError, ToolRunner
from roslens.source.tools.running.settings_files import SettingsFiles
from roslens.source.tools.running.tool_findings import outcome_of
from roslens.source.tools.sarif.sarif_sources import SarifSources
from roslens.source.tools.tool import Request, Tool, ToolFinding
from roslens.source.tools.used import NOT_RUN, plain

if TYPE_CHECKING:
    from roslens.source.measure.analyse_package import MeasuredPackage
    from roslens.source.progress import Progress
    from roslens.source.settings import SourceSettings
    from roslens.source.workspace.find import Workspace
    from roslens.store.cache import Cache

_encode = msgspec.msgpack.Encoder().encode
_decode = msgspec.msgpack.Decoder(tuple[ToolFinding, ...]).decode


class ReadyTool(msgspec.Struct, frozen=True):
    """A tool that can run, with everything that affects its results."""

    tool: Tool
    program: Program
    version: str
    options: Mapping[str, Any]
    beside: Any
    key: str


class ToolStage:
    """The tools that a run uses."""

    def __init__(
        self,
        tools: Sequence[Tool],
        settings: SourceSettings,
        workspace: Workspace,
        files: Mapping[str, tuple[SourceFile, ...]],
        cache: Cache,
        *,
        jobs: int,
        base: Path,
        runner: ToolRunner | None = None,
        left_out: frozenset[str] = frozenset(),
    ) -> None:
        """Find out which of ``tools`` can run; why others cannot is among :attr:`failures`."""
        self._settings = settings
        self._workspace = workspace
        self._files = files
        self._spared = left_out
        self._cache = cache
        self._jobs = jobs
        self._runner = runner or ToolRunner()
        self._sources = SarifSources(settings.tools, workspace.root, base, files, cache, self._runner)
        self._rules: dict[str, RuleInfo] = {}
        self._imported: dict[str, str] = {}
        self._above = SettingsFiles(workspace.root)
        self._owner = {file.path: package for package, held in files.items() for file in held}
        self._besides: dict[tuple[str, tuple[str, ...]], str] = {}
        self._named = frozenset(map(plain, settings.tools.use))
        self._resting: dict[str, str] = {}
        self._not_run: list[Failure] = []
        self._ready = tuple(ready for tool in tools if (ready := self._made_ready(tool)) is not None)
        self._found: dict[str, dict[str, set[ToolFinding]]] = defaultdict(lambda: defaultdict(set))
        self._failed: dict[str, list[Failure]] = defaultdict(list)
        self._left_out: dict[str, list[Failure]] = defaultdict(list)

    @property
    def versions(self) -> dict[str, str]:
        """Versions of the tools that run, by name; why others of ``all`` cannot run."""
        return self._imported | {ready.tool.name: ready.version for ready in self._ready} | self._resting

    @property
    def failures(self) -> tuple[Failure, ...]:
        """Why tools could not run at all."""
        return (*self._not_run, *self._sources.failures)

    @property
    def has_failed(self) -> bool:
        """Whether a tool that ran did not look at everything: the next run tries that again."""
        return self._sources.has_failed or any(self._failed.values())

    def key_of_package(self, package: str) -> str:
        """Return a key of everything besides the files of a package that affects the results of tools for it."""
        parts: list[object] = [self._sources.key] if self._sources.key else []
        for ready in self._ready:
            read = [file for file in self._files[package] if ready.tool.reads(file)]
            parts.append((ready.tool.name, ready.key, self._across(ready.tool)))
            parts.append(sorted({self._settings_key(ready.tool, file) for file in read}))
            parts.append([ready.tool.part_of(file, ready.beside) for file in read])
        return key_of(*parts) if parts else ""

    def run(self, changed: Iterable[str], progress: Progress) -> None:
        """Look at the files of the packages that changed, as far as nothing is known of them."""
        wanted = sorted(changed)
        self._import()
        for ready in self._ready:
            packages = sorted(self._files) if ready.tool.across_packages and wanted else wanted
            read = [file for package in packages for file in self._files[package] if ready.tool.reads(file)]
            if not (ready.tool.whole_packages or ready.tool.across_packages):
                read = [file for file in read if file.path not in self._spared]
            files = {file.path: file for file in read if ready.tool.covers(file, ready.beside)}
            self._tell_uncovered(ready.tool, [file for file in read if file.path not in files])
            keys = {path: self._key_of_file(ready, file) for path, file in files.items()}
            known = self._known(keys)
            missing = [file for path, file in sorted(files.items()) if path not in known]
            if missing:
                progress.step(f"Running {ready.tool.name} on {len(missing)} files", 0)
                known |= self._look(ready, missing, keys)
            for findings in known.values():
                for finding in findings:
                    self._found[self._owner.get(finding.path, "")][ready.tool.name].add(finding)

    def outcome(self, measured: MeasuredPackage) -> Outcome:
        """Return the results of the tools for a package."""
        found = self._found.get(measured.package, {})
        package = measured.package
        total = Outcome(failures=(*self._failed.get(package, ()), *self._left_out.get(package, ())))
        for name in sorted(found):
            files = self._files[measured.package]
            total += outcome_of(name, found[name], measured, self._workspace, files, self._rules)
        return total

    def rules(self, seen: Iterable[str]) -> tuple[RuleInfo, ...]:
        """Return the rules of tools among those that findings of the run name."""
        return seen_rules(seen, [ready.tool.name for ready in self._ready], self._rules)

    def _import(self) -> None:
        """Take the findings of SARIF files and of the user's own tools."""
        for imported in self._sources.read():
            self._rules |= imported.rules
            self._imported |= imported.versions
            for tool, findings in imported.findings.items():
                strange = [finding for finding in findings if finding.path not in self._owner]
                if strange:
                    what = f"{len(strange):,} results of {tool} are in files that roslens does not check"
                    advice = "They are ignored by the configuration, or gone since the tool ran"
                    place = Location(strange[0].path, strange[0].line)
                    self._not_run.append(Failure(tool, what, "files of the workspace", advice, place, partial=True))
                for finding in findings:
                    self._found[self._owner.get(finding.path, "")][tool].add(finding)

    def _made_ready(self, tool: Tool) -> ReadyTool | None:
        program = find_program(tool.program, self._workspace.root)
        if program is None:
            self._rest(tool, "it is not installed", f"Get it: {tool.get}")
            return None
        options = resolve_options(tool.manifest, self._settings.options.get(tool.name, {}))
        files = [file for held in self._files.values() for file in held]
        try:
            version = self._version(tool, program)
            if tool.version_words:
                check_age(tool, version)
            beside = tool.prepared(self._workspace.root, files, options, own_settings=self._settings.tools.own_settings)
        except ToolError as error:
            self._rest(tool, f"it {error}", f"Check {program.path}, or install another: {tool.get}")
            return None
        which = version if tool.version_words else program.identity
        key = key_of(analyser_version(), tool.name, which, options, self._settings.tools.own_settings)
        return ReadyTool(tool, program, version, options, beside, key)

    def _rest(self, tool: Tool, why: str, advice: str) -> None:
        """Note that a tool cannot run: a failure where it was named, else a remark."""
        if tool.name in self._named:
            what = f"{tool.name} was not run, because {why}"
            self._not_run.append(Failure(tool.name, what, f"the program {tool.program!r}", advice))
        else:
            self._resting[tool.name] = f"{NOT_RUN}{why}. {advice}"

    def _version(self, tool: Tool, program: Program) -> str:
        key = f"tool-version:{tool.name}:{program.identity}"
        if known := self._cache.get([key]):
            return known[key].decode()
        version = version_of(tool, program, self._runner) if tool.version_words else "unknown"
        self._cache.put({key: version.encode()})
        return version

    def _key_of_file(self, ready: ReadyTool, file: SourceFile) -> str:
        tool = ready.tool
        others: object = None
        if tool.whole_packages:
            others = self._beside(tool, self._owner[file.path])
        above = self._settings_key(tool, file)
        part = tool.part_of(file, ready.beside)
        key = key_of(ready.key, file.path, file.content_hash, above, part, others, self._across(tool))
        return f"tool:{tool.name}:{key}"

    def _settings_key(self, tool: Tool, file: SourceFile) -> str:
        """Return a key of the settings files that count for a file; none do where they are not trusted."""
        return self._above.key_of(file.path, tool.settings_files) if self._settings.tools.own_settings else ""

    def _across(self, tool: Tool) -> str:
        return self._beside(tool, *self._files) if tool.across_packages else ""

    def _beside(self, tool: Tool, *packages: str) -> str:
        """Return a key of the files of packages that others may depend on."""
        asked = (tool.name, packages)
        if asked not in self._besides:
            files = (file for package in packages for file in self._files[package] if tool.shapes(file))
            self._besides[asked] = key_of(sorted((file.path, file.content_hash) for file in files))
        return self._besides[asked]

    def _known(self, keys: Mapping[str, str]) -> dict[str, tuple[ToolFinding, ...]]:
        blobs = self._cache.get(keys.values())
        self._cache.touch(blobs)
        return {path: _decode(blobs[key]) for path, key in keys.items() if key in blobs}

    def _look(
        self, ready: ReadyTool, files: Sequence[SourceFile], keys: Mapping[str, str]
    ) -> dict[str, tuple[ToolFinding, ...]]:
        packages = {found.package.name: found.package.path for found in self._workspace.packages}
        request = Request(
            ready.program.path,
            self._workspace.root,
            (),
            ready.options,
            "",
            packages=packages,
            beside=ready.beside,
            own_settings=self._settings.tools.own_settings,
        )
        limit = self._settings.tools.time_limit_s
        found: dict[str, tuple[ToolFinding, ...]] = {}

        def keep(ended: Mapping[str, tuple[ToolFinding, ...]]) -> None:
            self._cache.put({keys[path]: _encode(findings) for path, findings in ended.items()})

        for group in sorted({ready.tool.group_of(file) for file in files}):
            one = msgspec.structs.replace(request, group=group)
            batches = Batches(ready.tool, one, self._runner, jobs=self._jobs, time_limit_s=limit, keep=keep)
            looked = batches.look_at([file for file in files if ready.tool.group_of(file) == group])
            self._tell(ready.tool, looked)
            found |= looked.findings
        return found

    def _tell_uncovered(self, tool: Tool, files: Sequence[SourceFile]) -> None:
        """Report the files that a tool left out, one failure per package and reason."""
        reasons: dict[tuple[str, str], list[str]] = defaultdict(list)
        for file in files:
            if why := tool.uncovered(file):
                reasons[self._owner[file.path], why].append(file.path)
        for (package, why), paths in sorted(reasons.items()):
            more = f" (and {plural(len(paths) - 1, 'more file')} of the package)" if len(paths) > 1 else ""
            what = f"{tool.name} did not check the file: it {why}{more}"
            place = Location(paths[0])
            self._left_out[package].append(Failure(tool.name, what, "", "", place, "", package, partial=True))

    def _tell(self, tool: Tool, looked: Looked) -> None:
        """Keep why files were not looked at, one failure a package and reason."""
        for why, paths in looked.failed:
            by_package: dict[str, list[str]] = defaultdict(list)
            for path in paths:
                by_package[self._owner.get(path, "")].append(path)
            for package, here in sorted(by_package.items()):
                self._failed[package].append(_failed(tool, why, here, package))
        for line in looked.trouble:
            what = f"{tool.name} complains: {line[:300]!r}"
            advice = "Its findings are kept, but may be incomplete"
            self._not_run.append(Failure(tool.name, what, "nothing but findings", advice, partial=True))


def _failed(tool: Tool, why: str, paths: Sequence[str], package: str) -> Failure:
    first = paths[0]
    more = f" (and {plural(len(paths) - 1, 'more file')} of the package)" if len(paths) > 1 else ""
    return Failure(
        tool.name,
        f"{tool.name} {why}{more}",
        "findings, or none",
        "Other files and tools are not affected; the next run tries these again",
        Location(first),
        f"file:{first}",
        package,
    )
