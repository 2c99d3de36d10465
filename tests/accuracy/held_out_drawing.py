"""Draws what is read of held-out repositories: ``python -m accuracy.held_out_drawing FOLDER SET --seed N``.

Asks ``roslens graph`` and ``roslens check --graph`` about each clone below FOLDER and writes the tables of a set,
endpoints and findings not judged yet; ``about.yaml`` is written by hand.
"""

from __future__ import annotations

import argparse
import json
import random
import sys
from collections import Counter
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from endpoint_sites.of_command import asked, judged
from endpoint_sites.text_calls import text_calls
from graph_findings import collecting
from graph_findings.judgements import TABLES, Judgement, Sample, drawn, write
from graph_findings.repositories import repositories

from accuracy.held_out import SETS, Calls, Endpoint, write_rows

OF_EACH = 8
"""Endpoints of one repository at most."""
IN_ALL = 100
PER_RULE = 20
"""Warnings and errors of one rule at most."""


def calls_of(root: Path, name: str, commit: str, answer: Mapping[str, Any]) -> Calls:
    """Return what an answer of the command says of the calls of a checkout, counted both ways."""
    told, lines = (judged(text_calls(root, definitions=both), answer) for both in (False, True))
    return Calls(name, commit, told.calls, told.shown, told.named, lines.calls, lines.shown, lines.named)


def endpoints_of(
    answers: Mapping[str, Mapping[str, Any]], seed: int, count: int = IN_ALL
) -> tuple[list[Endpoint], int]:
    """Return endpoints that are drawn of the answers of the command, and how many there are.

    The same place under the same name is drawn once, and nothing that a catalogue alone knows.

    Args:
        answers: by repository, in the order of their names.
        seed: of the choice.
        count: how many at most.
    """
    rows = [
        (repository, one)
        for repository, answer in answers.items()
        for configuration in answer.get("configurations", ())
        for node in configuration.get("nodes", ())
        for one in node.get("endpoints", ())
    ]
    every = len(rows)
    random.Random(seed).shuffle(rows)
    taken: Counter[str] = Counter()
    seen, chosen = set(), []
    for repository, one in rows:
        proof = one.get("proof") or {}
        key = (repository, json.dumps(proof, sort_keys=True)[:300], one["endpoint"]["name"])
        if key in seen or not proof.get("path") or taken[repository] >= OF_EACH:
            continue
        seen.add(key)
        taken[repository] += 1
        end = one["endpoint"]
        chosen.append(
            Endpoint(
                repository, proof["path"], proof.get("line", 0), end["role"], end["name"], end.get("type", ""),
                proof.get("sure", "certain"),
            )
        )  # fmt: skip
        if len(chosen) == count:
            break
    return chosen, every


def findings_of(
    found: Mapping[str, list[dict[str, Any]]], seed: int, *, per_rule: int = PER_RULE, count: int = IN_ALL
) -> tuple[list[Judgement], list[Judgement]]:
    """Return warnings and errors, at most ``per_rule`` of each rule, and notes that make ``count`` together with them.

    Of each rule as many notes are drawn, as far as there are, so that not more than ``count`` come of it.
    """
    on = drawn(
        {name: [one for one in every if one["severity"] != "note"] for name, every in found.items()}, seed, per_rule
    )
    quiet = {name: [one for one in every if one["severity"] == "note"] for name, every in found.items()}
    notes: list[Judgement] = []
    for most in range(1, count + 1):
        more = drawn(quiet, seed, most)
        if len(on) + len(more) > count:
            break
        notes = more
    return on, notes


def main(words: list[str], sets: Path = SETS, tables: Path = TABLES) -> int:
    """Measure the clones below a folder and write the tables of a set."""
    parser = argparse.ArgumentParser(prog="python -m accuracy.held_out_drawing", description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("name", help="of the set")
    parser.add_argument("--seed", type=int, required=True)
    options = parser.parse_args(words)
    answers, calls, found, not_read = {}, [], {}, {}
    for one in repositories(options.folder):
        root = one.clone.parent if one.clone.name == ".git" else one.clone
        answers[one.name] = asked(root)
        calls.append(calls_of(root, one.name, one.commit, answers[one.name]))
        try:
            found[one.name] = collecting.findings_of(one)
        except collecting.NotReadError as error:
            not_read[one.name] = str(error)
        sys.stderr.write(f"{one.name}: {calls[-1].calls} calls, {calls[-1].shown} shown, {calls[-1].named} named\n")
    chosen, every = endpoints_of(answers, options.seed)
    folder = sets / options.name
    folder.mkdir(parents=True, exist_ok=True)
    write_rows(folder / "calls.csv", calls)
    write_rows(folder / "endpoints.csv", chosen)
    commits = {row.repository: row.commit for row in calls}
    on, notes = findings_of(found, options.seed)
    counts = [
        Counter(one["rule"] for rows in found.values() for one in rows if (one["severity"] == "note") == quiet)
        for quiet in (False, True)
    ]
    for path, severity, rows, count in (
        (tables / f"held_out_{options.name}.yaml", "warning", on, counts[0]),
        (folder / "notes.yaml", "note", notes, counts[1]),
    ):
        write(Sample(False, options.seed, PER_RULE, severity, commits, not_read, dict(count), {}, rows), path)
    sys.stderr.write(
        f"{len(chosen)} of {every} endpoints, {len(on)} warnings and errors, {len(notes)} notes: {folder}\n"
    )
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
