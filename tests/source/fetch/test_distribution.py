"""What index and distribution files name; what is wrong in one is its own failure."""

import pytest

from roslens.model.errors import UsageError
from roslens.source.fetch.distribution import distribution_of, read_distribution
from roslens.source.fetch.document import reader
from roslens.source.fetch.retry import Retry
from roslens.source.fetch.wanted import Wanted

FILE = """\
type: distribution
version: {version}
release_platforms: {{ubuntu: [noble]}}
repositories:
  both:
    doc: {{type: git, url: "https://h/doc.git", version: d}}
    release:
      packages: [one, two]
      tags: {{release: "release/x/{{package}}/{{version}}"}}
      url: https://h/r.git
      version: 1.0.0-1
    source: {{type: git, url: "https://h/both.git", version: main}}
  documented:
    doc: {{type: hg, url: "https://h/documented", version: default}}
  released:
    release:
      packages: [one_r, two_r]
      tags: {{release: "release/x/{{package}}/{{version}}"}}
      url: https://h/rel.git
      version: 2.0.0-0
  single:
    release: {{tags: {{release: "release/x/{{package}}/{{version}}"}}, url: "https://h/single.git", version: 3.0.0-0}}
  half:
    release: {{packages: [half]}}
    source: {{type: git, url: "https://h/half.git"}}
  broken:
    source: {{type: git, version: main}}
  nothing: {{}}
  text: hello
"""
INDEX = """\
type: index
version: 4
distributions:
  x: {distribution: [x/distribution.yaml], distribution_status: active, distribution_type: ros2, python_version: 3}
"""


@pytest.fixture
def index(tmp_path):
    (tmp_path / "x").mkdir()
    (tmp_path / "index.yaml").write_text(INDEX)
    (tmp_path / "x" / "distribution.yaml").write_text(FILE.format(version=2))
    return str(tmp_path / "index.yaml")


@pytest.fixture
def read():
    return reader(Retry(lambda _: None), offline=True)


@pytest.mark.parametrize("version", [1, 2])
def test_source_then_doc_then_release(read, index, tmp_path, version):
    (tmp_path / "x" / "distribution.yaml").write_text(FILE.format(version=version))
    found = read_distribution(read, "x", index)
    by_name = {one.name: one for one in found.repositories}
    assert by_name["both"] == Wanted("both", "https://h/both.git", "main", "git", ("one", "two"))
    assert by_name["documented"] == Wanted("documented", "https://h/documented", "default", "hg")
    assert by_name["released/two_r"] == Wanted(
        "released/two_r", "https://h/rel.git", "release/x/two_r/2.0.0-0", "git", ("two_r",)
    )
    assert by_name["single"].version == "release/x/single/3.0.0-0"
    assert by_name["half"].url == "https://h/half.git"
    assert {str(one.entity) for one in found.failures} == {
        "repository:broken", "repository:nothing", "repository:text"
    }  # fmt: skip
    assert not found.remote


def test_an_unknown_distribution(read, index):
    with pytest.raises(UsageError, match="has no distribution 'y'; expected one of x"):
        read_distribution(read, "y", index)


@pytest.mark.parametrize(
    "text", ["[1]", "type: index\nversion: 9\ndistributions: {}", "type: other", "a: [", "distributions: 7"]
)
def test_no_index(read, tmp_path, text):
    (tmp_path / "i.yaml").write_text(text)
    with pytest.raises(UsageError, match=r"i\.yaml"):
        read_distribution(read, "x", str(tmp_path / "i.yaml"))


@pytest.mark.parametrize(
    "data",
    [{}, {"type": "distribution"}, {"type": "distribution", "version": 3}, {"type": "distribution", "version": "two"}],
)
def test_no_distribution_file(data):
    with pytest.raises(UsageError, match="type: distribution, and version: 1 or 2"):
        distribution_of(data, "d.yaml")


def test_a_distribution_of_the_network_says_so(read):
    assert distribution_of({"type": "distribution", "version": 2}, "https://h/d.yaml").remote
