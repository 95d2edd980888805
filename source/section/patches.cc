#include <samara/section/patches.h>

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
    std::vector<double> ends;
    for (unsigned int i = 0; i <= n; ++i)
      ends.push_back(double(i) / n);
    return ends;
  }



  SectionPatch
  wall_patch(const std::function<Place(double)> &outer,
             const std::function<Place(double)> &inner,
             const unsigned int                  n,
             const std::vector<double>          &thicknesses,
             const std::vector<Ply>             &plies,
             const unsigned int                  per_ply)
  {
    SectionPatch patch;
    patch.place  = [=](const double u, const double v) { return Place(outer(u) + v * (inner(u) - outer(u))); };
    patch.u      = equal_intervals(n);
    double total = 0, sum = 0;
    for (const double t : thicknesses)
      total += t;
    patch.v = {0.};
    for (const double t : thicknesses)
      {
        for (unsigned int i = 1; i <= per_ply; ++i)
          patch.v.push_back((sum + t * i / per_ply) / total);
        sum += t;
      }
    patch.v.back() = 1;
    patch.ply      = [=](unsigned int, const unsigned int j) { return plies[j / per_ply]; };
    return patch;
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
    return {{[=](const double u, const double v) {
               const double r = outer + v * (inner - outer), angle = 2 * M_PI * u;
               return Place(r * std::cos(angle), r * std::sin(angle));
             },
             equal_intervals(n_around),
             equal_intervals(n_through),
             one_material()}};
  }



  std::vector<SectionPatch>
  box_patches(const double                           width_2,
              const double                           width_3,
              const double                           thickness,
              const std::array<std::vector<Ply>, 4> &plies,
              const unsigned int                     n,
              const unsigned int                     per_ply)
  {
    const double              sign_2[4] = {-1, 1, 1, -1}, sign_3[4] = {-1, -1, 1, 1};
    std::vector<SectionPatch> patches;
    for (unsigned int w = 0; w < 4; ++w)
      {
        const unsigned int next   = (w + 1) % 4;
        const auto         corner = [&](const unsigned int c, const double depth) {
          return Place(sign_2[c] * (width_2 / 2 - depth), sign_3[c] * (width_3 / 2 - depth));
        };
        const auto line = [](const Place &from, const Place &to) {
          return [=](const double u) { return Place(from + u * (to - from)); };
        };
        patches.push_back(wall_patch(line(corner(w, 0), corner(next, 0)),
                                     line(corner(w, thickness), corner(next, thickness)),
                                     n,
                                     std::vector<double>(plies[w].size(), thickness / plies[w].size()),
                                     plies[w],
                                     per_ply));
      }
    return patches;
  }
} // namespace samara
