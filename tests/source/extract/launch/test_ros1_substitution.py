import pytest

from roslens.source.extract.launch.ros1_substitution import Scope, SubstitutionError, substitute, truth
from roslens.source.extract.symbolic.reason import OfEnvironment
from roslens.source.extract.symbolic.text import Hole, Text, unknown


class Files:
    def package(self, name):
        return {"robot": "src/robot"}.get(name)

    def content(self, path):
        return None


SCOPE = Scope(
    Files(),
    "src/robot/launch",
    {"name": Text.of("r2"), "open": unknown(OfEnvironment("X")), "n": Text.of("3")},
    {"A": "b"},
)


@pytest.mark.parametrize(
    ("text", "result"),
    [
        ("plain", "plain"),
        ("", ""),
        ("$(arg name)/$(arg name)", "r2/r2"),
        ("$(find robot)/x.yaml", "src/robot/x.yaml"),
        ("$(dirname)/../y", "src/robot/launch/../y"),
        ("$(env A)$(optenv A c)", "bb"),
        ("$(eval 'x' + name + str(n + 1))", "xr24"),
        ("$(eval arg('n') * 2)", "6"),
        ("$(eval find('robot') + '/f')", "src/robot/f"),
        ("$(eval env('B'))", "*"),
        ("$(eval open)", "*"),
        ("a$(arg open)b", "a*b"),
        ("$5 (x)", "$5 (x)"),
    ],
)
def test_substitutions(text, result):
    assert substitute(text, SCOPE).pattern == result


def test_holes_keep_reason_and_default():
    assert substitute("$(optenv HOME /root)", SCOPE).parts == (Hole(OfEnvironment("HOME"), default="/root"),)
    assert substitute("$(eval open + 'x')", SCOPE).holes[0].reason.endswith("the name 'open' is unknown")
    assert substitute("$(find gone)", SCOPE).holes[0].reason == "folder of package gone, which is not in the workspace"


@pytest.mark.parametrize(
    "text", ["$(arg)", "$(arg gone)", "$(bad x)", "$(find x", "$()", "$(find $(arg open))", "$(find $(arg name))"]
)
def test_what_roslaunch_refuses(text):
    with pytest.raises(SubstitutionError):
        substitute(text, SCOPE)


def test_conditions():
    assert [truth(Text.of(one)) for one in ("true", "1", "False", "0")] == [True, True, False, False]
    assert truth(unknown("x")) is None
    with pytest.raises(SubstitutionError, match="not a condition"):
        truth(Text.of("yes"))
