"""The tool ``ament_xmllint``: XML that is well-formed and fits the schema it names."""

from __future__ import annotations

from roslens.source.tools.ament import AmentLinter


class AmentXmllint(AmentLinter):
    """Manifests and launch files; it asks the net for the schemas that they name."""

    name = "ament_xmllint"
    program = "ament_xmllint"
    text = "XML that is well-formed and fits its schema; the schema comes from the net."
    languages = ("manifest", "launch_xml", "urdf", "xacro", "xml")
    check = "xmllint"
    asks_the_net = True


plugin = AmentXmllint()
