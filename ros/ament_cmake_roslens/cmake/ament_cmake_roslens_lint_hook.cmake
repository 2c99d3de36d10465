if(NOT TARGET ${PROJECT_NAME}_roslens)
  message(STATUS "Added test 'roslens' to check the package with roslens")
  ament_roslens()
endif()
