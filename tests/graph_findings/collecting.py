"""What the command line says of a revision.

Findings of the graph are those of ``roslens check --graph`` and ``roslens graph --check``; those of coding rules are
what ``roslens check`` finds in code that counts.
"""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from known_mistakes.checkout import check_out

from graph_findings.repositories import Repository

TIME_LIMIT_S = 900
_ANSWERS = (0, 1, 3)
_RANK = ("note", "warning", "error")


GRAPH, NATIVE = "graph", "roslens"
"""Tools whose findings are asked for: the rules of the graph, and coding rules."""


class NotReadError(Exception):
    """A repository of which the command line says nothing."""


def findings_of(repository: Repository, tool: str = GRAPH) -> list[dict[str, Any]]:
    """Return what the rules of a tool find in the commit of a repository, each once, at its highest severity.

    The files are laid out in a folder of their own; nothing is written below the clone.

    Raises:
        NotReadError: a command failed, or took too long.
    """
    with TemporaryDirectory() as folder:
        root = Path(folder, "ws")
        _lay_out(repository, root)
        if tool != GRAPH:
            report = _report_of(root)
            return [one for one in report["findings"] if one.get("tool") == tool and one.get("gated", True)]
        # Every launch file that no other includes, and the nodes of which no launch file says that they run together.
        report = _said("check", str(root), "--graph", "--no-store")
        every = [one for one in report["findings"] if one.get("tool") == "graph"]
        every += _said("graph", str(root), "--check")
    found: dict[str, dict[str, Any]] = {}
    for one in every:
        known = found.get(one["fingerprint"])
        if known is None or _RANK.index(one["severity"]) > _RANK.index(known["severity"]):
            found[one["fingerprint"]] = one
    return [found[key] for key in sorted(found)]


def report_of(repository: Repository) -> Any:
    """Return what ``roslens check`` says of the commit of a repository, as JSON.

    Raises:
        NotReadError: the command failed, or took too long.
    """
    with TemporaryDirectory() as folder:
        root = Path(folder, "ws")
        _lay_out(repository, root)
        return _report_of(root)


def _lay_out(repository: Repository, root: Path) -> None:
    """Write the files of a commit into a folder that is a repository of that name, as a clone is."""
    root.mkdir()
    try:
        check_out(repository.clone, repository.commit, root)
    except subprocess.CalledProcessError as error:
        raise NotReadError(f"the clone has no commit {repository.commit}") from error
    for words in (("init", "--quiet"), ("remote", "add", "origin", f"https://forge.invalid/{repository.name}.git")):
        subprocess.run(["git", "-C", str(root), *words], check=True, capture_output=True)


def _report_of(root: Path) -> Any:
    return _said("check", str(root), "--no-graph", "--no-store")


def _said(*words: str) -> Any:
    program = str(Path(sys.executable).with_name("roslens"))
    command = [program, *words, "--format", "json", "--fail-on", "never", "--no-cache", "-q"]
    try:
        ended = subprocess.run(command, capture_output=True, text=True, check=False, timeout=TIME_LIMIT_S)
    except subprocess.TimeoutExpired as error:
        raise NotReadError(f"roslens {words[0]} took more than {TIME_LIMIT_S} s") from error
    if ended.returncode not in _ANSWERS or not ended.stdout:
        last = ended.stderr.strip().splitlines()[-1:] or ["nothing was said"]
        raise NotReadError(f"roslens {words[0]} ended with {ended.returncode}: {last[0]}")
    return json.loads(ended.stdout)
