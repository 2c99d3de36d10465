"""The two revisions: their source, the workspaces they are asked about, and what they said of them before."""

from __future__ import annotations

import hashlib
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import msgspec
import yaml
from graph_findings.repositories import repositories
from known_mistakes.checkout import check_out

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
KEPT = ROOT / "build" / "same-facts"
LIST = HERE / "repositories.repos"
TOLD = HERE / "told.py"
SOURCE = "src/roslens"


class Side(msgspec.Struct, frozen=True):
    """A revision of roslens.

    Attributes:
        name: as the user gave it, or what stands for the working tree.
        source: folder that is put into ``PYTHONPATH``.
        out: folder in which is kept what it says.
        lasting: whether what is kept there is still true later.
    """

    name: str
    source: Path
    out: Path
    lasting: bool


class NoRevisionError(Exception):
    """A revision that git does not know."""


def wanted(path: Path = LIST) -> dict[str, str]:
    """Return the commit of each repository of the list, by ``owner+name``."""
    listed = yaml.safe_load(path.read_text())["repositories"]
    return {name: str(about["version"]) for name, about in listed.items()}


def workspaces(
    commits: Mapping[str, str], corpora: Path, folder: Path = KEPT / "workspaces"
) -> tuple[list[str], list[str]]:
    """Lay out the repositories below a folder, as far as they are not there.

    Returns:
        The names of those that are there, the largest first, and of those of which there is no clone with that commit.
    """
    clones = {one.name.replace("/", "+", 1): one.clone for one in repositories(corpora)}
    found, missing = [], []
    for name, commit in commits.items():
        target = folder / f"{name}@{commit[:12]}"
        if not target.is_dir():
            beside = folder / f".{target.name}"
            shutil.rmtree(beside, ignore_errors=True)
            beside.mkdir(parents=True)
            try:
                check_out(clones[name], commit, beside)
            except (KeyError, subprocess.CalledProcessError):
                missing.append(name)
                continue
            beside.rename(target)
        found.append(target.name)
    return sorted(found, key=lambda name: (-_size(folder / name), name)), missing


def revision(name: str, root: Path = ROOT, kept: Path = KEPT) -> Side:
    """Return a revision of git, its source laid out.

    Raises:
        NoRevisionError: there is none of that name.
    """
    tree = _git(root, "rev-parse", "--verify", "--quiet", f"{name}:{SOURCE}")
    if tree is None:
        raise NoRevisionError(f'"{name}" is no revision with a folder {SOURCE}')
    source = kept / "code" / tree
    if not source.is_dir():
        beside = source.with_name(f".{tree}")
        shutil.rmtree(beside, ignore_errors=True)
        packed = subprocess.run(["git", "-C", root, "archive", name, SOURCE], check=True, capture_output=True).stdout
        beside.mkdir(parents=True)
        subprocess.run(["tar", "-x", "-C", str(beside)], input=packed, check=True)
        beside.rename(source)
    return Side(name, source / "src", _out(kept, tree), True)


def working_tree(root: Path = ROOT, kept: Path = KEPT) -> Side:
    """Return the working tree; what it says is kept where it is as committed."""
    changed = _git(root, "status", "--porcelain", "--", SOURCE)
    if changed == "":
        return msgspec.structs.replace(revision("HEAD", root, kept), name="working tree")
    return Side("working tree", root / "src", _out(kept, "working"), False)


def ask(side: Side, names: Sequence[str], folder: Path = KEPT / "workspaces", jobs: int = 2) -> Iterator[str]:
    """Have a revision say what it knows of workspaces, as far as it is not kept; yield a line for each.

    Raises:
        CalledProcessError: it could not be run.
    """
    if not side.lasting:
        shutil.rmtree(side.out, ignore_errors=True)
    side.out.mkdir(parents=True, exist_ok=True)
    missing = [name for name in names if not (side.out / f"{name}.json").is_file()]
    if not missing:
        return
    command = [sys.executable, str(TOLD), str(folder), str(side.out), str(jobs), *missing]
    environment = {**os.environ, "PYTHONPATH": str(side.source), "PYTHONHASHSEED": "0"}
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment) as process:
        assert process.stdout is not None
        yield from (line.rstrip("\n") for line in process.stdout)
    if process.returncode:
        raise subprocess.CalledProcessError(process.returncode, command[:2])


def _out(kept: Path, tree: str) -> Path:
    """Return the folder of what the source of a tree says: another one when other things are asked."""
    asked = hashlib.sha256(TOLD.read_bytes()).hexdigest()[:12]
    return kept / "told" / f"{tree}-{asked}"


def _git(root: Path, *words: str) -> str | None:
    ended = subprocess.run(["git", "-C", root, *words], capture_output=True, text=True, check=False)
    return ended.stdout.strip() if ended.returncode == 0 else None


def _size(folder: Path) -> int:
    endings = {".cpp", ".hpp", ".h", ".cc", ".py"}
    return sum(path.stat().st_size for path in folder.rglob("*") if path.suffix in endings and path.is_file())
