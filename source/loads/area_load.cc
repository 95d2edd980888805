#include <samara/loads/surface_loads.h>

#include <deal.II/base/exceptions.h>

namespace samara
{
  const SurfaceBody &
  surface_body(const Model &model, const std::string &name)
  {
    const auto *const found = dynamic_cast<const SurfaceBody *>(&model.find<Body>(name, "body"));
    if (found == nullptr)
      throw std::invalid_argument("body <" + name + "> has no surface on which a load could act");
    return *found;
  }



  std::vector<SurfaceCell>
  cells_of(Model &model, const Parameters &parameters, const std::string &body, const std::string &region)
  {
    if (!parameters.require("Body", model.complaints))
      return {};
    std::string where = "Body";
    try
      {
        const SurfaceBody &surface = surface_body(model, body);
        where                      = parameters.is_set("Region") ? "Region" : "Body";
        return surface.surface(region);
      }
    catch (const std::invalid_argument &problem)
      {
        model.complaints.add(parameters.where(where), problem.what());
        return {};
      }
  }



  void
  AreaLoad::add_parameters(Parameters &prm)
  {
    prm.add("Body", body, "Shell on which it acts.");
    prm.add("Region", region, "The part of it on which it acts: region skin, patch 2; not given: all of it.");
    prm.add("Force", force, "Components per area, expressions of time t and signals [Pa].");
    prm.add("Moment", moment, "Components per area, expressions of time t and signals [N/m].");
    add_axes_parameter(prm);
  }



  void
  AreaLoad::initialize(Model &model)
  {
    for (const auto &cell : cells_of(model, parameters, body, region))
      {
        const SurfaceRule &rule = *cell.rule;
        const unsigned int n    = cell.frames.size();
        AssertDimension(rule.N.cols(), n);
        std::vector<Vector3> x;
        for (const auto &frame : cell.frames)
          x.push_back(model.position(frame));
        Eigen::VectorXd weights  = Eigen::VectorXd::Zero(n);
        Eigen::MatrixXd products = Eigen::MatrixXd::Zero(n, n);
        for (unsigned int g = 0; g < rule.weights.size(); ++g)
          {
            const double area = rule.weights(g) * cell.area_vector(g, x).norm();
            weights += area * rule.N.row(g).transpose();
            products += area * rule.N.row(g).transpose() * rule.N.row(g);
          }
        add_part(cell.frames, weights, products);
        loaded = &surface_body(model, body);
      }
  }



  SurfaceTraction
  AreaLoad::traction(const Point<double> &point) const
  {
    const Vector3 f = wrench(point).head<3>(), none = Vector3::Zero();
    return {0, is_follower() ? none : f, is_follower() ? f : none};
  }
} // namespace samara
