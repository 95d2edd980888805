#include <samara/section/patches.h>

#include <deal.II/base/exceptions.h>

#include <cmath>

namespace samara
{
  namespace
  {
    using Place = dealii::Point<2>;

    std::function<Ply(unsigned int, unsigned int)>
    one_material()
    {
      return [](unsigned int, unsigned int) { return Ply(); };
    }
  } // namespace



  std::vector<double>
  equal_intervals(const unsigned int n)
  {
    Assert(n > 0, dealii::ExcMessage("There is one interval at least."));
    std::vector<double> ends;
    for (unsigned int i = 0; i <= n; ++i)
      ends.push_back(double(i) / n);
    return ends;
  }



  std::vector<SectionPatch>
  rectangle_patches(const double width_2, const double width_3, const unsigned int n_2, const unsigned int n_3)
  {
    return {{[=](const double u, const double v) { return Place(width_2 * (u - 0.5), width_3 * (v - 0.5)); },
             equal_intervals(n_2),
             equal_intervals(n_3),
             one_material()}};
  }



  std::vector<SectionPatch>
  ellipse_patches(const double radius_2, const double radius_3, const unsigned int n)
  {
    // a square bent to a disc: lines of constant u and v become ellipses
    return {{[=](const double u, const double v) {
               const double x = 2 * u - 1, y = 2 * v - 1;
               return Place(radius_2 * x * std::sqrt(1 - y * y / 2), radius_3 * y * std::sqrt(1 - x * x / 2));
             },
             equal_intervals(n),
             equal_intervals(n),
             one_material()}};
  }



  std::vector<SectionPatch>
  ring_patches(const double inner, const double outer, const unsigned int n_around, const unsigned int n_through)
  {
    Assert(0 < inner && inner < outer, dealii::ExcMessage("A ring has a hole and a wall."));
    return {{[=](const double u, const double v) {
               const double r = outer + v * (inner - outer), angle = 2 * M_PI * u;
               return Place(r * std::cos(angle), r * std::sin(angle));
             },
             equal_intervals(n_around),
             equal_intervals(n_through),
             one_material()}};
  }

} // namespace samara
