import pytest

from roslens.source.fix.edited_content import edited
from roslens.source.rules.edits.manifest_edits import ManifestEdits, joined


def with_added(text, tag="depend", name="tf2"):
    content = text.encode()
    return edited(content, ManifestEdits(content, "package.xml").added(tag, name)).decode()


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (
            '<package format="3">\n  <name>a</name>\n  <depend>b</depend>\n  <test_depend>c</test_depend>\n</package>',
            (
                '<package format="3">\n  <name>a</name>\n  <depend>b</depend>\n  <depend>tf2</depend>\n'
                "  <test_depend>c</test_depend>\n</package>"
            ),
        ),
        (
            (
                '<package format="3">\n\t<name>a</name>\n\t<build_depend>b</build_depend> <!-- why -->\n'
                "\t<exec_depend>c</exec_depend>\n</package>"
            ),
            (
                '<package format="3">\n\t<name>a</name>\n\t<build_depend>b</build_depend> <!-- why -->\n'
                "\t<depend>tf2</depend>\n\t<exec_depend>c</exec_depend>\n</package>"
            ),
        ),
        (
            '<package format="3"><name>a</name><depend>b</depend></package>',
            '<package format="3"><name>a</name><depend>b</depend>\n<depend>tf2</depend></package>',
        ),
        (
            '<package format="3">\r\n  <name>a</name>\r\n</package>\r\n',
            '<package format="3">\r\n  <name>a</name>\r\n  <depend>tf2</depend>\r\n</package>\r\n',
        ),
    ],
)
def test_an_element_comes_behind_its_like(text, expected):
    assert with_added(text) == expected


@pytest.mark.parametrize("text", ["", "<package>", "<robot/>", "<package/>", '<package format="3"><name>a</package>'])
def test_of_what_is_no_manifest_no_edit_is_made(text):
    assert not ManifestEdits(text.encode(), "package.xml").added("depend", "tf2")


def test_an_element_is_taken_away_with_its_line_or_without():
    content = b"<package>\n  <depend>a</depend>\n  <depend>b</depend> <depend>c</depend>\n</package>\n"
    edits = ManifestEdits(content, "package.xml")
    first, second, _ = edits.elements("depend")
    assert edited(content, edits.removed(first)) == content.replace(b"  <depend>a</depend>\n", b"")
    assert edited(content, edits.removed(second)) == content.replace(b"<depend>b</depend>", b"")


def test_an_element_is_renamed_with_its_attributes():
    content = b'<package>\n  <test_depend condition="$ROS_VERSION == 2">a</test_depend>\n</package>\n'
    edits = ManifestEdits(content, "package.xml")
    (element,) = edits.elements(text="a")
    assert edited(content, edits.renamed(element, "depend")) == content.replace(b"test_depend", b"depend")


def test_several_are_one_lot_or_none():
    content = b'<package format="3">\n  <name>a</name>\n</package>\n'
    added = ManifestEdits(content, "package.xml").added("depend", "b")
    assert joined([added, added]) == added
    assert joined([added, ()]) == ()
