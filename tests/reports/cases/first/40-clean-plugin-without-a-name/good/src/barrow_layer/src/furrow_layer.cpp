#include "nav2_costmap_2d/layer.hpp"
#include "pluginlib/class_list_macros.hpp"

namespace barrow_layer
{
class FurrowLayer : public nav2_costmap_2d::Layer
{
public:
  void onInitialize() override {current_ = true;}
  void reset() override {current_ = true;}
  bool isClearable() override {return false;}

  void updateBounds(double, double, double, double *, double *, double *, double *) override {}
  void updateCosts(nav2_costmap_2d::Costmap2D &, int, int, int, int) override {}
};
}  // namespace barrow_layer

PLUGINLIB_EXPORT_CLASS(barrow_layer::FurrowLayer, nav2_costmap_2d::Layer)
