"""What of a description reaches the output of xacro: where a comment is that YAML takes for more than a text.

What is expected was found with xacro 2.1.1 and PyYAML.
"""

import pytest

from roslens.source.rules.launch.runs.xacro_output import has_sign, output_has_sign

ROBOT = '<robot name="a" xmlns:xacro="http://www.ros.org/wiki/xacro">\n{}\n</robot>\n'
MARK = "<!-- elbow: left -->"


@pytest.mark.parametrize(
    ("inside", "reaches"),
    [
        (f"{MARK}\n<link name='a'/>", True),
        ("<!-- elbow -->\n<link name='a'/>", False),
        ("<!-- see http://a.b -->", False),
        ("<!-- # elbow -->", True),
        ("<!-- elbow:\n left -->", True),
        ("<!-- elbow\n\tleft -->", True),
        ("\t<link name='a'/>", False),
        (f"<link name='a'>{MARK}</link>", True),
        (MARK, True),
        *((f"{MARK}\n<xacro:{tag}/>", False) for tag in ("include filename='b'", "property name='b' value='1'", "b")),
        *(
            (f"{MARK}\n<xacro:{tag}/>", False)
            for tag in ("arg name='b' default='1'", "if value='1'", "unless value='1'")
        ),
        *((f"{MARK}\n<xacro:{tag}/>", True) for tag in ("insert_block name='b'", "attribute name='b' value='1'")),
        (f"{MARK}\n<!-- elbow -->\n<xacro:b/>", False),
        (f"{MARK}\n\n<xacro:b/>", True),
        (f"{MARK}\n text <xacro:b/>", True),
        (f"<xacro:if value='1'>{MARK}<link name='a'/></xacro:if>", True),
        (f"<xacro:macro name='b'>{MARK}<link name='a'/></xacro:macro>", False),
        (f"<xacro:macro name='b'>{MARK}<link name='a'/></xacro:macro><xacro:b/>", True),
        (f"<xacro:macro name='b'><link name='a'>{MARK}</link></xacro:macro>\n{MARK}", True),
        (f"<xacro:b>{MARK}<origin/></xacro:b>", False),
        (f"<xacro:b><origin>{MARK}</origin></xacro:b>", True),
        ("<xacro:property name='b' value='{x: 1}'/>", False),
        ("<link name='x: 1'/>", True),
        ("<link name=\"${b['x: 1']}\"/>", False),
        ("<plugin>x: 1</plugin>", True),
        ("<!-- xacro:eval-comments: on -->", False),
    ],
)
def test_comments_reach_the_output_where_xacro_copies_them(inside, reaches):
    assert output_has_sign({"a.urdf.xacro": ROBOT.format(inside).encode()}) is reaches


def test_of_an_included_file_what_stands_around_its_root_is_dropped():
    arm = f"{MARK}\n{ROBOT.format('')}".encode()
    whole = ROBOT.format("<xacro:include filename='$(find a)/urdf/arm.xacro'/>").encode()
    assert output_has_sign({"a/arm.xacro": arm})
    assert not output_has_sign({"a/arm.xacro": arm, "a/all.xacro": whole})


def test_a_macro_may_be_called_in_another_file():
    macro = ROBOT.format(f"<xacro:macro name='b'><link name='a'>{MARK}</link></xacro:macro>").encode()
    assert output_has_sign({"a.xacro": macro, "b.xacro": ROBOT.format("<xacro:b/>").encode()})


@pytest.mark.parametrize("content", [b"", b"\xff", b"<robot", b"<robot><a></robot>", b"<!ENTITY", b"<!-- a"])
def test_what_is_no_description_has_nothing(content):
    assert not output_has_sign({"a.xacro": content})


def test_what_another_program_puts_out_is_the_file_itself():
    assert has_sign(ROBOT.format(f"{MARK}\n<xacro:property name='b' value='1'/>").encode())
    assert not has_sign(ROBOT.format("<!-- elbow -->").encode())
