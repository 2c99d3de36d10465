"""XML that launch and roslaunch do not take, with its place: as ElementTree and minidom judge it."""

import xml.etree.ElementTree as ET
from io import StringIO
from xml.dom import minidom

import pytest

from roslens.source.extract.launch.refused_xml import refused_xml

REFUSED = {
    "mismatch": (b"<launch>\n  <group>\n</launch>", 3, "</launch> where <group> of line 2 is open", "</group>"),
    "never closed": (b"<launch>\n  <group>\n", 3, "<group> of line 2 is never closed", "</group>"),
    "in a tag": (b"<launch>\n  <node pkg='a'\n", 2, "<launch> of line 1 is never closed", "</launch>"),
    "comment": (b"<launch>\n  <!-- a -- b -->\n</launch>", 2, "not well-formed", "a comment without `--` in it"),
    "ampersand": (b"<launch>\n  <a b='x & y'/>\n</launch>", 2, "not well-formed", "`&amp;` for `&`"),
    "less": (b'<launch>\n  <a b="x < y"/>\n</launch>', 2, "not well-formed", "`&lt;` for `<` in an attribute"),
    "twice": (b"<launch>\n  <a b='1' b='2'/>\n</launch>", 2, "duplicate attribute", "well-formed XML"),
    "two roots": (b"<launch/>\n<launch/>", 2, "junk after document element", "well-formed XML"),
    "empty": (b"", 1, "no element found", "well-formed XML"),
    "no text": (bytes(range(1, 200)), 1, "", ""),
}


@pytest.mark.parametrize(("content", "line", "what", "expected"), REFUSED.values(), ids=REFUSED)
def test_what_is_not_well_formed(content, line, what, expected):
    found = refused_xml(content, in_utf8=False)
    assert found.line == line
    assert found.what.startswith(what)
    assert found.expected.startswith(expected)
    with pytest.raises(Exception):  # noqa: B017, PT011 - minidom raises what expat says
        minidom.parseString(content)


@pytest.mark.parametrize(
    "content",
    [
        b"<launch/>",
        b"\xef\xbb\xbf<launch/>",
        b"<?xml version='1.0'?>\n<!-- a -->\n<launch><a b='&lt;&amp;'/></launch>\n<!-- b -->",
        b"<?xml version='1.0' encoding='iso-8859-1'?><launch>\xc3\xa9</launch>",
    ],
    ids=range(4),
)
def test_what_launch_takes(content):
    assert refused_xml(content, in_utf8=True) is None
    ET.parse(StringIO(content.decode("utf-8")))


def test_launch_takes_a_file_for_utf_8_and_roslaunch_believes_what_it_declares():
    content = "<?xml version='1.0' encoding='iso-8859-1'?>\n<launch a='é'/>".encode("latin-1")
    assert refused_xml(content, in_utf8=False) is None
    assert refused_xml(content, in_utf8=True).what == "the byte 0xe9, which is not UTF-8"
    assert refused_xml(content, in_utf8=True).line == 2


def test_entities_are_not_judged_and_do_not_grow():
    grown = b"<!DOCTYPE launch [<!ENTITY a 'aaaaaaaaaa'><!ENTITY b '&a;&a;&a;&a;'>]><launch>&b;</launch"
    assert refused_xml(grown, in_utf8=True) is None


def test_deep_and_long_files():
    # launch and roslaunch visit elements by calls of Python, which nest a thousand deep at most.
    deep = refused_xml(b"<launch>" + b"<group>" * 2000 + b"</group>" * 2000 + b"</launch>", in_utf8=True)
    assert deep is not None
    assert deep.what == "more than 1,000 levels of elements"
    assert refused_xml(b"<launch>" + b"<group>" * 900 + b"</group>" * 900 + b"</launch>", in_utf8=True) is None
    assert refused_xml(b"<launch>" + b"<node pkg='a' exec='b'/>" * 100_000 + b"</launch>", in_utf8=True) is None
    found = refused_xml(b"<launch>\n" + b"<group>\n" * 2000 + b"</launch>", in_utf8=True)
    assert found.what.startswith("</launch> where <group> of line 2001 is open")
