"""Each folder of tests/fixtures/forges is a forge that answers so: what is counted, waited for and reported of it."""

import json
from pathlib import Path

import pytest

from roslens.source.forge.answers import Answers
from roslens.source.forge.forge_client import ForgeClient
from roslens.source.forge.forge_error import ForgeError
from roslens.source.forge.forge_place import ForgePlace, given_forge
from roslens.source.forge.issue_counts import IssueCounts, issue_counts

FORGES = Path(__file__).parents[2] / "fixtures" / "forges"
CASES = sorted(str(path.parent.relative_to(FORGES)) for path in FORGES.glob("*/*/expected.json"))
KINDS = ("github", "gitlab", "gitea")


def load(forge, case: str) -> dict:
    """Have a forge give the answers of a case; return what is expected."""
    folder = FORGES / case
    for path in sorted(folder.glob("*.http")):
        head, _, body = path.read_bytes().partition(b"\n\n")
        asked, status, *headers = head.decode().splitlines()
        named = dict(line.split(": ", 1) if ": " in line else (line.rstrip(":"), "") for line in headers)
        forge.add(asked.removeprefix("GET "), body, int(status.split()[1]), **named)
    expected = json.loads((folder / "expected.json").read_bytes())
    if then := expected.get("then"):
        load(forge, f"{folder.parent.name}/{then}")
    return expected


def counted(forge, kind: str, **how) -> IssueCounts:
    """Ask for the counts of o/n."""
    _, made = given_forge(f"{forge.url}={kind}")
    with ForgeClient(
        made, how.pop("answers", Answers(None)), now=lambda: 1000.0, **{"environment": {}, **how}
    ) as client:
        return issue_counts(client, ForgePlace(made, "o/n"))


@pytest.mark.parametrize("case", CASES)
def test_case(forge, case):
    expected = load(forge, case)
    waits: list[float] = []
    kind = case.partition("/")[0]
    if "failure" in expected:
        with pytest.raises(ForgeError) as caught:
            counted(forge, kind, sleep=waits.append)
        assert expected["failure"] in str(caught.value)
        assert expected.get("advice", "") in caught.value.advice
    else:
        assert counted(forge, kind, sleep=waits.append) == IssueCounts(*expected["counts"])
    assert waits == expected.get("waits_s", [])
    # A forge that says no is not asked on; whoever counts asks nothing twice but what was refused.
    assert len(forge.asked) == len(set(forge.paths())) + len(waits)


@pytest.mark.parametrize("kind", KINDS)
def test_each_kind_has_the_same_dangers(kind):
    mine = {case.partition("/")[2] for case in CASES if case.startswith(f"{kind}/")}
    assert {"counts", "bad_token"} <= mine
    assert any("fault" in one for one in mine)
    assert any(one.startswith("no_such") for one in mine)


@pytest.mark.parametrize("case", [case for case in CASES if case.endswith("/counts")])
def test_a_second_run_has_what_did_not_change(forge, case, tmp_path):
    expected = load(forge, case)
    kind = case.partition("/")[0]
    for _ in range(2):
        answers = Answers(tmp_path / "forges")
        assert counted(forge, kind, answers=answers) == IssueCounts(*expected["counts"])
        answers.write()
    asked = len(forge.asked)
    kept = Answers(tmp_path / "forges")
    assert counted(forge, kind, answers=kept, offline=True) == IssueCounts(*expected["counts"])
    assert len(forge.asked) == asked
