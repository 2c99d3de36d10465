"""A tool run over files: many a process, and where a process fails, halves of them, until what is at fault is alone."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait

import msgspec

from roslens.children.scratch_folder import ScratchFolder
from roslens.model.source import SourceFile
from roslens.source.tools.running.run_tool import ToolError, ToolHangError, ToolRunner
from roslens.source.tools.running.tool_sandbox import sandbox_of
from roslens.source.tools.tool import Reading, Request, Tool, ToolFinding

FEWEST_AT_ONCE = 8
"""So many files are not shared out among processes: starting one costs more than it saves."""

LEAST_LIMIT_S = 20.0
"""Seconds that a call gets in any case, unless the user gave less."""

MOST_RETRIES = 16
"""Calls that may be spent on finding out which files a tool fails on."""


class Looked(msgspec.Struct, frozen=True):
    """The results of a tool for files: findings by file, and why others have none."""

    findings: dict[str, tuple[ToolFinding, ...]]
    failed: tuple[tuple[str, tuple[str, ...]], ...] = ()
    trouble: tuple[str, ...] = ()


def batches(tool: Tool, files: Sequence[SourceFile], jobs: int) -> list[tuple[str, ...]]:
    """Share files out to calls, about the same number of bytes to each."""
    if not files:
        return []
    fewest = -(-len(files) // tool.at_once)
    wanted = max(fewest, min(jobs, -(-len(files) // FEWEST_AT_ONCE))) if tool.parallel else fewest
    loads = [(0, number) for number in range(wanted)]
    shares: list[list[str]] = [[] for _ in range(wanted)]
    for file in sorted(files, key=lambda file: (-file.size, file.path)):
        room = [load for load in loads if len(shares[load[1]]) < tool.at_once]
        least = min(room)
        shares[least[1]].append(file.path)
        loads[least[1]] = (least[0] + file.size + 1, least[1])
    return [tuple(sorted(share)) for share in shares if share]


class Batches:
    """Calls of one tool, several at a time."""

    def __init__(
        self,
        tool: Tool,
        request: Request,
        runner: ToolRunner,
        *,
        jobs: int,
        time_limit_s: float,
        keep: Callable[[Mapping[str, tuple[ToolFinding, ...]]], None] | None = None,
    ) -> None:
        """Make calls like ``request``, each with files of its own; at most ``jobs`` at a time.

        ``keep`` hears of the findings of each call, by file, as soon as it has ended.
        """
        self._keep = keep
        self._tool = tool
        self._request = request
        self._runner = runner
        self._jobs = max(1, jobs) if tool.parallel else 1
        self._time_limit_s = time_limit_s
        self._retries = MOST_RETRIES

    def look_at(self, files: Sequence[SourceFile]) -> Looked:
        """Return the results of the tool for the files."""
        findings: dict[str, tuple[ToolFinding, ...]] = {}
        failed: dict[str, list[str]] = {}
        trouble: list[str] = []
        for paths, result in self._results(batches(self._tool, files, self._jobs)):
            if isinstance(result, ToolError):
                failed.setdefault(str(result), []).extend(paths)
                continue
            found = _by_file(paths, result)
            findings.update(found)
            if self._keep is not None:
                self._keep(found)
            for path, why in result.skipped.items():
                if path in paths:
                    failed.setdefault(f"skipped the file: {why}", []).append(path)
            trouble.extend(result.trouble)
        reported = tuple((why, tuple(sorted(paths))) for why, paths in sorted(failed.items()))
        return Looked(findings, reported, tuple(dict.fromkeys(trouble)))

    def _results(self, shares: Sequence[tuple[str, ...]]) -> Iterator[tuple[tuple[str, ...], Reading | ToolError]]:
        with ThreadPoolExecutor(self._jobs, thread_name_prefix=f"roslens-{self._tool.name}") as pool:
            running: dict[Future[Reading | ToolError], tuple[tuple[str, ...], float]] = {}

            def start(paths: tuple[str, ...], time_limit_s: float) -> None:
                running[pool.submit(self._call, paths, time_limit_s)] = (paths, time_limit_s)

            try:
                for share in shares:
                    start(share, self._time_limit_s)
                while running:
                    done, _ = wait(running, return_when=FIRST_COMPLETED)
                    for future in done:
                        paths, limit = running.pop(future)
                        result = future.result()
                        if isinstance(result, ToolError) and len(paths) > 1 and self._retries >= 2:
                            self._retries -= 2
                            middle = len(paths) // 2
                            # Half the files in half the time, so that to find one that hangs it takes no longer again.
                            half = min(limit, max(LEAST_LIMIT_S, limit / 2))
                            limit = half if isinstance(result, ToolHangError) else limit
                            start(paths[:middle], limit)
                            start(paths[middle:], limit)
                        else:
                            yield paths, result
            except BaseException:
                pool.shutdown(wait=False, cancel_futures=True)
                self._runner.end_all()
                raise

    def _call(self, paths: tuple[str, ...], time_limit_s: float) -> Reading | ToolError:
        tool = self._tool
        with ScratchFolder(tool.name) as scratch:
            request = msgspec.structs.replace(
                self._request, files=tuple(f"./{path}" for path in paths), scratch=scratch
            )
            try:
                ended = self._runner.run(
                    tool.words(request),
                    folder=scratch if tool.in_scratch else request.root,
                    time_limit_s=time_limit_s,
                    safe_path=tool.safe_path,
                    variables=tool.variables(request),
                    sandbox=sandbox_of(request, network=tool.asks_the_net),
                )
                return tool.read(tool.checked(ended), request)
            except ToolError as error:
                return error
            except Exception as error:  # noqa: BLE001 - whatever a tool prints must not stop the others
                return ToolError(f"printed what cannot be read: {type(error).__name__}: {error}")


def _by_file(paths: Sequence[str], reading: Reading) -> Mapping[str, tuple[ToolFinding, ...]]:
    """Return the findings of a call by the file they are kept with.

    One in a file that was not given, as in a header, is kept with each file that was: which of them led there is not
    said.
    """
    shares: dict[str, list[ToolFinding]] = {path: [] for path in paths if path not in reading.skipped}
    for finding in reading.findings:
        if finding.path in shares:
            shares[finding.path].append(finding)
        elif finding.path:
            for share in shares.values():
                share.append(finding)
    return {path: tuple(sorted(set(share))) for path, share in shares.items()}
