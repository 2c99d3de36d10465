import re
import subprocess

import pytest
import yaml

from roslens.judge.reference.merge_references import constraints_of
from roslens.live.publish.exported.prometheus_rules import prometheus_rules


def rules(reference):
    return [rule for group in yaml.safe_load(prometheus_rules(reference))["groups"] for rule in group["rules"]]


def test_each_sentence_has_a_rule_that_asks_for_its_verdict(rover):
    asked = " ".join(rule["expr"] for rule in rules(rover))
    for constraint in constraints_of(rover):
        assert f'expectation="{constraint.details.id}"' in asked
    scan = next(rule for rule in rules(rover) if "rover.topic.scan.rate" in rule["expr"])
    assert scan["labels"] == {"severity": "error", "reference": "rover", "group": "driving"}
    assert "25 Hz" in scan["annotations"]["summary"]
    assert scan["annotations"]["constraint"] == "rover.yaml:6"
    assert "for" not in scan


def test_templates_of_a_text_stay_text(rover):
    scan = next(rule for rule in rules(rover) if "rover.topic.scan.rate" in rule["expr"])
    assert scan["annotations"]["description"] == 'Look at "{{ "{{" }} the }}" cable'


def test_names_are_those_that_every_version_takes(rover):
    names = [rule["alert"] for rule in rules(rover)]
    assert all(re.fullmatch("[a-zA-Z_][a-zA-Z0-9_]*", name) for name in names)


def test_that_nobody_watches_is_an_alert_too(rover):
    assert any(rule["expr"] == "absent(roslens_records_total)" for rule in rules(rover))


def test_a_journal_that_lost_its_end_is_one_as_well(rover):
    (rule,) = (rule for rule in rules(rover) if rule["alert"] == "RoslensJournalChanged")
    assert rule["expr"].startswith("roslens_journal_whole == 0 or roslens_journal_entries < ")


@pytest.mark.real
def test_promtool_takes_the_rules(rover, promtool, tmp_path):
    path = tmp_path / "rover.rules.yml"
    path.write_text(prometheus_rules(rover))
    done = subprocess.run([promtool, "check", "rules", path], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert f"{len(rules(rover))} rules found" in done.stdout


UNIT = """\
rule_files: [{rules}]
evaluation_interval: 1m
tests:
  - interval: 1m
    input_series:
      - series: 'roslens_records_total'
        values: '1 2 3'
      - series: 'roslens_state{{kind="topic",name="/scan",expectation="rover.topic.scan.rate",quantity="rate",
          severity="error",state="low"}}'
        values: '1 1 _'
    alert_rule_test:
      - eval_time: 1m
        alertname: {name}
        exp_alerts:
          - exp_labels: {{severity: error, reference: rover, group: driving, kind: topic, name: /scan,
              expectation: rover.topic.scan.rate, quantity: rate, state: low}}
            exp_annotations:
              summary: '{summary}'
              cause: ''
              description: 'Look at "{{{{ the }}}}" cable'
              constraint: rover.yaml:6
      - eval_time: 8m
        alertname: {name}
        exp_alerts: []
"""


@pytest.mark.real
def test_an_alert_fires_while_a_verdict_is_bad(rover, promtool, tmp_path):
    path = tmp_path / "rover.rules.yml"
    path.write_text(prometheus_rules(rover))
    scan = next(rule for rule in rules(rover) if "rover.topic.scan.rate" in rule["expr"])
    summary = scan["annotations"]["summary"].rpartition("; expected: ")[2]
    (tmp_path / "test.yml").write_text(
        UNIT.format(rules=path.name, name=scan["alert"], summary=f"topic /scan: rate is low; expected: {summary}")
    )
    done = subprocess.run(
        [promtool, "test", "rules", "test.yml"], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
