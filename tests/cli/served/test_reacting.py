"""`roslens serve --live --react ask`: questions of reactions on the site's pages, and who may answer them."""

from __future__ import annotations

import argparse
import re
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from urllib.parse import urlencode

import pytest
from dashboard.fake_run import FakeRun
from dashboard.journal.test_journal_pages import OWN, Client

from roslens.cli.commands import serve
from roslens.cli.main import main
from roslens.cli.page.door import door_of
from roslens.cli.react.react_live import questions_of
from roslens.cli.served.reacting import reacting_beside, refusals_to
from roslens.dashboard.server import create_app
from roslens.intake.generated_secret import Secret, new_secret
from roslens.live.react.actor import CarriedOut
from roslens.model.acting.reaction import Decision
from roslens.model.graph import Graph, Node
from roslens.model.wire import VERSION, Frame
from roslens.store.journals.read_journal import JournalReader

REFERENCE = """\
kind: reference
name: r
defaults: {grace: 0 s}
constraints:
  - {node: /lidar, expected: always}
reactions:
  - id: help_lidar
    when: {node: /lidar, is: gone}
    do: [{restart: {node: /lidar}}]
"""
OPERATOR, VIEWER = new_secret(Secret.TOKEN), new_secret(Secret.TOKEN)
WAIT_S = 25.0


class Robot:
    """A source that sees a node, and after a while no more."""

    def __init__(self) -> None:
        self._begun = time.monotonic()

    def poll(self, seconds: float) -> list[Frame]:
        time.sleep(min(seconds, 0.05))
        there = time.monotonic() - self._begun < 1.0
        nodes = (Node("/camera"), *((Node("/lidar"),) if there else ()))
        now = time.time()
        return [Frame(VERSION, "base/ros2", 0, now, graph=Graph("ros2", nodes), looked=now)]

    def close(self) -> None:
        pass


class Hands:
    """Carries everything out at once, and notes what."""

    descriptors = ()

    def __init__(self) -> None:
        self.done: list[str] = []
        self._came: list[CarriedOut] = []

    def do(self, decision: Decision) -> None:
        self.done.append(decision.id)
        self._came.append(CarriedOut(decision.id, done=True, text="started again"))

    def poll(self) -> list[CarriedOut]:
        found, self._came = self._came, []
        return found

    def waiting(self) -> bool:
        return False

    def unready(self) -> dict[str, str]:
        return {}

    def prepare(self, reactions: object) -> None: ...

    def clear(self, decision: str) -> None: ...

    def stop(self) -> None: ...

    def close(self) -> None: ...


HANDS = Hands()


def until(found: Callable[[], object]) -> object:
    end = time.monotonic() + WAIT_S
    while not (value := found()):
        assert time.monotonic() < end, "it did not come"
        time.sleep(0.05)
    return value


@pytest.fixture
def site(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Client]:
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    monkeypatch.setattr("roslens.cli.react.react_live.sources_of", lambda _: [Robot()])
    monkeypatch.setattr("roslens.cli.react.react_live.Reacting._all_hands", lambda *_: HANDS)
    (tmp_path / "r.yaml").write_text(REFERENCE)
    tokens = tmp_path / "people.txt"
    tokens.write_text(f"operate Olga {OPERATOR}\nview Vera {VIEWER}\n")
    tokens.chmod(0o600)
    parser = argparse.ArgumentParser()
    serve.add_arguments(parser)
    options = parser.parse_args(
        [
            str(tmp_path), "--live", "--react", "ask", "--reference", str(tmp_path / "r.yaml"), "--tokens", str(tokens),
            "--journal", str(tmp_path / "journal.jsonl"), "--quiet",
        ]
    )  # fmt: skip
    questions = questions_of("ask")
    door = door_of(options, "127.0.0.1", acting=True, report=lambda entry: refusals_to(questions, entry))
    with reacting_beside(options, "rover", questions) as (page, further):
        app = create_app(
            FakeRun(packages=3, findings=9, sources=False).site(), snapshot=page.newest, detail=page.detail,
            graph=page.graph, past=page.past, board=page.board, state=page.state, further=further, access=door.access,
        )  # fmt: skip
        yield Client(app)


def seen_by(site: Client, token: str) -> str:
    found = site.request("GET", "/questions", headers={"authorization": f"Bearer {token}"})
    assert found.status_code == 200
    return found.text


def answered(site: Client, token: str, decision: str) -> int:
    headers = {**OWN, "authorization": f"Bearer {token}"} if token else OWN
    return site.post(
        "/questions", content=urlencode({"decision": decision, "answer": "allow"}), headers=headers
    ).status_code


def test_who_may_operate_answers_and_who_may_view_only_sees(site: Client, tmp_path: Path) -> None:
    # One navigation: every page of the site leads to the questions, and these back.
    assert re.search(r'href="/?questions"', site.get("/").text)
    assert 'href="/live/"' in site.get("/questions").text
    (question,) = until(lambda: site.get("/questions.json").json())
    assert question["about"] == "node:/lidar"
    decision = question["decision"]
    assert 'value="allow"' not in seen_by(site, VIEWER)
    assert 'value="allow"' in seen_by(site, OPERATOR)
    assert answered(site, "", decision) in (401, 403)
    assert answered(site, VIEWER, decision) == 403
    assert site.get("/questions.json").json(), "a refused answer counts for nothing"
    assert not HANDS.done
    assert answered(site, OPERATOR, decision) == 303
    assert answered(site, OPERATOR, decision) == 409

    def entries() -> dict[str, dict]:
        return {one.what: one.fields for one in JournalReader(tmp_path / "journal.jsonl").entries()}

    # What was done and who was refused is written down in rounds of its own.
    until(lambda: entries().get("outcome", {}).get("result") == "done" and "refused-answer" in entries())
    reported = entries()
    assert HANDS.done == [decision]
    assert any("Olga" in str(value) for fields in reported.values() for value in fields.values())
    assert "help_lidar" in site.get("/plan").text
    assert "Olga" in site.get("/journal").text


@pytest.mark.parametrize(
    ("words", "why"),
    [
        (["--react", "ask"], "--react without --live"),
        (["--live", "--react", "ask"], "--react without --reference"),
        (["--live", "--allow", "a.yaml"], "--allow without --react"),
    ],
)
def test_what_makes_no_sense_is_refused(words: list[str], why: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["serve", *words]) == 2
    assert why in capsys.readouterr().err
