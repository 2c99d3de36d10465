find_package(ament_cmake_test QUIET REQUIRED)

include("${ament_cmake_roslens_DIR}/ament_roslens.cmake")

ament_register_extension("ament_lint_auto" "ament_cmake_roslens" "ament_cmake_roslens_lint_hook.cmake")
