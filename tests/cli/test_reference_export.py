import json

import pytest
import yaml

from roslens.cli.main import main

ROVER = "examples/robot/rover.yaml"


@pytest.mark.parametrize(("form", "read"), [
    ("prometheus", yaml.safe_load), ("alertmanager", yaml.safe_load), ("grafana", json.loads), ("foxglove", json.loads),
])  # fmt: skip
def test_each_form_can_be_read_and_is_the_same_each_time(form, read, capsys):
    assert main(["reference", "export", ROVER, f"--{form}"]) == 0
    first = capsys.readouterr().out
    assert read(first)
    assert main(["reference", "export", ROVER, f"--{form}", "-q"]) == 0
    assert capsys.readouterr().out == first


def test_a_form_is_asked_for(capsys):
    with pytest.raises(SystemExit):
        main(["reference", "export", ROVER])
    assert "--grafana" in capsys.readouterr().err
