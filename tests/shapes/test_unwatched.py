"""What commands read that nobody watches is so small, or so soon refused, that no shape of it takes long or much."""

import contextlib
import tempfile
from pathlib import Path

import pytest
from pace import slowness

from roslens.cli.served.reviewing import MOST_HERE
from roslens.cli.workplace import configuration
from roslens.cli.workplace.accepted_file import entries_of
from roslens.cli.workplace.configuration import read_configuration
from roslens.intake import safe_yaml
from roslens.judge.documents import yaml_tree
from roslens.judge.reading.read_reference import GivenText, load_reference
from roslens.live.adapters.bag.damage import FailureLog
from roslens.live.adapters.bag.files.recorded_files import find_files
from roslens.live.window.signals import BY_KEY
from roslens.model.errors import RoslensError
from roslens.source.fetch.distribution import read_mapping
from roslens.source.fetch.document import reader
from roslens.source.fetch.journal import read_lock
from roslens.source.fetch.retry import Retry
from roslens.source.fetch.taken import LOCK
from shapes.readers import measured_by
from shapes.shapes import SHAPES

MOST_S = 5
"""Of a processor, for one file, of an idle machine."""

MOST_MB = 200
"""By which the process grows."""


def configured(path):
    read_configuration(path)


def named(path):
    read_mapping(reader(Retry(print), offline=True), str(path))


def locked(path):
    read_lock(path.parent)


def referred(path):
    load_reference([GivenText("robot.yaml", path.read_bytes())], BY_KEY)


def recorded(path):
    find_files(path.parent, FailureLog())


READS = {
    "roslens.accepted.toml": (entries_of, "TOML", MOST_HERE),
    "roslens.toml": (configured, "TOML", configuration.MOST_BYTES),
    "robot.repos": (named, "YAML", safe_yaml.MOST_BYTES),
    LOCK: (locked, "YAML", safe_yaml.MOST_BYTES),
    "robot.yaml": (referred, "YAML", yaml_tree.MAX_BYTES),
    "metadata.yaml": (recorded, "YAML", safe_yaml.MOST_BYTES),
}
"""What reads each file, the grammar of it, and how many bytes of it are read."""


def read(name, content):
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, name)
        path.write_bytes(content)
        with contextlib.suppress(RoslensError):
            READS[name][0](path)


@pytest.mark.heavy
@pytest.mark.parametrize("share", [0.1, 0.2, 1])
@pytest.mark.parametrize("name", READS)
def test_no_shape_takes_long_or_much(name, share):
    _, grammar, most = READS[name]
    for title, shape in SHAPES[grammar].items():
        found = measured_by(lambda content: read(name, content), shape(int(most * share))[:most])
        assert not found.left_out, title
        assert found.seconds < MOST_S * slowness(), title
        assert found.grown < MOST_MB, title
