"""Other names of plain values, which are set and read where they stand."""

PUB = "create_publisher<std_msgs::msg::String>({}, 1);"


def test_a_reference_sets_what_it_is_a_name_of(node_of, names):
    body = 'std::string a = "a"; std::string & b = a; b = "b"; b += "c";' + PUB.format("a")
    assert names(node_of(body)) == [("publisher", "bc")]


def test_a_reference_is_what_it_is_a_name_of(node_of, names):
    body = 'auto & b = options_.name; options_.name = "b";' + PUB.format("b")
    members = 'struct Options { std::string name = "a"; }; Options options_;'
    assert names(node_of(body, members)) == [("publisher", "b")]


def test_a_reference_decides(node_of, names):
    body = "bool & on = on_; on = true; if (on_) {" + PUB.format('"a"') + "} else {" + PUB.format('"b"') + "}"
    assert names(node_of(body, "bool on_ = false;")) == [("publisher", "a")]


def test_what_a_pointer_sets_is_unknown(node_of):
    body = 'std::string a = "a"; std::string * b = &a; *b = "b";' + PUB.format("a")
    (one,) = node_of(body).endpoints
    assert one.name.known is None


def test_a_reference_to_what_is_unknown_or_an_object_is_as_it_was(node_of, names):
    body = 'auto & q = quality_; q = rclcpp::QoS(1); Options & o = options_; o.name = "c";'
    body += PUB.format("options_.name")
    members = 'struct Options { std::string name = "a"; }; Options options_;'
    assert names(node_of(body, members)) == [("publisher", "c")]


def test_a_function_without_name_knows_them(node_of, names):
    body = 'std::string a = "a"; std::string & b = a; auto make = [&]() {' + PUB.format("b") + "}; make();"
    assert names(node_of(body)) == [("publisher", "a")]
