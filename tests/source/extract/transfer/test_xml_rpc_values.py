import pytest

from roslens.source.extract.symbolic.condition import as_written

FILL = 'XmlRpc::XmlRpcValue all; all["size"] = 5; all["name"] = std::string("x");'


def writes(facts):
    return [
        (str(one.name), one.type, str(one.value), as_written(one.conditions))
        for one in facts.parameters
        if one.access == "written"
    ]


@pytest.mark.parametrize("before", ["", "using namespace XmlRpc;"])
def test_each_item_is_a_parameter(main_of, before):
    fill = FILL if not before else FILL.replace("XmlRpc::XmlRpcValue", "XmlRpcValue")
    assert writes(main_of(f'{fill} nh.setParam("deep", all);', before)) == [
        ("deep/size", "int", "5", ()),
        ("deep/name", "string", "x", ()),
    ]


def test_the_condition_of_an_item_is_kept(main_of):
    body = """
XmlRpc::XmlRpcValue all;
int size;
if (nh.getParam("size", size)) all["size"] = size;
if (all.valid()) ros::param::set("deep", all);
"""
    assert writes(main_of(body)) == [
        ("deep/size", "", "{parameter size}", ('nh->getParam("size", size)', "all->valid()"))
    ]


def test_values_within_values(main_of):
    body = f'{FILL} XmlRpc::XmlRpcValue outer; outer["inner"] = all; nh.setParam("deep", outer);'
    assert [one[0] for one in writes(main_of(body))] == ["deep/inner/size", "deep/inner/name"]


def test_an_item_without_a_known_name_is_left_out(main_of):
    body = 'XmlRpc::XmlRpcValue all; all[0] = 5; all[name()] = 6; nh.setParam("deep", all);'
    assert writes(main_of(body)) == [("deep", "", "{a structured value}", ())]
