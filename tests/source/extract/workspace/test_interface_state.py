import pytest

from roslens.source.extract.workspace.interface_state import interface_difference, interface_state
from roslens.source.settings import SourceSettings

MANIFEST = """<package format="3"><name>rover_msgs</name><version>{version}</version><description>d</description>
<maintainer email="a@example.org">a</maintainer><license>MIT</license><depend>std_msgs</depend>
<export><build_type>ament_cmake</build_type></export></package>
"""


@pytest.fixture
def state(tmp_path):
    def made(name, version, **files):
        folder = tmp_path / name / "rover_msgs"
        (folder / "msg").mkdir(parents=True)
        (folder / "package.xml").write_text(MANIFEST.format(version=version))
        for stem, text in files.items():
            (folder / "msg" / f"{stem}.msg").write_text(text)
        return interface_state(tmp_path / name, SourceSettings())

    return made


def test_messages_of_ros_are_known(state):
    found = state("a", "1.0.0", Stamped="std_msgs/Header header\n")
    assert found.checksums["rover_msgs/msg/Stamped"].startswith("RIHS01_")


def test_what_contains_a_changed_one_is_another_type(state):
    outer = "Middle[] all\n"
    before = state("a", "1.2.3", Inner="int32 a\n", Middle="Inner one\n", Outer=outer, Apart="int8 x\n")
    after = state("b", "1.2.3", Inner="int64 a\n", Middle="Inner one\n", Outer=outer, Apart="int8 x\n")
    found = interface_difference(before, after)
    inner, middle, outer = (f"rover_msgs/msg/{one}" for one in ("Inner", "Middle", "Outer"))
    assert [one.interface for one in found.changes] == [inner]
    assert found.containing == {middle: (inner,), outer: (inner,)}
    assert found.on_wire == {inner, middle, outer}
    assert set(found.checksums) == {inner, middle, outer}
    assert all(old != new for old, new in found.checksums.values())


@pytest.mark.parametrize(
    ("before", "after", "changed", "least", "enough"),
    [
        ("1.2.3", "1.2.4", True, "2.0.0", False),
        ("1.2.3", "2.0.0", True, "2.0.0", True),
        ("0.2.3", "0.2.4", True, "0.3.0", False),
        ("0.2.3", "0.3.0", True, "0.3.0", True),
        ("1.2.3", "1.2.4", False, "1.3.0", False),
        ("1.2.3", "1.3.0", False, "1.3.0", True),
    ],
)
def test_the_version_that_follows(state, before, after, changed, least, enough):
    more = {} if changed else {"New": "int8 b\n"}
    found = interface_difference(
        state("a", before, A="int32 a\n"), state("b", after, A="int64 a\n" if changed else "int32 a\n", **more)
    )
    (step,) = found.steps
    assert (step.least, step.enough) == (least, enough)


def test_a_file_that_is_refused_is_listed_and_not_taken_for_unchanged(state):
    found = interface_difference(state("a", "1.0.0", A="int32 a\n"), state("b", "1.0.0", A="int32 Wrong\n"))
    assert found.changes == ()
    assert [one.partition(":")[0] for one in found.unread] == ["rover_msgs/msg/A.msg"]
