"""Texts that streams of C++ put together."""


def test_a_name_is_put_together_by_a_stream(node_of):
    body = (
        'std::stringstream ss; ss << "robot" << 2 << "/" << declare_parameter("of", "scan");\n'
        "create_publisher<std_msgs::msg::String>(ss.str(), 1);\n"
        'std::ostringstream other("first"); other.str("second"); other.clear(); other << "/x";\n'
        "create_publisher<std_msgs::msg::String>(other.str(), 1);"
    )
    first, second = node_of(body).endpoints
    assert (str(first.name), first.name.usual) == ("robot2/{parameter of}", "robot2/scan")
    assert second.name.known == "second/x"
