"""What each forge answers is counted as it means it; what goes wrong is reported, and patience has an end."""

import pytest

from roslens.source.forge.answers import Answers
from roslens.source.forge.forge_client import LONGEST_WAIT_S, ForgeClient
from roslens.source.forge.forge_error import ForgeError
from roslens.source.forge.forge_place import ForgePlace, given_forge
from roslens.source.forge.issue_counts import IssueCounts, issue_counts

GITHUB = "/api/v3/search/issues?q=repo:o/n type:{} state:{}&per_page=1"


def answers_of_github(forge) -> None:
    # As api.github.com answers, cut to what is read.
    for (what, state), number in {
        ("issue", "open"): 12, ("issue", "closed"): 345, ("pr", "open"): 3, ("pr", "closed"): 210,
    }.items():  # fmt: skip
        body = {"total_count": number, "incomplete_results": False, "items": [{"number": 7}]}
        forge.add(GITHUB.format(what, state), body, etag=f'W/"{what}{state}"')


def ask(forge, kind: str = "github", name: str = "o/n", *, answers=None, environment=None, waits=None, **how):
    _, made = given_forge(f"{forge.url}={kind}")
    slept = [] if waits is None else waits
    with ForgeClient(
        made, answers or Answers(None), environment=environment or {}, sleep=slept.append, now=lambda: 1000.0, **how
    ) as client:
        return issue_counts(client, ForgePlace(made, name))


def test_github(forge):
    answers_of_github(forge)
    assert ask(forge, environment={"GITHUB_TOKEN": "secret"}) == IssueCounts(12, 345, 3, 210)
    assert {headers["authorization"] for _, headers in forge.asked} == {"Bearer secret"}


def test_gitlab(forge):
    project = "/api/v4/projects/g/sub/n"
    forge.add(f"{project}/issues_statistics", {"statistics": {"counts": {"all": 9, "closed": 5, "opened": 4}}})
    for state, number in {"opened": 2, "closed": 1, "locked": 0, "merged": 30}.items():
        forge.add(f"{project}/merge_requests?state={state}&per_page=50&page=1", [], x_total=str(number))
    assert ask(forge, "gitlab", "g/sub/n", environment={"GITLAB_TOKEN": "t"}) == IssueCounts(4, 5, 2, 31)
    assert forge.asked[0][1]["private-token"] == "t"


def test_gitea_with_and_without_totals(forge):
    listed = "/api/v1/repos/o/n/issues?state={}&type={}&limit=50&page={}"
    forge.add(listed.format("open", "issues", 1), [{}] * 50)
    forge.add(listed.format("open", "issues", 2), [{}] * 7)
    forge.add(listed.format("closed", "issues", 1), [{}], x_total_count="8")
    forge.add(listed.format("open", "pulls", 1), [])
    forge.add(listed.format("closed", "pulls", 1), [{}] * 3)
    assert ask(forge, "gitea") == IssueCounts(57, 8, 0, 3)
    assert "authorization" not in forge.asked[0][1]


def test_what_did_not_change_is_not_sent_again(forge, tmp_path):
    answers_of_github(forge)
    for _ in range(2):
        answers = Answers(tmp_path / "forges")
        assert ask(forge, answers=answers) == IssueCounts(12, 345, 3, 210)
        answers.write()
    assert [headers.get("if-none-match") for _, headers in forge.asked[4:]] == [
        'W/"issueopen"', 'W/"issueclosed"', 'W/"propen"', 'W/"prclosed"',
    ]  # fmt: skip
    asked = len(forge.asked)
    assert ask(forge, answers=Answers(tmp_path / "forges"), offline=True) == IssueCounts(12, 345, 3, 210)
    assert len(forge.asked) == asked
    with pytest.raises(ForgeError, match="has no cached response"):
        ask(forge, offline=True)


def test_answers_that_cannot_be_read_are_forgotten(tmp_path):
    (tmp_path / "forges").write_bytes(b"\xc1 no msgpack")
    assert Answers(tmp_path / "forges").last("http://x") is None


def test_a_short_limit_is_waited_for(forge):
    forge.add(GITHUB.format("issue", "open"), {}, 403, x_ratelimit_remaining="0", x_ratelimit_reset="1030")
    forge.add(GITHUB.format("issue", "open"), {}, 429, retry_after="5")
    answers_of_github(forge)
    waits: list[float] = []
    assert ask(forge, waits=waits).open_issues == 12
    assert waits == [30.0, 5.0]


def test_a_long_limit_is_told(forge):
    reset = str(1000 + int(LONGEST_WAIT_S) + 540)
    forge.add(GITHUB.format("issue", "open"), {}, 403, x_ratelimit_remaining="0", x_ratelimit_reset=reset)
    with pytest.raises(ForgeError, match="rate limit is reached for 600 s more") as caught:
        ask(forge)
    assert "GITHUB_TOKEN" in caught.value.advice


def test_faults_are_tried_again_and_then_told(forge):
    forge.add(GITHUB.format("issue", "open"), {}, 500)
    answers_of_github(forge)
    waits: list[float] = []
    assert ask(forge, waits=waits).open_issues == 12
    assert waits == [1.0]
    forge.answers.clear()
    forge.add(GITHUB.format("issue", "open"), {}, 503)
    with pytest.raises(ForgeError, match="answers 503, 3 times"):
        ask(forge)


@pytest.mark.parametrize(
    ("status", "body", "says"),
    [
        (200, b'{"total_count": ', "not JSON"),
        (200, b"<html>down</html>", "not JSON"),
        (200, b"[" * 100_000, "not JSON"),
        (200, b"[]", 'no number "total_count"'),
        (200, b'{"total_count": "12"}', 'no number "total_count"'),
        (200, b'{"total_count": -1}', 'no number "total_count"'),
        (200, b'{"total_count": 3, "incomplete_results": true}', "before it was complete"),
        (401, b"{}", "the token is not accepted"),
        (403, b"{}", "answers 403"),
        (404, b"{}", "no such repository, or it is private"),
        (422, b"{}", "answers 422"),
    ],
)
def test_answers_that_are_none(forge, status, body, says):
    forge.add(GITHUB.format("issue", "open"), body, status)
    with pytest.raises(ForgeError, match=says):
        ask(forge)


def test_a_token_does_not_follow_to_another_address(forge):
    forge.add(GITHUB.format("issue", "open"), {}, 301, location=f"{forge.url}/elsewhere")
    with pytest.raises(ForgeError, match="the repository has moved"):
        ask(forge, environment={"GITHUB_TOKEN": "secret"})
    assert len(forge.asked) == 1


def test_who_does_not_answer(forge):
    gone = type(forge)("http://127.0.0.1:9")
    waits: list[float] = []
    with pytest.raises(ForgeError, match="does not answer"):
        ask(gone, waits=waits)
    assert waits == [1.0, 2.0]


def test_a_list_that_is_none(forge):
    forge.add("/api/v1/repos/o/n/issues?state=open&type=issues&limit=50&page=1", {"message": "no"})
    with pytest.raises(ForgeError, match="does not answer with a list"):
        ask(forge, "gitea")
