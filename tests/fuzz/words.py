"""Words that mean something to readers, separated by spaces; they are put into what is mutated."""

XML = (
    "<launch> </launch> <node pkg='pkg' exec='a' name='b'> <arg name='a' default='$(var a)'/> <include "
    "file='$(find pkg)/launch/a.launch'> <group> </group> <!-- --> <![CDATA[ ]]> &amp; &#x41; &a; "
    "<!DOCTYPE <?xml ?> \x00 ÿ if='$(eval 1/0)' $(arg $(env $(dirname) ns= <param <rosparam <remap "
    "clear_params= <depend condition='$A==1'>"
)
CODE = (
    "{ } ( ) [ ] < > ; : :: , . -> = == && || & * ! ? ~ # + - / // /* */ \\ int void auto const template< "
    "typename operator for if else while switch case return class struct namespace using #if #ifdef #else "
    '#endif #define R"( )" \'x\' " create_publisher<A>( create_subscription declare_parameter( '
    "ros::NodeHandle std::bind(&A::b,this) \\\n \n \t \x00 ÿ"
)
PYTHON = (
    "( ) [ ] { } : = == , . -> @ lambda def class for if elif else while try except finally with as return "
    'yield await async import from None True """ \'\'\' f"{a!r:>{b}}" r"\\ \\\n \n\t \n    \n ** * // %s % '
    "0x 1e999 self. create_publisher( declare_parameter( rospy.Publisher( LaunchDescription( Node( "
    "generate_launch_description \x00 ÿ \ufeff"
)
CMAKE = (
    "if( elseif( else() endif() foreach( endforeach() while( endwhile() function( endfunction() macro( "
    'endmacro() set( list(APPEND string(REGEX REPLACE math(EXPR a "1/0") ${ } ${${a}} $ENV{ '
    '$<TARGET_OBJECTS: > " [[ ]] [=[ ]=] # #[[ \\ ; \n add_executable( add_library( target_link_libraries( '
    "install(TARGETS file(GLOB_RECURSE include( CMAKE_SOURCE_DIR PARENT_SCOPE ARGN ARGV0 return() break() "
    "(.*)* cmake_parse_arguments( \x00 ÿ"
)
YAML = (
    "a: - [ ] { } , & &a *a !! !!python/object:os.system !!binary | > |2- ' \" # --- ... ? <<: *a ~ null "
    ".inf .nan 1e999 0x 0o7 1_000 2001-01-01 12:30:45 \n \n   \n- \t % @ ` ros__parameters: /**: kind: "
    "select: rate: constraints: reactions: when: all: any: not: at_least: among: within: is: gone for: 1s do: "
    "restart: {entity} verify: given: at: expect: \ufeff \x00 ÿ \u2028"
)
BAG = (
    "#ROSBAG V2.0\n op=\x02 op=\x03 op=\x04 op=\x05 op=\x06 op=\x07 conn= time= compression=bz2 "
    "compression=lz4 size= chunk_pos= index_pos= topic= \x89MCAP0\r\n zstd lz4 \x00 \x00\x00\x00\x00 ÿÿÿÿ "
    "BZh9"
)
PACKED = (
    "\x93 \x9f Üÿÿ Ýÿÿÿÿ À Á Â Ë\x7fø\x00\x00\x00\x00\x00\x00 Ë\x7fð\x00\x00\x00\x00\x00\x00 Ïÿÿÿÿÿÿÿÿ "
    "Ó\x80\x00\x00\x00\x00\x00\x00\x00 Ùÿ Ûÿÿÿÿ \x80 ßÿÿÿÿ host: process: /scan \x00 \x00\x00\x00\x13H\x03 "
    "A F"
)
MESSAGE = (
    "int8 uint64 float64 string wstring string<= string<=99999999999999999999 [ ] [] [3] [<=3] [1000000000] --- = "
    "# \" ' \\n Header header time duration geometry_msgs/Pose pkg/A / . A=1 A=1e999 A=0x 1_0 -1 True \n \r \t "
    "\x00 ÿ \ufeff"
)
TOML = (
    "[ ] [[ ]] { } = , . \" ' \"\"\" ''' \\ \\u0000 \\U0010ffff # true false 1e999 nan inf 0x 0o7 1_0 2001-01-01 "
    "12:30:45 [tools] use command [options.cppcheck] plugins = models disable [workspace] exclude [macros] "
    "[fetch.rewrite] ** *(*)* \n \r \t \x00 ÿ \ufeff"
)
