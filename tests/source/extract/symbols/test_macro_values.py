def test_a_macro_of_several_headers_is_that_of_the_included_one(units, names):
    main = (
        'int main(int c, char ** v) { ros::init(c, v, "a"); ros::NodeHandle n; auto p = n.advertise<p::M>(TOPIC, 1); }'
    )
    found = units(
        a_h='#define TOPIC "of_a"\n',
        b_h='#define TOPIC "of_b"\n',
        a_cpp='#include "a.h"\n' + main,
        b_cpp='#include "b.h"\n' + main,
        c_cpp=main,
    )
    assert [names(one) for one in found[:2]] == [[("publisher", "of_a")], [("publisher", "of_b")]]
    # Which of both it is where neither is included is not known, and never certain.
    assert found[2].endpoints[0].name.known is None
