"""What one revision of roslens says of workspaces, as canonical JSON: ``python told.py WORKSPACES OUT JOBS NAME…``.

It is run with the source of a revision first in ``PYTHONPATH`` and imports nothing else of this folder. It knows few
names of roslens, so that it runs with revisions whose modules lie elsewhere: ``extract`` is looked for by the stem of
its module.
"""

from __future__ import annotations

import importlib
import json
import multiprocessing
import os
import sys
import tempfile
import time
import traceback
from functools import partial
from pathlib import Path
from typing import Any

import msgspec

CONDITIONS = frozenset({"written", "no exception", "true", "set", "equal", "not", "and", "or"})
REASONS = frozenset({"of node", "of parameter", "of handle", "of controller", "each of", "item of", "part of",
                     "of environment", "random end", "not set", "of many"})  # fmt: skip
IN_WORDS = CONDITIONS | REASONS
"""Tags of conditions and reasons, which are compared in words: older revisions had nothing else."""
PARTS = frozenset({"missing", "cause", "doubts", "elsewhere", "by_parameter", "clauses", "breach"})
"""Fields that name what is said in words beside them."""


def in_words(asked: Any) -> str:
    """Return what decides a condition in words, as an older revision had it."""
    texts, inner = [str(one) for one in asked.texts], [in_words(one) for one in asked.tests]
    if asked.kind in ("and", "or"):
        return f" {asked.kind} ".join(inner)
    if asked.kind == "not":
        return f"not ({inner[0]})" if " and " in inner[0] or " or " in inner[0] else f"not {inner[0]}"
    return f"{texts[0]} is set" if asked.kind == "set" else " == ".join(texts)


def plain(value: Any) -> Any:
    """Return a value as JSON has it: fields by their names, sets sorted."""
    if isinstance(value, msgspec.Struct) and value.__struct_config__.tag in IN_WORDS:
        return str(value)
    if isinstance(value, msgspec.Struct) and value.__struct_config__.tag == "asked":
        return in_words(value)
    if isinstance(value, msgspec.Struct):
        fields = {name: plain(getattr(value, name)) for name in value.__struct_fields__ if name not in PARTS}
        tag = value.__struct_config__.tag
        return {"type": tag, **fields} if tag is not None else fields
    if isinstance(value, dict):
        return {str(plain(key)): plain(one) for key, one in value.items()}
    if isinstance(value, list | tuple):
        return [plain(one) for one in value]
    if isinstance(value, set | frozenset):
        return sorted((plain(one) for one in value), key=str)
    return value if value is None or isinstance(value, bool | int | float | str) else msgspec.to_builtins(value)


def module_of(stem: str) -> Any:
    """Return the module of extraction with a stem, wherever it lies.

    Raises:
        SystemExit: there is none, or several.
    """
    import roslens

    root = Path(str(roslens.__file__)).parent
    found = sorted((root / "source" / "extract").rglob(f"{stem}.py"))
    if len(found) != 1:
        raise SystemExit(f"{stem}.py below {root}/source/extract: {len(found)} files, expected one")
    return importlib.import_module(".".join(("roslens", *found[0].relative_to(root).with_suffix("").parts)))


def told_of(folder: Path) -> dict[str, Any]:
    """Return what roslens says of the workspace in a folder."""
    from roslens.cli.graph.graph_configurations import assembled, named_configurations
    from roslens.cli.graph.graph_findings import findings_of
    from roslens.cli.graph.graph_source import GraphSource
    from roslens.source.settings import SourceSettings
    from roslens.store.cache import Cache

    settings = SourceSettings()
    with tempfile.TemporaryDirectory() as kept:
        file = Path(kept, "cache.sqlite")
        with Cache.open(file) as cache:
            facts = module_of("extraction").extract([folder], settings, cache=cache, now_s=time.time(), jobs=1)
        # With the cache, so that what was kept is read as well.
        with GraphSource(str(folder), settings, "roslens.toml", {}, cache=file) as source:
            launched = assembled(source, named_configurations(source))
            packages = source.packages(())
            found = {f"{one.title} ({one.generation})": list(findings_of(source, one)) for one in packages}
    made = {**plain(facts), "root": ""}
    return {
        "facts": made,
        "configurations": plain(launched.configurations),
        "packages": plain(packages),
        "unstarted": plain(launched.unstarted),
        "findings": {**plain(launched.findings), **plain(found)},
        "failures": plain(launched.failures),
    }


def write(workspaces: Path, out: Path, name: str) -> tuple[str, float]:
    """Write what is said of a workspace; return its name and how many seconds of a processor it took.

    What breaks is in the document: two revisions that break in different ways do not say the same.
    """
    began = time.process_time()
    try:
        document = told_of(workspaces / name)
    except Exception as error:  # noqa: BLE001 - the other workspaces stay
        traceback.print_exc()
        document = {"broken": f"{type(error).__name__}: {error}"}
    text = json.dumps(document, sort_keys=True, ensure_ascii=False, indent=0)
    beside = out / f".{name}.{os.getpid()}"
    beside.write_text(text)
    beside.rename(out / f"{name}.json")
    return name, time.process_time() - began


def main(words: list[str]) -> int:
    """Write what is said of each workspace."""
    workspaces, out, jobs, *names = words
    with multiprocessing.get_context("fork").Pool(int(jobs), maxtasksperchild=8) as pool:
        for name, seconds in pool.imap_unordered(partial(write, Path(workspaces), Path(out)), names, 1):
            sys.stdout.write(f"{name} {seconds:.1f} s\n")
            sys.stdout.flush()
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
