#include "barrow_optics/lens.hpp"

namespace barrow_optics
{
double focal_length(const sensor_msgs::msg::CameraInfo & info)
{
  return info.k[0];
}
}  // namespace barrow_optics
