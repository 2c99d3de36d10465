"""The values that describe an interface."""

from roslens.source.extract.interfaces.interface import (
    Checksum,
    FieldType,
    Interface,
    InterfaceField,
    Message,
    unknown_field_type,
)


def test_names():
    assert FieldType("Pose", "geometry_msgs", "unbounded").message == "geometry_msgs/msg/Pose"
    assert FieldType("float64").message == ""
    assert Interface("nav_msgs", "GetMap", "srv", 1, (Message(), Message())).full_name == "nav_msgs/srv/GetMap"


def test_checksum():
    assert Checksum("abc")
    assert not Checksum(unknown="no such file")
    assert unknown_field_type("a/msg/M", InterfaceField("pose", FieldType("Pose", "g"))).unknown == (
        "'g/msg/Pose', the type of field 'pose' of a/msg/M, is unknown"
    )
